// A mesh in the module's memory, and distances on it: what the entry `brushfire/core` has. lib/full.js adds the rest.
import { doubles, indices, number, text } from './arrays.js';
import { invalid } from './errors.js';
import { Owned } from './owned.js';
import { checkNames, listenerOf, SOLVING, solvingArguments } from './options.js';
import { placeArrays, sourceArrays } from './places.js';

const NONE = new Float64Array(0);

const REPORT = ['vertices', 'faces', 'edges', 'components', 'boundaryEdges', 'nonmanifoldEdges', 'misorientedEdges',
  'nonmanifoldVertices', 'isolatedVertices', 'repeatedIndexFaces', 'zeroAreaFaces', 'zeroLengthEdges', 'duplicateFaces',
  'duplicatePositions', 'nearPositions', 'nearTolerance', 'looksLikeSoup', 'minEdgeLength', 'meanEdgeLength',
  'maxEdgeLength', 'area', 'eulerCharacteristic', 'lengthPrecision'];

export class CoreMesh extends Owned {
  constructor(module, address) {
    super(module, address, 'mesh_free', 'mesh');
    const [counts] = module.call('mesh_counts', [address]);
    [this.vertexCount, this.faceCount] = counts;
    this.hasPositions = counts[2] !== 0;
    this.bounds = { low: [...counts.subarray(3, 6)], high: [...counts.subarray(6, 9)] };
  }

  get vertices() {
    return this.call('mesh_arrays')[0];
  }

  get faces() {
    return this.call('mesh_arrays')[1];
  }

  get report() {
    const [numbers, ...remarks] = this.call('mesh_report');
    const report = Object.fromEntries(REPORT.map((name, k) => [name, numbers[k]]));
    return { ...report, looksLikeSoup: report.looksLikeSoup !== 0, remarks };
  }

  distance(sources, options = {}) {
    checkNames(options, [...SOLVING, 'offsets', 'targets']);
    return this.run(sources, options, 0).field;
  }

  field(sources, options = {}) {
    checkNames(options, [...SOLVING, 'offsets', 'targets', 'keep']);
    const keep = { paths: 1, all: 2 }[options.keep ?? 'all'];
    if (keep === undefined) throw invalid(`unknown keep '${options.keep}': it is paths or all`);
    const { field, address } = this.run(sources, { method: 'exact', ...options }, keep);
    return Object.assign(this.fieldOf(address), field);
  }

  setUp(options = {}) {
    checkNames(options, SOLVING);
    this.call('distance_set_up', ...solvingArguments(options));
  }

  position(places) {
    const { index, weights } = placeArrays(this, places, 'places');
    return this.call('mesh_position', index, weights)[0];
  }

  nearest(positions) {
    const [faces, weights, distances] = this.call('mesh_nearest', doubles(positions, 'positions'));
    return { faces, weights, distances };
  }

  weld(tolerance) {
    const [[address, joined], vertexMap] = this.call('mesh_weld', number(tolerance, 'tolerance'));
    return { mesh: this.sameKind(address), vertexMap, joined };
  }

  subdivide({ rule = 'loop-odd' } = {}) {
    if (rule !== 'loop-odd' && rule !== 'midpoint') throw invalid(`unknown rule '${rule}': it is loop-odd or midpoint`);
    return this.sameKind(this.call('mesh_subdivided', rule === 'loop-odd')[0][0]);
  }

  cut({ vertices = [], faces = [], edges = [] } = {}) {
    const [originalVertex, originalFace, cutFace, [mesh, address]] = this.call('cut_new', doubles(vertices, 'vertices'),
      doubles(faces, 'faces'), doubles(edges, 'edges'));
    return new Cut(this, address, { mesh: this.sameKind(mesh), originalVertex, originalFace, cutFace });
  }

  // Of the module, with this mesh as the first argument; for the classes of this package.
  call(name, ...args) {
    return this.module.call(name, [this.address, ...args]);
  }

  watchedCall(options, name, ...args) {
    return this.module.call(name, [this.address, ...args], listenerOf(options));
  }

  sourceArguments(sources, options) {
    const { index, weights, offsets, sizes } = sourceArrays(this, sources);
    return [index, weights, options.offsets === undefined ? offsets : doubles(options.offsets, 'offsets'), sizes];
  }

  run(sources, options, keep) {
    const targets = options.targets === undefined ? { index: NONE, weights: NONE } : placeArrays(this, options.targets, 'targets');
    const [method, [maxErrorBound, reached, beyondRadius, unreachable, updates, address], distance, source, errorBound,
      targetDistance, targetSource] = this.watchedCall(options, 'distance_run', ...this.sourceArguments(sources, options),
      targets.index, targets.weights, ...solvingArguments(options), keep);
    const field = { distance, source, errorBound: errorBound.length > 0 ? errorBound : null, maxErrorBound, method, reached,
      beyondRadius, unreachable, updates, targetDistance, targetSource };
    return { field, address };
  }

  fieldOf(address) {
    return new CoreField(this, address);
  }

  sameKind(address) {
    return new this.constructor(this.module, address);
  }
}

// A field whose windows were kept: it answers for any point of the surface.
export class CoreField extends Owned {
  constructor(mesh, address) {
    super(mesh.module, address, 'field_free', 'field');
    Object.defineProperty(this, 'mesh', { value: mesh });
  }

  at(places) {
    const { index, weights } = placeArrays(this.mesh, places, 'places');
    const [distance, source] = this.module.call('field_values', [this.address, index, weights]);
    return { distance, source };
  }
}

// A mesh with barriers cut out, and the way back.
export class Cut extends Owned {
  constructor(original, address, parts) {
    super(original.module, address, 'cut_free', 'cut mesh');
    Object.defineProperty(this, 'original', { value: original });
    Object.assign(this, parts);
  }

  toOriginal(values, sources) {
    const given = sources === undefined ? new Int32Array(0) : Int32Array.from(doubles(sources, 'sources'));
    const [distance, source] = this.module.call('cut_values_to_original', [this.address, doubles(values, 'values'), given]);
    return sources === undefined ? { distance } : { distance, source };
  }

  pointsToOriginal(places) {
    const { index, weights } = placeArrays(this.mesh, places, 'places');
    const [faces, w] = this.module.call('cut_points_to_original', [this.address, index, weights]);
    return { faces, weights: w };
  }

  pointsFromOriginal(places) {
    const { index, weights } = placeArrays(this.original, places, 'places');
    const [faces, w, which] = this.module.call('cut_points_from_original',
      [this.address, this.original.address, index, weights]);
    return { faces, weights: w, which };
  }

  free() {
    this.mesh.free();
    super.free();
  }
}

// What a loaded module offers besides meshes.
export class CoreLibrary {
  #module;
  #Mesh;

  constructor(module, Mesh) {
    this.#module = module;
    this.#Mesh = Mesh;
    [this.version, ...this.methods] = module.call('about', []);
  }

  get module() {
    return this.#module;
  }

  memory() {
    return this.#module.memory();
  }

  mesh(vertices, faces) {
    return this.meshOf(this.#module.call('mesh_new', [doubles(vertices, 'vertices'), indices(faces, 'faces')]));
  }

  fromLengths(faces, lengths, vertexCount) {
    const f = indices(faces, 'faces');
    const count = vertexCount ?? f.reduce((most, v) => Math.max(most, v + 1), 0);
    return this.meshOf(this.#module.call('mesh_from_lengths', [number(count, 'vertexCount'), f, doubles(lengths, 'lengths')]));
  }

  shape(name, ...sizes) {
    return this.meshOf(this.#module.call('mesh_shape', [text(name, 'name'), Float64Array.from(sizes)]));
  }

  meshOf([[address]]) {
    return new this.#Mesh(this.#module, address);
  }
}


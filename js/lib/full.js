// Everything else that is asked of meshes and fields: curves, regions, matrices, files.
import { bytes, doubles, number, text } from './arrays.js';
import { curvesOf, isolinesOf } from './curves.js';
import { invalid } from './errors.js';
import { CoreField, CoreLibrary, CoreMesh } from './mesh.js';
import { checkNames, SOLVING, solvingArguments, WATCHED } from './options.js';
import { placeArrays } from './places.js';

const NONE = new Float64Array(0);
const FINDINGS = ['possible', 'too short', 'too long', 'not reachable', 'not reached', 'not a number'];

// Levels that are given, or follow from the values.
function levelsOf(module, values, options) {
  const given = ['levels', 'every', 'count'].filter((name) => options[name] !== undefined);
  if (given.length !== 1) throw invalid('isolines: one of levels, every and count is needed');
  if (options.levels !== undefined) return doubles(options.levels, 'levels');
  if (options.every !== undefined) return module.call('levels_at_every', [values, number(options.every, 'every')])[0];
  return module.call('levels_in_between', [values, number(options.count, 'count')])[0];
}

const curveArrays = (curve) => [Uint32Array.from(curve.faces), doubles(curve.weights, 'weights')];

export class Mesh extends CoreMesh {
  path(places, options = {}) {
    checkNames(options, ['closed', 'tighten']);
    const { index, weights } = placeArrays(this, places, 'places');
    return curvesOf(this.call('path_through', index, weights, options.closed === true, options.tighten === true))[0];
  }

  edgePath(sources, target, options = {}) {
    checkNames(options, ['offsets']);
    return curvesOf(this.call('path_along_edges', ...this.sourceArguments(sources, options), number(target, 'target')))[0];
  }

  shorten(curve) {
    return curvesOf(this.call('path_shortened', ...curveArrays(curve), curve.closed === true))[0];
  }

  lengthOf(curve) {
    return this.call('path_length', ...curveArrays(curve), curve.closed === true)[0][0];
  }

  trace(from, direction, length) {
    const { index, weights } = placeArrays(this, from, 'from');
    const isAngle = typeof direction === 'number';
    const [end, ...parts] = this.call('trace_run', index, weights, isAngle ? direction : 0,
      isAngle ? NONE : doubles(direction, 'direction'), number(length, 'length'));
    return { end, path: curvesOf(parts)[0] };
  }

  logMap(source, options = {}) {
    checkNames(options, ['maxRadius']);
    const { index, weights } = placeArrays(this, source, 'source');
    const [[totalAngle], radius, angle] = this.call('log_map_run', index, weights, options.maxRadius ?? NaN);
    return { radius, angle, totalAngle };
  }

  isolines(values, options) {
    checkNames(options, ['levels', 'every', 'count']);
    const field = doubles(values, 'values');
    return isolinesOf(this.call('isolines_run', field, levelsOf(this.module, field, options)));
  }

  signedDistance(curves, options = {}) {
    checkNames(options, ['maxDistance', ...WATCHED]);
    return this.watchedCall(options, 'signed_distance_run', ...this.sourceArguments(curves, options), ...solvingArguments(options))[0];
  }

  voronoi(sources, options = {}) {
    checkNames(options, [...SOLVING, 'offsets']);
    const [distance, source, area, pairs, ...parts] = this.watchedCall(options, 'voronoi_run',
      ...this.sourceArguments(sources, options), ...solvingArguments(options));
    const borders = curvesOf(parts).map((curve, k) => ({ ...curve, sources: [pairs[2 * k], pairs[2 * k + 1]] }));
    return { distance, source, area, borders };
  }

  farthestPoints(count, options = {}) {
    checkNames(options, [...SOLVING, 'first']);
    const [[coveringRadius], vertices, separation, distance, nearest] = this.watchedCall(options, 'farthest_points_run',
      number(count, 'count'), doubles(options.first ?? [], 'first'), ...solvingArguments(options));
    return { vertices, separation, distance, nearest, coveringRadius };
  }

  distanceMatrix(options = {}) {
    checkNames(options, [...SOLVING, 'rows', 'columns', 'type']);
    const type = options.type ?? 'float64';
    if (type !== 'float64' && type !== 'float32') throw invalid(`unknown type '${type}': it is float32 or float64`);
    return this.watchedCall(options, 'matrix_run', ...this.#places(options.rows, 'rows'),
      ...this.#places(options.columns, 'columns'), type === 'float32', ...solvingArguments(options))[0];
  }

  distancesWithin(radius, options = {}) {
    checkNames(options, [...SOLVING.filter((name) => name !== 'maxDistance'), 'rows']);
    const [rowStart, column, value] = this.watchedCall(options, 'within_run', number(radius, 'radius'),
      ...this.#places(options.rows, 'rows'), ...solvingArguments(options));
    return { rowStart, column, value };
  }

  gradients(values) {
    return this.call('gradients_run', doubles(values, 'values'))[0];
  }

  vertexAreas() {
    return this.call('vertex_areas_run')[0];
  }

  certify(values, sources, options = {}) {
    checkNames(options, ['offsets', 'tolerance', 'within', 'maxDistance', ...WATCHED]);
    const [numbers, lower, upper, provenError, finding] = this.watchedCall(options, 'certify_run', doubles(values, 'values'),
      ...this.sourceArguments(sources, options), options.tolerance ?? 0, options.within ?? 0, options.maxDistance ?? Infinity,
      Boolean(options.progress || options.signal));
    const [provenWrong, possible, tooShort, tooLong, notReachable, notReached, notANumber, leastWithin, worstVertex, maxGap] = numbers;
    return { provenWrong, possible, tooShort, tooLong, notReachable, notReached, notANumber, leastWithin, worstVertex, maxGap,
      lower, upper, provenError, finding, findingNames: FINDINGS };
  }

  write(format, options = {}) {
    checkNames(options, ['values', 'labels', 'name', 'labelName']);
    const values = options.values === undefined ? NONE : doubles(options.values, 'values');
    const labels = options.labels === undefined ? new Int32Array(0) : Int32Array.from(options.labels);
    return this.call('mesh_write', text(format, 'format'), values, labels, options.name ?? '', options.labelName ?? '')[0];
  }

  // Curves as paths, isolines and borders are; the value of each is its level, else its length.
  writeCurves(format, curves, options = {}) {
    checkNames(options, ['valueName', 'millimetres', 'view', 'outline']);
    const starts = new Uint32Array(curves.length + 1);
    curves.forEach((curve, k) => {
      starts[k + 1] = starts[k] + curve.faces.length;
    });
    const faces = new Uint32Array(starts[curves.length]);
    const weights = new Float64Array(3 * faces.length);
    curves.forEach((curve, k) => {
      faces.set(curve.faces, starts[k]);
      weights.set(curve.weights, 3 * starts[k]);
    });
    return this.call('curves_write', text(format, 'format'), starts, Uint8Array.from(curves, (c) => (c.closed ? 1 : 0)),
      Float64Array.from(curves, (c) => c.level ?? c.length), faces, weights,
      options.valueName ?? (curves[0]?.level === undefined ? 'length' : 'level'), options.millimetres ?? 1,
      options.view ?? '', options.outline === true)[0];
  }

  fieldOf(address) {
    return new Field(this, address);
  }

  #places(places, what) {
    if (places === undefined) return [true, NONE, NONE];
    const { index, weights } = placeArrays(this, places, what);
    return [false, index, weights];
  }
}

export class Field extends CoreField {
  path(target) {
    return this.paths([target])[0];
  }

  paths(targets) {
    const { index, weights } = placeArrays(this.mesh, targets, 'targets');
    return curvesOf(this.module.call('field_paths', [this.address, index, weights]));
  }

  isolines(options) {
    checkNames(options, ['levels', 'every', 'count', 'chordError']);
    const levels = levelsOf(this.module, this.distance, options);
    return isolinesOf(this.module.call('field_isolines', [this.address, levels, number(options.chordError, 'chordError')]));
  }
}

const formatList = (lines) => lines.split('\n').filter(Boolean).map((line) => {
  const [name, ...extensions] = line.split('\t');
  return { name, extensions };
});

const measureOf = ([mean, rootMeanSquare, max, maxVertex]) => ({ mean, rootMeanSquare, max, maxVertex });

export class Library extends CoreLibrary {
  constructor(module) {
    super(module, Mesh);
    const names = ['meshesRead', 'meshesWritten', 'fieldsRead', 'fieldsWritten', 'curvesWritten'];
    const lists = module.call('formats', []);
    this.formats = Object.fromEntries(names.map((name, k) => [name, formatList(lists[k])]));
  }

  read(content, name = '') {
    const [handle, format, structure, faceOrigin, vertexMap, ...remarks] =
      this.module.call('mesh_read', [bytes(content, 'content'), text(name, 'name')]);
    const mesh = this.meshOf([handle]);
    return Object.assign(mesh, { file: { format, structure, remarks, faceOrigin: faceOrigin.length > 0 ? faceOrigin : null,
      vertexMap: vertexMap.length > 0 ? vertexMap : null } });
  }

  readField(content, fileName = '', options = {}) {
    checkNames(options, ['name']);
    const [values, vertices, name, format] =
      this.module.call('field_read', [bytes(content, 'content'), text(fileName, 'fileName'), options.name ?? '']);
    return { values, vertices: vertices.length > 0 ? vertices : null, name, format };
  }

  // 256 colours of a map of the pictures, four bytes each.
  colormap(name) {
    return this.module.call('colormap_table', [text(name, 'name')])[0];
  }

  compare(values, reference, options = {}) {
    checkNames(options, ['vertexWeights']);
    const [numbers, ...measures] = this.module.call('compare_run', [doubles(values, 'values'), doubles(reference, 'reference'),
      doubles(options.vertexWeights ?? [], 'vertexWeights')]);
    const [compared, zeroReference, missing, surplus, unreachedInBoth, meanSignedRelative, maxAtZeroReference, hasWeights] = numbers;
    const [absolute, relative, weightedAbsolute, weightedRelative] = measures.map(measureOf);
    return { compared, zeroReference, missing, surplus, unreachedInBoth, meanSignedRelative, maxAtZeroReference, absolute,
      relative, weightedAbsolute: hasWeights ? weightedAbsolute : null, weightedRelative: hasWeights ? weightedRelative : null };
  }
}


// Types of the package's main entry. Arrays of points and faces are flat: three numbers each.

/** Codes as the C++ library and the command line have them. */
export type ErrorCode =
  | 'invalid_argument'
  | 'index_out_of_range'
  | 'invalid_mesh'
  | 'file_not_readable'
  | 'file_malformed'
  | 'file_not_writable'
  | 'unknown_format'
  | 'cancelled'
  | 'too_large'
  | 'internal';

/** Everything that fails throws this: a code for programs, one line for people that says what, where and what to do. */
export class BrushfireError extends Error {
  constructor(code: ErrorCode, message: string);
  readonly name: 'BrushfireError';
  readonly code: ErrorCode;
}

export type Method =
  | 'windows'
  | 'exact'
  | 'novotni-klein'
  | 'novotni-klein-2002'
  | 'kimmel-sethian'
  | 'carried-source'
  | 'dijkstra';

type TypedArray =
  | Float64Array | Float32Array | Int8Array | Uint8Array | Int16Array | Uint16Array | Int32Array | Uint32Array;
/** Numbers in any of the usual shapes; a Float64Array (Uint32Array for faces) is not copied on this side. */
export type Numbers = TypedArray | readonly number[] | readonly (readonly number[] | TypedArray)[];

/** A point of the surface: a face and the weights of its three corners, each >= 0, summing to one. */
export interface SurfacePoint {
  face: number;
  weights: Numbers;
}
/** Many points of the surface: the face of each, and three weights each. */
export interface Points {
  faces: Uint32Array;
  weights: Float64Array;
}
/** A vertex by its number, a point of a face, or the point of the surface nearest to a position. */
export type Place =
  | number
  | { vertex: number; offset?: number }
  | (SurfacePoint & { offset?: number })
  | { at: Numbers; within?: number; offset?: number };
/** One place or many; a typed array holds vertex numbers. */
export type Places = Place | Iterable<Place> | TypedArray | Points;

/** A curve that distances are measured from: places of which each shares a face with the next, as paths and isolines have. */
export interface CurveSource {
  curve: Exclude<Places, Place>;
  /** The last place is joined to the first; where nothing is said, what the curve itself says. */
  closed?: boolean;
  offset?: number;
}
/** Places and curves, mixed. */
export type Sources = Places | CurveSource | Iterable<Place | CurveSource>;

/** How a call is watched and stopped. */
export interface Watch {
  /** Called now and then with the share that is done, in [0, 1]; returning false stops the call. */
  progress?: (share: number) => boolean | void;
  /** Stops the call with the code `cancelled`. */
  signal?: AbortSignal;
}

/** How a field is computed. */
export interface SolveOptions extends Watch {
  /** `windows` where nothing is said: every distance within `tolerance`, proven. */
  method?: Method;
  /** Of `windows`: greatest relative error, in [0, 0.1]; 1e-3 where nothing is said, 0 is exact. */
  tolerance?: number;
  /** Of `windows`: which value is given out. `upper` is never shorter than a real path, `lower` never longer. */
  bound?: 'estimate' | 'upper' | 'lower';
  /** Arithmetic of the marching methods; `float32` where nothing is said. */
  precision?: 'float32' | 'float64';
  /** Vertices farther than this read Infinity. */
  maxDistance?: number;
}

export interface DistanceOptions extends SolveOptions {
  /** Values that the sources start with; they may also stand at the places themselves. */
  offsets?: Numbers;
  /** The solver may stop once these are reached; those that are nowhere read Infinity. */
  targets?: Places;
}

export interface DistanceField {
  /** Per vertex; Infinity: unreachable, beyond maxDistance, or not final where targets stopped the solver. */
  distance: Float64Array;
  /** Per vertex: place of the nearest source in the caller's list, of equals the lowest; -1: none. */
  source: Int32Array;
  /** Per vertex, absolute and proven; null for methods without a bound. */
  errorBound: Float64Array | null;
  /** Relative, over all reached vertices; Infinity for methods without a bound. */
  maxErrorBound: number;
  method: Method;
  reached: number;
  beyondRadius: number;
  unreachable: number;
  updates: number;
  targetDistance: Float64Array;
  targetSource: Int32Array;
}

/** A polyline on the mesh: consecutive points share a face. No points and length Infinity: there is no path. */
export interface Curve extends Points {
  /** Three coordinates per point; empty for a mesh without positions. */
  positions: Float64Array;
  length: number;
  closed: boolean;
}
export interface Isoline extends Curve {
  level: number;
  levelIndex: number;
}
/** One of the three: the levels themselves, a step, or how many. */
export interface Levels {
  levels?: Numbers;
  every?: number;
  count?: number;
}

export interface MeshReport {
  vertices: number;
  faces: number;
  edges: number;
  components: number;
  boundaryEdges: number;
  nonmanifoldEdges: number;
  misorientedEdges: number;
  nonmanifoldVertices: number;
  isolatedVertices: number;
  repeatedIndexFaces: number;
  zeroAreaFaces: number;
  zeroLengthEdges: number;
  duplicateFaces: number;
  duplicatePositions: number;
  nearPositions: number;
  nearTolerance: number;
  looksLikeSoup: boolean;
  minEdgeLength: number;
  meanEdgeLength: number;
  maxEdgeLength: number;
  area: number;
  eulerCharacteristic: number;
  lengthPrecision: number;
  /** One sentence each on whatever is unusual; empty for a clean closed mesh. */
  remarks: string[];
}

export interface FileInfo {
  format: string;
  structure: string;
  remarks: string[];
  /** Which face of the file each triangle comes from; null where it is the same one. */
  faceOrigin: Uint32Array | null;
  /** Which vertex each corner of the file became (STL); null where the file has vertices. */
  vertexMap: Uint32Array | null;
}

export interface ShapeSizes {
  plane: [columns: number, rows: number, width?: number, height?: number];
  saddle: [cells: number, height?: number];
  'noise-terrain': [columns: number, rows: number, height?: number];
  cube: [cells: number];
  icosphere: [levels: number, radius?: number];
  'latlong-sphere': [stacks: number, slices: number, radius?: number];
  cone: [rings: number, segments: number, radius?: number, height?: number];
  cylinder: [rings: number, segments: number, radius?: number, height?: number];
  torus: [majorSegments: number, minorSegments: number, majorRadius?: number, minorRadius?: number];
  'folded-sphere': [levels: number, folds?: number, depth?: number];
  book: [pages: number, columns: number, rows: number];
  'bow-tie': [fans: number, segments: number];
}

export interface Voronoi {
  distance: Float64Array;
  source: Int32Array;
  /** Per source, in units of the mesh squared. */
  area: Float64Array;
  borders: (Curve & { sources: [number, number] })[];
}
export interface Samples {
  vertices: Uint32Array;
  separation: Float64Array;
  distance: Float64Array;
  nearest: Int32Array;
  coveringRadius: number;
}
export interface LogMap {
  /** Per vertex: exact distance. */
  radius: Float64Array;
  /** Per vertex: the direction in which the shortest path leaves the source, in radians; NaN where there is none. */
  angle: Float64Array;
  totalAngle: number;
}
export interface Trace {
  end: 'length' | 'boundary' | 'non-manifold';
  path: Curve;
}
/** Compressed sparse rows: the entries rowStart[i] .. rowStart[i + 1] - 1 belong to row i. */
export interface SparseRows {
  rowStart: Uint32Array;
  column: Uint32Array;
  value: Float64Array;
}
export interface MatrixOptions extends SolveOptions {
  /** All vertices where nothing is said. */
  rows?: Places;
  columns?: Places;
}
export interface Certificate {
  provenWrong: number;
  possible: number;
  tooShort: number;
  tooLong: number;
  notReachable: number;
  notReached: number;
  notANumber: number;
  leastWithin: number;
  worstVertex: number;
  maxGap: number;
  lower: Float64Array;
  upper: Float64Array;
  provenError: Float64Array;
  /** Per vertex: a place in findingNames. */
  finding: Uint8Array;
  findingNames: string[];
}
export interface ErrorMeasure {
  mean: number;
  rootMeanSquare: number;
  max: number;
  maxVertex: number;
}
export interface Comparison {
  compared: number;
  zeroReference: number;
  missing: number;
  surplus: number;
  unreachedInBoth: number;
  meanSignedRelative: number;
  maxAtZeroReference: number;
  absolute: ErrorMeasure;
  relative: ErrorMeasure;
  weightedAbsolute: ErrorMeasure | null;
  weightedRelative: ErrorMeasure | null;
}
export interface LoadedField {
  values: Float64Array;
  /** Which vertex each value belongs to; null where values[v] is that of vertex v. */
  vertices: Uint32Array | null;
  name: string;
  format: string;
}
export interface FileFormat {
  name: string;
  extensions: string[];
}

/** What lives in the module's memory: let go of by free(), by `using`, or some time after nobody has it any more. */
export interface Owned {
  free(): void;
  [Symbol.dispose](): void;
}

interface MeshFacts {
  readonly vertexCount: number;
  readonly faceCount: number;
  readonly hasPositions: boolean;
  readonly bounds: { low: number[]; high: number[] };
  /** Of a mesh that was read. */
  readonly file?: FileInfo;
}

/** The calls on a mesh, and what each gives. `Mesh` has them as they are, `PoolMesh` as promises. */
interface MeshCalls {
  /** Distances from the nearest of the sources to every vertex. */
  distance(sources: Sources, options?: DistanceOptions): DistanceField;
  /** Builds what the first distance() with these options would build. */
  setUp(options?: SolveOptions): void;
  /** Coordinates of places, three each. */
  position(places: Places): Float64Array;
  /** The points of the surface nearest to positions, and how far these are from it. */
  nearest(positions: Numbers): Points & { distances: Float64Array };
  /** The shortest path through places in their order, exactly; `tighten`: pulled straight where it bends at them. */
  path(places: Places, options?: { closed?: boolean; tighten?: boolean }): Curve;
  /** The shortest path along edges, from the nearest source. */
  edgePath(sources: Places, target: number, options?: { offsets?: Numbers }): Curve;
  /** What the curve becomes when it is pulled straight like a rubber band, its ends held. */
  shorten(curve: Points & { closed?: boolean }): Curve;
  lengthOf(curve: Points & { closed?: boolean }): number;
  /** Straight on from a place, in the direction of an angle or a vector. */
  trace(from: Places, direction: number | Numbers, length: number): Trace;
  logMap(source: Places, options?: { maxRadius?: number }): LogMap;
  /** Curves of equal value of a field that is linear in every face. */
  isolines(values: Numbers, options: Levels): Isoline[];
  /** Per vertex, exactly: negative on the left of the nearest curve, positive on its right. Of curves alone, without offsets. */
  signedDistance(curves: CurveSource | Iterable<CurveSource>, options?: Watch & { maxDistance?: number }): Float64Array;
  voronoi(sources: Sources, options?: SolveOptions & { offsets?: Numbers }): Voronoi;
  farthestPoints(count: number, options?: SolveOptions & { first?: Numbers }): Samples;
  /** Row after row. */
  distanceMatrix(options: MatrixOptions & { type: 'float32' }): Float32Array;
  distanceMatrix(options?: MatrixOptions & { type?: 'float64' }): Float64Array;
  distancesWithin(radius: number, options?: Omit<SolveOptions, 'maxDistance'> & { rows?: Places }): SparseRows;
  /** Per face, three components. */
  gradients(values: Numbers): Float64Array;
  vertexAreas(): Float64Array;
  /** What can be proven about a field, whoever made it. */
  certify(values: Numbers, sources: Sources, options?: Watch & {
    offsets?: Numbers; tolerance?: number; within?: number; maxDistance?: number }): Certificate;
  /** A file's bytes; `format` is an extension: ply, obj, stl, glb, gii, npy, csv, ... */
  write(format: string, options?: { values?: Numbers; labels?: Iterable<number>; name?: string; labelName?: string }): Uint8Array;
  /** Curves as json, obj, ply, vtp, csv, svg or dxf. */
  writeCurves(format: string, curves: readonly (Curve & { level?: number })[], options?: {
    valueName?: string; millimetres?: number; view?: string; outline?: boolean }): Uint8Array;
}

export interface Barriers {
  /** Nothing passes. */
  vertices?: Numbers;
  faces?: Numbers;
  /** Pairs of vertices: nothing crosses the edge between them. */
  edges?: Numbers;
}

export interface FieldOptions extends DistanceOptions {
  /** Only `exact` (where nothing is said) and `windows` keep something. */
  method?: 'exact' | 'windows';
  /** `all` answers for every point of the surface, `paths` for vertices and targets. */
  keep?: 'all' | 'paths';
}

/** An immutable triangle mesh: closed or not, manifold or not. Nothing is repaired. */
export interface Mesh extends MeshCalls, MeshFacts, Owned {
  /** Copies: ask once, not in a loop. */
  readonly vertices: Float64Array;
  readonly faces: Uint32Array;
  readonly report: MeshReport;
  /** A field that is kept, for values and paths at any point. */
  field(sources: Sources, options?: FieldOptions): Field;
  weld(tolerance: number): { mesh: Mesh; vertexMap: Uint32Array; joined: number };
  subdivide(options?: { rule?: 'loop-odd' | 'midpoint' }): Mesh;
  cut(barriers: Barriers): Cut;
}

interface FieldCalls {
  /** Values and nearest sources at places. */
  at(places: Places): { distance: Float64Array; source: Int32Array };
  /** The shortest path from the nearest source. */
  path(target: Place): Curve;
  paths(targets: Places): Curve[];
  /** The level sets of the exact distance itself: arcs, as polylines within `chordError` of them. */
  isolines(options: Levels & { chordError: number }): Isoline[];
}
export interface Field extends DistanceField, FieldCalls, Owned {
  readonly mesh: Mesh;
}

interface CutFacts {
  readonly originalVertex: Uint32Array;
  readonly originalFace: Uint32Array;
  /** -1: blocked. */
  readonly cutFace: Int32Array;
}
interface CutCalls {
  toOriginal(values: Numbers, sources?: Numbers): { distance: Float64Array; source?: Int32Array };
  pointsToOriginal(places: Places): Points;
  pointsFromOriginal(places: Places): Points & { which: Uint32Array };
}
/** A mesh with barriers cut out, and the way back. */
export interface Cut extends CutFacts, CutCalls, Owned {
  readonly mesh: Mesh;
}

interface LibraryCalls {
  /** One value per vertex from a file's bytes. */
  readField(content: Uint8Array | ArrayBuffer, fileName?: string, options?: { name?: string }): LoadedField;
  /** 256 colours from the low end to the high one: red, green, blue, alpha. */
  colormap(name: 'viridis' | 'magma' | 'cividis'): Uint8Array;
  compare(values: Numbers, reference: Numbers, options?: { vertexWeights?: Numbers }): Comparison;
}

export interface Library extends LibraryCalls {
  readonly version: string;
  readonly methods: Method[];
  readonly formats: {
    meshesRead: FileFormat[];
    meshesWritten: FileFormat[];
    fieldsRead: FileFormat[];
    fieldsWritten: FileFormat[];
    curvesWritten: FileFormat[];
  };
  /** Bytes that are in use, and how large the module's memory has grown. */
  memory(): { used: number; grown: number };
  mesh(vertices: Numbers, faces: Numbers): Mesh;
  /** `lengths`: per face, those of its edges from corner k to corner k + 1. */
  fromLengths(faces: Numbers, lengths: Numbers, vertexCount?: number): Mesh;
  /** A file's bytes; the content decides about the format, or the extension of `name`. */
  read(content: Uint8Array | ArrayBuffer, name?: string): Mesh;
  shape<Name extends keyof ShapeSizes>(name: Name, ...sizes: ShapeSizes[Name]): Mesh;
}

export type WasmSource = WebAssembly.Module | ArrayBuffer | ArrayBufferView | URL | string;

export interface LoadOptions {
  /** Where bundlers do not find brushfire.wasm by themselves. */
  wasm?: WasmSource;
  /**
   * The same for brushfire.rest.wasm: what a first picture does not need, as methods that are there for comparison,
   * marching in doubles, walls, matrices, cells, checks, writers, rare readers. Pages fetch it once the first module is there; a call
   * that needs it before waits for a synchronous request, unless it is given as a compiled module.
   */
  rest?: WasmSource;
}
/** The module with all calls. */
export function load(options?: LoadOptions): Promise<Library>;

type Promised<Calls> = {
  [Name in keyof Calls]: Calls[Name] extends (...args: infer Args) => infer Result ? (...args: Args) => Promise<Result> : never;
};

export interface PoolMesh extends Omit<Promised<MeshCalls>, 'distanceMatrix'>, MeshFacts, Owned {
  readonly vertices: Promise<Float64Array>;
  readonly faces: Promise<Uint32Array>;
  readonly report: Promise<MeshReport>;
  distanceMatrix(options: MatrixOptions & { type: 'float32' }): Promise<Float32Array>;
  distanceMatrix(options?: MatrixOptions & { type?: 'float64' }): Promise<Float64Array>;
  field(sources: Sources, options?: FieldOptions): Promise<PoolField>;
  weld(tolerance: number): Promise<{ mesh: PoolMesh; vertexMap: Uint32Array; joined: number }>;
  subdivide(options?: { rule?: 'loop-odd' | 'midpoint' }): Promise<PoolMesh>;
  cut(barriers: Barriers): Promise<PoolCut>;
}
export interface PoolField extends DistanceField, Promised<FieldCalls>, Owned {}
export interface PoolCut extends CutFacts, Promised<CutCalls>, Owned {
  readonly mesh: PoolMesh;
}

/** The same calls in workers. One that had to be ended by a cancellation is replaced; nothing is lost. */
export interface Pool extends Promised<LibraryCalls> {
  readonly workers: number;
  mesh(vertices: Numbers, faces: Numbers): Promise<PoolMesh>;
  fromLengths(faces: Numbers, lengths: Numbers, vertexCount?: number): Promise<PoolMesh>;
  read(content: Uint8Array | ArrayBuffer, name?: string): Promise<PoolMesh>;
  shape<Name extends keyof ShapeSizes>(name: Name, ...sizes: ShapeSizes[Name]): Promise<PoolMesh>;
  close(): void;
}

export interface PoolOptions extends LoadOptions {
  /** At most four, and no more than processors, where nothing is said. */
  workers?: number;
  /** Starts `brushfire/worker`, where bundlers do not find it by themselves. */
  makeWorker?: () => Worker;
}
export function createPool(options?: PoolOptions): Promise<Pool>;

/** For `instanceof`. */
export const Mesh: { prototype: Mesh };
export const Field: { prototype: Field };
export const Cut: { prototype: Cut };
export const Library: { prototype: Library };
export const Pool: { prototype: Pool };
/** Where the WebAssembly is. */
export const wasmURL: URL;
/** And the rest of it, which a first picture does not need. */
export const restURL: URL;

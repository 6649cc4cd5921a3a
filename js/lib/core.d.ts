// Types of `brushfire/core`: meshes from arrays and distances on them.
import type * as full from './index.js';

export { BrushfireError } from './index.js';
export type {
  DistanceField, DistanceOptions, ErrorCode, MeshReport, Method, Numbers, Place, Places, Points, SolveOptions, WasmSource,
} from './index.js';

export interface Field extends full.DistanceField, full.Owned, Pick<full.Field, 'at'> {
  readonly mesh: Mesh;
}
export interface Cut extends Omit<full.Cut, 'mesh'> {
  readonly mesh: Mesh;
}
export interface Mesh extends Pick<full.Mesh, 'vertexCount' | 'faceCount' | 'hasPositions' | 'bounds' | 'vertices' | 'faces' |
  'report' | 'distance' | 'setUp' | 'position' | 'nearest'>, full.Owned {
  field(sources: full.Places, options?: full.FieldOptions): Field;
  weld(tolerance: number): { mesh: Mesh; vertexMap: Uint32Array; joined: number };
  subdivide(options?: { rule?: 'loop-odd' | 'midpoint' }): Mesh;
  cut(barriers: full.Barriers): Cut;
}
export interface Library extends Pick<full.Library, 'version' | 'methods' | 'memory'> {
  mesh(vertices: full.Numbers, faces: full.Numbers): Mesh;
  fromLengths(faces: full.Numbers, lengths: full.Numbers, vertexCount?: number): Mesh;
  shape<Name extends keyof full.ShapeSizes>(name: Name, ...sizes: full.ShapeSizes[Name]): Mesh;
}
export function load(options?: full.LoadOptions): Promise<Library>;
export const Mesh: { prototype: Mesh };
export const Field: { prototype: Field };
export const Cut: { prototype: Cut };
export const Library: { prototype: Library };
export const wasmURL: URL;
export const restURL: URL;

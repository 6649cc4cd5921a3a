// What distances are computed on: the mesh, or, with walls in it, the mesh that is cut open along them.
import { isCurve } from './state.js';

const cornerAt = (faces, face, weights) => faces[3 * face + weights.indexOf(Math.max(...weights))];

// The shortest way along edges through the corners nearest to the places: as a line, and as pairs of vertices.
async function wallThrough(mesh, faces, through) {
  const corners = through.map(({ face, weights }) => cornerAt(faces, face, weights));
  const edges = [];
  const lines = [];
  for (let k = 1; k < corners.length; ++k) {
    const line = await mesh.edgePath(corners[k - 1], corners[k]);
    const run = Array.from(line.faces, (face, i) => cornerAt(faces, face, [...line.weights.subarray(3 * i, 3 * i + 3)]));
    for (let i = 1; i < run.length; ++i) if (run[i] !== run[i - 1]) edges.push(run[i - 1], run[i]);
    lines.push(line);
  }
  return { edges, lines };
}

export class Ground {
  #cut = null; #curves = new Map();

  // Of a mesh with these faces and walls, each {through: places}.
  static async of(mesh, faces, walls) {
    const ground = new Ground();
    const parts = await Promise.all(walls.map(({ through }) => wallThrough(mesh, faces, through)));
    ground.lines = parts.flatMap(({ lines }) => lines);
    ground.edges = Uint32Array.from(parts.flatMap(({ edges }) => edges));
    if (ground.edges.length > 0) ground.#cut = await mesh.cut({ edges: ground.edges });
    ground.mesh = ground.#cut?.mesh ?? mesh;
    if (ground.#cut) [ground.vertices, ground.faces] = await Promise.all([ground.mesh.vertices, ground.mesh.faces]);
    return ground;
  }

  free() {
    this.#cut?.free();
  }

  // The face of the whole mesh that a face of this one is.
  faceOf(face) {
    return this.#cut ? this.#cut.originalFace[face] : face;
  }

  // A curve of this mesh on the whole one.
  onWhole(curve) {
    return this.#cut ? { ...curve, faces: curve.faces.map((face) => this.#cut.originalFace[face]) } : curve;
  }

  // For each place of the whole mesh the places here: two where it lies on a wall.
  async placesOf(places) {
    if (!this.#cut || places.length === 0) return places.map((p) => [p]);
    const { faces, weights, which } = await this.#cut.pointsFromOriginal(places);
    const found = places.map(() => []);
    faces.forEach((face, k) => found[which[k]].push({ face, weights: [...weights.subarray(3 * k, 3 * k + 3)] }));
    return found;
  }

  // The curve through the places of a source that is one: shortest between them.
  curve(source) {
    const key = JSON.stringify(source);
    if (!this.#curves.has(key)) {
      if (this.#curves.size > 100) this.#curves.clear();
      const through = this.placesOf(source.through).then((places) => places.map(([p]) => p));
      this.#curves.set(key, through.then((places) => this.mesh.path(places, { closed: source.closed })));
    }
    return this.#curves.get(key);
  }

  // Sources of the state as the package takes them, and the number in the state of each.
  async sources(list) {
    const starts = await Promise.all(list.map(async (s) => (isCurve(s) ? [{ curve: await this.curve(s), closed: s.closed }] : (await this.placesOf([s]))[0])));
    return { starts: starts.flat(), number: starts.flatMap((its, k) => its.map(() => k)) };
  }

  // Values at the vertices of the whole mesh.
  async whole(distance, source) {
    return this.#cut ? this.#cut.toOriginal(distance, source) : { distance, source };
  }
}

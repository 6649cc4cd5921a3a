// The package in a worker: fields as fast as they come, never more than one waiting.
import { createPool } from 'brushfire';

import { Ground } from './ground.js';
import { Newest } from './newest.js';
import { poolParts } from './parts.js';
import { isCurve } from './state.js';

export class Engine {
  #pool; #mesh = null; #faces = null; #ground = null; #walls = '[]'; #fields = new Newest(); #arcs = new Newest();

  static async start() {
    const engine = new Engine();
    engine.#pool = await createPool({ workers: 2, ...(await poolParts()) });
    return engine;
  }

  colormap(name) {
    return this.#pool.colormap(name);
  }

  get mesh() {
    return this.#mesh;
  }

  // Vertices, faces and facts of the mesh that is made by `make(pool)`; the one before is let go of.
  async open(make) {
    const mesh = await make(this.#pool);
    if (mesh.faceCount === 0 || !mesh.hasPositions) {
      mesh.free();
      throw new Error('The file has no faces to show.');
    }
    const [vertices, faces, report] = await Promise.all([mesh.vertices, mesh.faces, mesh.report]);
    this.cancel();
    this.#ground?.free();
    this.#mesh?.free();
    this.#mesh = mesh;
    this.#faces = faces;
    this.#walls = '[]';
    this.#ground = await Ground.of(mesh, faces, []);
    return { mesh, vertices, faces, report };
  }

  get ground() {
    return this.#ground;
  }

  // Whether they are others than before.
  async setWalls(walls) {
    const text = JSON.stringify(walls);
    if (text === this.#walls) return false;
    const ground = await Ground.of(this.#mesh, this.#faces, walls);
    this.#ground.free();
    this.#ground = ground;
    this.#walls = text;
    return true;
  }

  curve(source) {
    return this.#ground.curve(source);
  }

  // A field for each of `computations`, side by side. Of questions that come meanwhile the newest only is answered.
  solve(sources, computations) {
    return this.#fields.run(async (signal) => {
      const ground = this.#ground;
      const { starts, number } = await ground.sources(sources);
      return Promise.all(computations.map(async (options) => {
        const field = await ground.mesh.distance(starts, { ...options, signal });
        const source = field.source.map((s) => (s < 0 ? s : number[s]));
        // As it is drawn, with two values at each vertex of a wall; and at the vertices of the whole mesh.
        return { ...field, ...(await ground.whole(field.distance, source)), drawn: { distance: field.distance, source } };
      }));
    });
  }

  // Exact isolines of the field that `options` compute, on the ground; undefined where others are asked for by then.
  arcs(sources, options, levels) {
    return this.#arcs.run(async (signal) => {
      const { mesh } = this.#ground;
      const { starts } = await this.#ground.sources(sources);
      const field = await mesh.field(starts, { ...options, signal });
      try {
        return await field.isolines(levels);
      } finally {
        field.free();
      }
    });
  }

  // Distances of a place by each of `computations`, and the path from the nearest source.
  async look(sources, computations, place, wantsPath) {
    const { mesh } = this.#ground;
    const { starts, number } = await this.#ground.sources(sources);
    const [[target]] = await this.#ground.placesOf([place]);
    const fields = await Promise.all(computations.map((options) => mesh.distance(starts, { ...options, targets: [target] })));
    const distances = fields.map(({ targetDistance }) => targetDistance[0]);
    const [source] = fields[0].targetSource;
    if (!wantsPath || source < 0) return { distances, path: null };
    if (!isCurve(sources[number[source]])) return { distances, path: await mesh.path([starts[source], target]) };
    const field = await mesh.field([starts[source]], { method: 'exact', targets: [target], keep: 'paths' });
    try {
      return { distances, path: await field.path(target) };
    } finally {
      field.free();
    }
  }

  // Per vertex as it is drawn: distances with the sign of the side of the curves among the sources.
  async sides(sources) {
    const { starts } = await this.#ground.sources(sources.filter(isCurve));
    return this.#ground.mesh.signedDistance(starts);
  }

  // Per vertex as it is drawn: two coordinates around the first place among the sources, NaN where there are none.
  async chart(sources) {
    const [[place]] = await this.#ground.placesOf([sources.find((s) => !isCurve(s))]);
    const { radius, angle, totalAngle } = await this.#ground.mesh.logMap(place);
    const chart = new Float32Array(2 * radius.length);
    radius.forEach((r, v) => {
      const turn = (angle[v] * 2 * Math.PI) / totalAngle;
      chart[2 * v] = r === 0 ? 0 : r * Math.cos(turn);
      chart[2 * v + 1] = r === 0 ? 0 : r * Math.sin(turn);
    });
    return chart;
  }

  cancel() {
    this.#fields.stop();
    this.#arcs.stop();
  }
}

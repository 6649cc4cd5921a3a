// The package in a worker: fields as fast as they come, never more than one waiting.
import { createPool } from 'brushfire';

import { poolParts } from './parts.js';
import { isCurve } from './state.js';

export class Engine {
  #pool; #mesh = null; #running = null; #waiting = null; #curves = new Map();

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
    this.#running?.controller.abort();
    this.#mesh?.free();
    this.#mesh = mesh;
    this.#curves.clear();
    return { mesh, vertices, faces, report };
  }

  // The curve through the places of a source that is one: shortest between them.
  curve(source) {
    const key = JSON.stringify(source);
    if (!this.#curves.has(key)) {
      if (this.#curves.size > 100) this.#curves.clear();
      this.#curves.set(key, this.#mesh.path(source.through, { closed: source.closed }));
    }
    return this.#curves.get(key);
  }

  // Sources of the state as the package takes them.
  async sources(list) {
    return Promise.all(list.map(async (s) => (isCurve(s) ? { curve: await this.curve(s), closed: s.closed } : s)));
  }

  // A field for each of `computations`, side by side. The newest question only: one that still waits when a newer one
  // comes is dropped, and answers undefined.
  solve(sources, computations) {
    this.#waiting?.drop();
    return new Promise((resolve, reject) => {
      this.#waiting = { drop: () => resolve(undefined), go: () => this.#go(sources, computations).then(resolve, reject) };
      if (!this.#running) this.#next();
    });
  }

  async #go(sources, computations) {
    const controller = new AbortController();
    const { signal } = controller;
    this.#running = { controller };
    try {
      const starts = await this.sources(sources);
      return await Promise.all(computations.map((options) => this.#mesh.distance(starts, { ...options, signal })));
    } finally {
      this.#running = null;
      this.#next();
    }
  }

  // Distance of a place, which source is nearest to it, and the path from there.
  async look(sources, options, place, wantsPath) {
    const starts = await this.sources(sources);
    const { targetDistance: [distance], targetSource: [source] } = await this.#mesh.distance(starts, { ...options, targets: [place] });
    if (!wantsPath || source < 0) return { distance, path: null };
    if (!isCurve(sources[source])) return { distance, path: await this.#mesh.path([sources[source], place]) };
    const field = await this.#mesh.field([starts[source]], { method: 'exact', targets: [place], keep: 'paths' });
    try {
      return { distance, path: await field.path(place) };
    } finally {
      field.free();
    }
  }

  #next() {
    const next = this.#waiting;
    this.#waiting = null;
    next?.go();
  }

  cancel() {
    this.#running?.controller.abort();
  }
}

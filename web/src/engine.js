// The package in a worker: fields as fast as they come, never more than one waiting.
import { createPool } from 'brushfire';

import { poolParts } from './parts.js';

export class Engine {
  #pool; #mesh = null; #running = null; #waiting = null;

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
    return { mesh, vertices, faces, report };
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
      return await Promise.all(computations.map((options) => this.#mesh.distance(sources, { ...options, signal })));
    } finally {
      this.#running = null;
      this.#next();
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

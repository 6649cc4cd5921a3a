// A program as a user writes it; each bundler makes a page of it.
import { createPool, load } from 'brushfire';
import { load as loadCore } from 'brushfire/core';

export async function run(options = {}) {
  const bf = await load(options.full);
  const core = await loadCore(options.core);
  const pool = await createPool({ workers: 1, ...options.full, ...options.pool });
  const mesh = bf.shape('torus', 24, 12);
  const other = await pool.mesh(mesh.vertices, mesh.faces);
  const sum = (a) => a.reduce((s, d) => s + d, 0);
  const result = {
    full: sum(mesh.distance(0).distance),
    core: sum(core.mesh(mesh.vertices, mesh.faces).distance(0).distance),
    pool: sum((await other.distance(0)).distance),
    behind: sum(mesh.distance(0, { method: 'dijkstra' }).distance), // in the second module
    poolBehind: sum((await other.distance(0, { method: 'dijkstra' })).distance),
    path: (await other.path([0, 100])).length,
  };
  pool.close();
  return result;
}

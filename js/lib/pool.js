// The same API in workers: every call gives a promise, and the page never waits.
//
// A worker does one call at a time. Objects are recipes: how a mesh was made is kept on this side, and a worker makes it
// when it first needs it. So a call may go to any worker, and one that had to be ended is replaced without loss.
import { compiled } from './load.js';
import { BrushfireError } from './errors.js';
import { processors, startWorker } from '#platform';

const GRACE = 250; // ms that a call has to notice that it was cancelled; its worker is ended then
const cancelled = () => new BrushfireError('cancelled', 'cancelled');

class Lane {
  #pool;
  #worker;
  #ready;
  #queue = [];
  #current = null;
  made = new Set(); // numbers of the objects that are there

  constructor(pool) {
    this.#pool = pool;
    this.#start();
  }

  #start() {
    this.made.clear();
    let started, failed;
    this.#ready = new Promise((resolve, reject) => {
      started = resolve;
      failed = reject;
    });
    this.#ready.catch(() => {});
    this.#worker = startWorker(this.#pool.makeWorker, (message) => {
      if ('started' in message) {
        if (message.started) started();
        else failed(new BrushfireError(message.error.code, `the worker did not start: ${message.error.message}`));
      } else this.#hear(message);
    }, (error) => {
      failed(error);
      this.#fail(error);
    });
    this.#worker.post({ start: this.#pool.wasm, rest: this.#pool.rest }, []);
    this.#worker.hold(false);
  }

  get load() {
    return this.#queue.length + (this.#current ? 1 : 0);
  }

  add(job) {
    this.#queue.push(job);
    this.#next();
  }

  async #next() {
    if (this.#current || this.#queue.length === 0) return;
    const job = (this.#current = this.#queue.shift());
    this.#worker.hold(true);
    try {
      await this.#ready;
    } catch (error) {
      this.#finish(job, () => job.reject(error));
      return;
    }
    if (this.#current !== job) return;
    try {
      this.#worker.post(job.message(this.made), job.transfer ?? []);
    } catch (error) {
      this.#finish(job, () => job.reject(new BrushfireError('invalid_argument', `arguments cannot be sent to a worker: ${error.message}`)));
    }
  }

  #hear({ id, result, error, progress }) {
    const job = this.#current;
    if (!job || job.id !== id) return;
    if (progress !== undefined) {
      if (job.progress(progress) === false) this.cancel(job);
      return;
    }
    this.#finish(job, () => {
      if (error) job.reject(new BrushfireError(error.code, error.message));
      else job.resolve(result);
    });
  }

  #finish(job, settle) {
    if (this.#current !== job) return;
    this.#current = null;
    clearTimeout(job.timer);
    settle();
    if (this.#queue.length === 0) this.#worker.hold(false);
    this.#next();
  }

  // The worker is gone by itself: out of memory, say.
  #fail(error) {
    const job = this.#current;
    this.#worker.end();
    this.#start();
    if (job) this.#finish(job, () => job.reject(new BrushfireError('internal', `the worker broke down: ${error.message}`)));
  }

  cancel(job) {
    const waiting = this.#queue.indexOf(job);
    if (waiting >= 0) {
      this.#queue.splice(waiting, 1);
      job.reject(cancelled());
      return;
    }
    if (this.#current !== job || job.timer !== undefined) return;
    const end = () => {
      this.#worker.end();
      this.#start();
      this.#finish(job, () => job.reject(cancelled()));
    };
    // Shared memory is how a busy worker hears of it; pages have that in cross-origin isolation only.
    if (job.flag) {
      Atomics.store(job.flag, 0, 1);
      job.timer = setTimeout(end, GRACE);
    } else {
      end();
    }
  }

  free(id) {
    if (this.made.delete(id)) this.#worker.post({ free: id }, []);
  }

  end() {
    this.#worker.end();
    for (const job of [this.#current, ...this.#queue]) job?.reject(new BrushfireError('cancelled', 'the pool was closed'));
    this.#current = null;
    this.#queue = [];
  }
}

const canShare = () => typeof SharedArrayBuffer !== 'undefined' && (globalThis.crossOriginIsolated ?? true);

export class Pool {
  #lanes = [];
  #ids = 1;
  #closed = false;

  static async start(options, wasmURL, restURL) {
    const pool = new Pool();
    pool.wasm = await compiled(options.wasm ?? wasmURL);
    const rest = options.rest ?? restURL;
    pool.rest = rest instanceof URL ? rest.href : rest; // URLs are not sent to workers, texts are
    pool.makeWorker = options.makeWorker;
    const count = Math.max(1, options.workers ?? Math.min(4, processors()));
    for (let k = 0; k < count; ++k) pool.#lanes.push(new Lane(pool));
    return pool;
  }

  get workers() {
    return this.#lanes.length;
  }

  mesh(vertices, faces) {
    return this.#make(MeshProxy, null, 'mesh', [vertices, faces]);
  }

  fromLengths(...args) {
    return this.#make(MeshProxy, null, 'fromLengths', args);
  }

  shape(...args) {
    return this.#make(MeshProxy, null, 'shape', args);
  }

  read(content, name) {
    return this.#make(MeshProxy, null, 'read', [content, name]);
  }

  readField(...args) {
    return this.submit(null, 'readField', args);
  }

  colormap(...args) {
    return this.submit(null, 'colormap', args);
  }

  compare(...args) {
    return this.submit(null, 'compare', args);
  }

  // Ends the workers; calls that are running are rejected as cancelled.
  close() {
    this.#closed = true;
    for (const lane of this.#lanes) lane.end();
    this.#lanes = [];
  }

  // A call of `method` on the object (null: the library).
  submit(proxy, method, args) {
    return this.#send({ of: proxy, method, args });
  }

  async #make(Kind, of, method, args) {
    const recipe = { id: this.#ids++, of, method, args };
    return new Kind(this, recipe, await this.#send({ recipe, args }));
  }

  derive(Kind, of, method, args) {
    return this.#make(Kind, of, method, args);
  }

  // An object that is part of another one.
  part(Kind, of, name, data) {
    return new Kind(this, { id: this.#ids++, of, args: [], part: name }, data);
  }

  free(recipe) {
    for (const lane of this.#lanes) lane.free(recipe.id);
  }

  #send({ of = null, method, args, recipe }) {
    if (this.#closed) return Promise.reject(new BrushfireError('invalid_argument', 'the pool has been closed'));
    const { signal, progress, plain } = watched(args);
    if (signal?.aborted) return Promise.reject(cancelled());
    const owner = recipe ? recipe.of : of;
    if (owner?.freed) return Promise.reject(new BrushfireError('invalid_argument', `the ${owner.what} has been freed`));
    const lane = this.#choose(owner);
    const id = this.#ids++;
    const flag = signal && canShare() ? new Int32Array(new SharedArrayBuffer(4)) : null;
    return new Promise((resolve, reject) => {
      const job = { id, flag, progress: progress ?? (() => {}), timer: undefined };
      const stop = () => lane.cancel(job);
      const done = (settle) => (value) => {
        signal?.removeEventListener('abort', stop);
        settle(value);
      };
      job.resolve = done(resolve);
      job.reject = done(reject);
      job.message = (made) => {
        const recipes = [];
        for (let o = owner; o && !made.has(o.recipe.id); o = o.recipe.of) recipes.unshift(sent(o.recipe));
        for (const r of recipes) made.add(r.id);
        if (recipe) made.add(recipe.id);
        const common = { id, flag, wantsProgress: Boolean(progress), recipes };
        if (recipe) return { ...common, make: sent({ ...recipe, args: plain }) };
        return { ...common, of: of ? of.recipe.id : 0, method, args: plain };
      };
      signal?.addEventListener('abort', stop, { once: true });
      lane.add(job);
    });
  }

  // The one with the least to do; of equals one that has the object already. Fields stay where they were made.
  #choose(owner) {
    const has = (lane) => (owner && lane.made.has(owner.recipe.id) ? 1 : 0);
    const lanes = owner?.stays && this.#lanes.some(has) ? this.#lanes.filter(has) : this.#lanes;
    return lanes.reduce((best, lane) => (lane.load < best.load || (lane.load === best.load && has(lane) > has(best)) ? lane : best));
  }
}

const sent = ({ id, of, method, args, part }) => ({ id, of: of ? of.recipe.id : 0, method, args: watched(args).plain, part });

// Signal and progress are functions of this side: the last argument goes without them.
function watched(args) {
  const last = args.at(-1);
  if (typeof last !== 'object' || last === null || !('signal' in last || 'progress' in last)) return { plain: args };
  const { signal, progress, ...options } = last;
  return { signal, progress, plain: [...args.slice(0, -1), { watched: true, options }] };
}

class Proxy {
  constructor(pool, recipe, { parts, ...data }) {
    Object.defineProperties(this, { pool: { value: pool }, recipe: { value: recipe }, freed: { value: false, writable: true } });
    Object.assign(this, data);
  }

  free() {
    if (this.freed) return;
    this.freed = true;
    this.pool.free(this.recipe);
  }
}
Object.defineProperty(Proxy.prototype, Symbol.dispose ?? Symbol.for('Symbol.dispose'), {
  value() {
    this.free();
  },
});

const forward = (Kind, names) => {
  for (const name of names) {
    Object.defineProperty(Kind.prototype, name, {
      value(...args) {
        return this.pool.submit(this, name, args);
      },
    });
  }
};

export class MeshProxy extends Proxy {
  get what() {
    return 'mesh';
  }

  get vertices() {
    return this.pool.submit(this, 'vertices', []);
  }

  get faces() {
    return this.pool.submit(this, 'faces', []);
  }

  get report() {
    return this.pool.submit(this, 'report', []);
  }

  field(...args) {
    return this.pool.derive(FieldProxy, this, 'field', args);
  }

  subdivide(...args) {
    return this.pool.derive(MeshProxy, this, 'subdivide', args);
  }

  async weld(...args) {
    const { mesh, vertexMap, joined } = await this.pool.derive(PairProxy, this, 'weld', args);
    return { mesh, vertexMap, joined };
  }

  cut(...args) {
    return this.pool.derive(CutProxy, this, 'cut', args);
  }
}
forward(MeshProxy, ['distance', 'setUp', 'position', 'nearest', 'path', 'edgePath', 'shorten', 'lengthOf', 'trace', 'logMap',
  'isolines', 'signedDistance', 'voronoi', 'farthestPoints', 'distanceMatrix', 'distancesWithin', 'gradients', 'vertexAreas', 'certify',
  'write', 'writeCurves']);

export class FieldProxy extends Proxy {
  get what() {
    return 'field';
  }

  get stays() {
    return true;
  }
}
forward(FieldProxy, ['at', 'path', 'paths', 'isolines']);

// A result with a mesh in it.
class PairProxy extends Proxy {
  constructor(pool, recipe, data) {
    super(pool, recipe, data);
    this.mesh = pool.part(MeshProxy, this, 'mesh', data.parts.mesh);
  }

  free() {
    this.mesh.free();
    super.free();
  }
}

export class CutProxy extends PairProxy {
  get what() {
    return 'cut mesh';
  }
}
forward(CutProxy, ['toOriginal', 'pointsToOriginal', 'pointsFromOriginal']);

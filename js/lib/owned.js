// Objects that live in the module's memory: let go of by free(), by `using`, or some time after nobody has them.
import { invalid } from './errors.js';

const registry = new FinalizationRegistry(({ module, release, address }) => module.free(release, address));

export class Owned {
  #module;
  #address;
  #release;
  #what;

  constructor(module, address, release, what) {
    this.#module = module;
    this.#address = address;
    this.#release = release;
    this.#what = what;
    registry.register(this, { module, release, address }, this);
  }

  get module() {
    return this.#module;
  }

  get address() {
    if (this.#address === 0) throw invalid(`the ${this.#what} has been freed`);
    return this.#address;
  }

  free() {
    if (this.#address === 0) return;
    registry.unregister(this);
    this.#module.free(this.#release, this.#address);
    this.#address = 0;
  }
}
// Node 20 and older browsers have no `using`; what compiles it down looks for this name.
Object.defineProperty(Owned.prototype, Symbol.dispose ?? Symbol.for('Symbol.dispose'), {
  value() {
    this.free();
  },
  configurable: true,
  writable: true,
});

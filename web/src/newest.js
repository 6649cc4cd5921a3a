// One computation at a time. Of those that are asked for meanwhile the newest only: the others answer undefined.
export class Newest {
  #running = null; #waiting = null;

  // compute(signal) gives a promise.
  run(compute) {
    this.#waiting?.drop();
    return new Promise((resolve, reject) => {
      this.#waiting = { drop: () => resolve(undefined), go: () => this.#go(compute).then(resolve, reject) };
      if (!this.#running) this.#next();
    });
  }

  // The running one is to end, as cancelled.
  stop() {
    this.#running?.abort();
  }

  async #go(compute) {
    const running = (this.#running = new AbortController());
    try {
      return await compute(running.signal);
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
}

// What is asked for while an answer is on its way: one question at a time, and of the later ones only the last.

const AGAIN_MS = 1000;

/**
 * Asks for views. `ask(query, signal)` gives a promise; an error that is `gone` says that nobody answers, and is tried
 * again until somebody does. `told` hears `answered(view, query)`, `refused(text, query)`, `waiting(seconds)`,
 * `gone(text)` and `stopped()`. After `stop` or `destroy` an answer that was on its way is not heard. `aside(query)`
 * promises a view that is asked for when nothing else is.
 */
export function asker(ask, told) {
  let wanted = null;
  let running = false;
  let under = null;
  let closed = false;
  const aside = [];

  async function run() {
    if (running) return;
    running = true;
    while (!closed && (wanted !== null || aside.length > 0)) {
      if (wanted === null) await beside(aside.shift());
      else await next();
    }
    running = false;
  }

  async function next() {
    const query = wanted;
    wanted = null;
    const clock = ticking(told.waiting);
    try {
      const view = await answer(query);
      if (!under.signal.aborted) told.answered(view, query);
    } catch (error) {
      if (under.signal.aborted) return;
      if (error.gone) {
        wanted ??= query;
        told.gone(error.message);
        await new Promise((resolve) => setTimeout(resolve, AGAIN_MS));
      } else if (wanted === null) told.refused(error.message, query);
    } finally {
      clearInterval(clock);
    }
  }

  async function beside({ query, resolve, reject }) {
    await answer(query).then(resolve, reject);
  }

  function answer(query) {
    under = new AbortController();
    return orAborted(ask(query, under.signal), under.signal);
  }

  return {
    want(query) {
      wanted = query;
      run();
    },
    aside: (query) => new Promise((resolve, reject) => {
      aside.push({ query, resolve, reject });
      run();
    }),
    stop() {
      wanted = null;
      under?.abort();
      told.stopped();
    },
    destroy() {
      closed = true;
      under?.abort();
    },
  };
}

function ticking(waiting) {
  const since = performance.now();
  return setInterval(() => waiting(Math.round((performance.now() - since) / 1000)), 1000);
}

function orAborted(promise, signal) {
  return new Promise((resolve, reject) => {
    signal.addEventListener("abort", () => reject(signal.reason));
    promise.then(resolve, reject);
  });
}

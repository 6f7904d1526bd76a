// What the pages of `sched-sim explore` have in common: answers by fetch, and an address that follows what is asked.

const AT_MOST_MS = 300;
const AS_ONE_MS = 1000;
const USUAL_PORT = "8400";

/** What the server answers at a path with a query: an object that has `key`. Rejects with its words, `gone` where nobody
 *  answers. */
export async function served(path, key, signal) {
  let response;
  try {
    response = await fetch(path, { signal });
  } catch {
    throw Object.assign(new Error(goneWords()), { gone: true });
  }
  const text = await response.text();
  const answer = parsed(text);
  if (response.ok && key in answer) return answer;
  const why = answer.error ?? (response.ok ? "" : text.trim());
  throw new Error(why || `sched-sim explore failed to answer (HTTP ${response.status}); its terminal says more.`);
}

function parsed(text) {
  try {
    return Object(JSON.parse(text));
  } catch {
    return {};
  }
}

function goneWords() {
  const again = location.port === USUAL_PORT ? "" : ` with --port ${location.port}`;
  return `sched-sim explore is not running any more: start it again${again}, then this page goes on by itself.`;
}

/** The address follows: `query(text, {key, settled})` is a change of a control, null for no one's, which can be gone back
 *  from; while it is dragged it replaces what was there, now and then, for browsers bear only so many changes. `aside` is
 *  no step back: another query or fragment, what is not given stays. After `forget` the address is as the browser has
 *  it. */
export function addressed() {
  let last = null;
  let { search, hash } = location;
  let timer = null;
  const write = () => {
    clearTimeout(timer);
    timer = null;
    history.replaceState(null, "", `${location.pathname}${search}${hash}`);
  };
  const soon = () => {
    timer ??= setTimeout(write, AT_MOST_MS);
  };
  return {
    query(text, { key, settled }) {
      const since = performance.now() - (last?.at ?? 0);
      const goesOn = key !== null && last?.key === key && (!last.settled || since < AS_ONE_MS);
      last = { key, settled, at: performance.now() };
      if (!goesOn) {
        if (timer !== null) write();
        history.pushState(null, "", location.href);
      }
      search = text && `?${text}`;
      if (settled) write();
      else soon();
    },
    aside({ query, pins }) {
      if (query !== undefined) search = query && `?${query}`;
      if (pins !== undefined) hash = pins && `#${pins}`;
      soon();
    },
    forget() {
      clearTimeout(timer);
      timer = last = null;
      ({ search, hash } = location);
    },
  };
}

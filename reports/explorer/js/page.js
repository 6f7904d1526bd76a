// The page of `sched-sim explore`: views by fetch, the design in the address.

import { explorer } from "./explorer.js";

const AT_MOST_MS = 300;
const AS_ONE_MS = 1000;
const USUAL_PORT = "8400";

const place = document.querySelector("[data-explorer]");
if (place !== null) start(place);

function start(host) {
  const address = addressed();
  const shown = explorer(host, {
    ask: fetched,
    query: location.search.slice(1),
    pins: location.hash.slice(1),
    onQuery: address.query,
    onPins: address.pins,
    files,
  });
  window.addEventListener("popstate", () => {
    address.forget();
    shown.show(location.search.slice(1), location.hash.slice(1));
  });
}

function files(kind, query, pins) {
  const path = kind === "link" ? `/?${query}${pins && `#${pins}`}` : `/${kind}?${query}`;
  return new URL(path, location.href).href;
}

async function fetched(query, signal) {
  let response;
  try {
    response = await fetch(`/view?${query}`, { signal });
  } catch {
    throw Object.assign(new Error(gone()), { gone: true });
  }
  const text = await response.text();
  const view = parsed(text);
  if (response.ok && view.query) return view;
  const why = view.error ?? (response.ok ? "" : text.trim());
  throw new Error(why || `sched-sim explore failed to answer (HTTP ${response.status}); its terminal says more.`);
}

function parsed(text) {
  try {
    return JSON.parse(text) ?? {};
  } catch {
    return {};
  }
}

function gone() {
  const again = location.port === USUAL_PORT ? "" : ` with --port ${location.port}`;
  return `sched-sim explore is not running any more: start it again${again}, then this page goes on by itself.`;
}

/* The address follows the design. What is dragged replaces what was there, now and then: browsers bear only so many.
Any other change can be gone back from. */
function addressed() {
  let last = null;
  let search = location.search;
  let hash = location.hash;
  let timer = null;
  const write = () => {
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
        clearTimeout(timer);
        if (timer !== null) write();
        history.pushState(null, "", location.href);
      }
      search = `?${text}`;
      if (settled) write();
      else soon();
    },
    pins(text) {
      hash = text && `#${text}`;
      soon();
    },
    forget() {
      clearTimeout(timer);
      timer = last = null;
      ({ search, hash } = location);
    },
  };
}

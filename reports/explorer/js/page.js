// The page of `sched-sim explore`: views by fetch, the design and those that are pinned in the address.

import { explorer } from "./explorer.js";
import { addressed, served } from "./served.js";

const place = document.querySelector("[data-explorer]");
if (place !== null) start(place);

function start(host) {
  const address = addressed();
  const shown = explorer(host, {
    ask: (query, signal) => served(`/view?${query}`, "query", signal),
    query: location.search.slice(1),
    pins: location.hash.slice(1),
    onQuery: address.query,
    onPins: (pins) => address.aside({ pins }),
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

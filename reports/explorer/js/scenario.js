// The page of a scenario: its views and windows by fetch, what is asked for in the address.

import { scenarioExplorer } from "./scenarioexplorer.js";
import { addressed, served } from "./served.js";

const scenarioPlace = document.querySelector("[data-scenario]");
if (scenarioPlace !== null) startScenario(scenarioPlace);

function startScenario(host) {
  const address = addressed();
  const shown = scenarioExplorer(host, {
    ask: (path, query, signal) => served(`/scenario/${path}?${query}`, "steps", signal),
    query: location.search.slice(1),
    onQuery: address.query,
    onTrace: (query) => address.aside({ query }),
  });
  window.addEventListener("popstate", () => {
    address.forget();
    shown.show(location.search.slice(1));
  });
}

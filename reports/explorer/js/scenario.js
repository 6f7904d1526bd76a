// The page of a scenario: its views and windows by fetch, what is asked for in the address.

import { scenarioExplorer } from "./scenarioexplorer.js";

const WRITTEN_AFTER_MS = 300;

const scenarioPlace = document.querySelector("[data-scenario]");
if (scenarioPlace !== null) startScenario(scenarioPlace);

function startScenario(host) {
  const address = scenarioAddress();
  const shown = scenarioExplorer(host, { ask: scenarioAnswer, query: location.search.slice(1), onQuery: address.follow });
  window.addEventListener("popstate", () => {
    address.forget();
    shown.show(location.search.slice(1));
  });
}

/** The address follows what is asked for. What is dragged is one step to go back, and written now and then: browsers bear
 *  only so many changes. `key` null: no step. */
function scenarioAddress() {
  let [search, dragged, timer] = [location.search, null, null];

  function write() {
    clearTimeout(timer);
    timer = null;
    history.replaceState(null, "", `${location.pathname}${search}`);
  }

  function follow(query, { key, settled }) {
    if (key !== null && key !== dragged) {
      if (timer !== null) write();
      history.pushState(null, "", location.href);
    }
    dragged = settled ? null : key;
    search = query && `?${query}`;
    if (settled && key !== null) write();
    else timer ??= setTimeout(write, WRITTEN_AFTER_MS);
  }

  function forget() {
    clearTimeout(timer);
    [search, dragged, timer] = [location.search, null, null];
  }

  return { follow, forget };
}

/** What the server answers at a path, "view", "schedule" or "next". Rejects with its words. */
async function scenarioAnswer(path, query, signal) {
  let response;
  try {
    response = await fetch(`/scenario/${path}?${query}`, { signal });
  } catch {
    throw Object.assign(new Error("sched-sim explore is not running any more: start it again, then this page goes on by itself."), { gone: true });
  }
  const answer = await response.json().catch(() => ({}));
  if (response.ok && !answer.error) return answer;
  throw new Error(answer.error ?? `sched-sim explore failed to answer (HTTP ${response.status}); its terminal says more.`);
}

// The page of a scenario: its views and windows by fetch, what is asked for in the address.

import { scenarioExplorer } from "./scenarioexplorer.js";

const scenarioPlace = document.querySelector("[data-scenario]");
if (scenarioPlace !== null) startScenario(scenarioPlace);

function startScenario(host) {
  const shown = scenarioExplorer(host, { ask: scenarioAnswer, query: location.search.slice(1), onQuery: scenarioAddress });
  window.addEventListener("popstate", () => shown.show(location.search.slice(1)));
}

/** A step on is one that can be gone back from. */
function scenarioAddress(query, stepOn) {
  const address = `${location.pathname}${query && `?${query}`}`;
  if (stepOn) history.pushState(null, "", address);
  else history.replaceState(null, "", address);
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

// A scenario in one element: what is asked of it, the answer, how its times are spread, and its trace.

import { changedQuery, queryOf, textOf } from "./address.js";
import { answerBox, unanswered } from "./answer.js";
import { asker } from "./ask.js";
import { scenarioForm } from "./scenarioform.js";
import { scenarioResults } from "./scenarioresults.js";
import { scenarioTrace } from "./scenariotrace.js";
import { html } from "./svg.js";

/**
 * The scenario's page in `host`, as `query` says. `ask(path, query, signal)` promises what the server answers at "view",
 * "schedule" and "next". `onQuery(query, {key, settled})` hears of each change: of which control, and whether it is still
 * being dragged; `onTrace(query)` of other steps of the trace.
 */
export function scenarioExplorer(host, { ask, query = "", onQuery, onTrace }) {
  const id = `ss-${Math.random().toString(36).slice(2, 10)}`;
  const top = html("section", { class: "ss-answer", "aria-label": "Answer" });
  const [side, beside] = [html("div", { class: "ss-side" }), html("div", { class: "ss-beside" })];
  const results = html("div", { class: "ss-results" });
  const root = html("div", { class: "ss-explorer ss-scenario ss-ground" }, html("div", { class: "ss-frame" }, top, side, beside, results));
  host.append(root);
  let asked = queryOf(query);
  let [view, frame, force, refusal] = [null, null, true, null];

  const box = answerBox(top, beside, id, { onStop: () => asking.stop(), onBack: back });
  const form = scenarioForm(side, id, change);
  const drawn = scenarioResults(results, id, (changes) => change(changes, { key: null, settled: true }));
  const trace = scenarioTrace(drawn.trace, id, ask, (changes) => {
    asked = changedQuery(asked, changes);
    onTrace(textOf(asked));
  });
  const asking = asker((text, signal) => ask("view", text, signal), {
    answered(answered, text) {
      const instead = view === null && refusal !== null;
      view = answered;
      if (!instead || text !== "") refusal = null;
      frame ??= requestAnimationFrame(draw);
    },
    refused(text) {
      refusal = text;
      if (view === null) asking.want("");
      else refuse();
    },
    ...unanswered(box, stale),
  });
  asking.want(query);

  function draw() {
    frame = null;
    box.show(view);
    form.show(view, force);
    drawn.show(view);
    trace.show(view);
    force = false;
    form.refuse("");
    stale(false);
    if (refusal !== null) refuse();
    root.dataset.shown = view.query;
  }

  /** A link that is refused leaves the scenario as its file says it. */
  function refuse() {
    const beside = form.refuse(refusal);
    box.refused(beside ? "That cannot be: why is said beside what was changed." : refusal, true);
    stale(true);
  }

  function stale(is) {
    root.classList.toggle("ss-stale", is);
  }

  /** Another run is looked at from where its own first miss is, and what takes long is asked for anew. */
  function change(changes, how) {
    const sameRun = Object.keys(changes).every((key) => ["shown", "exact", "accuracy"].includes(key));
    asked = changedQuery(asked, sameRun ? changes : { ...changes, at: null, exact: null, accuracy: null });
    onQuery(textOf(asked), how);
    asking.want(textOf(asked));
  }

  function back() {
    if (view !== null) show(view.query);
    onQuery(textOf(asked), { key: null, settled: true });
  }

  /** Shows what another link says, and tells nobody. */
  function show(text) {
    asked = queryOf(text);
    force = true;
    asking.want(text);
  }

  function destroy() {
    cancelAnimationFrame(frame);
    asking.destroy();
    box.destroy();
    drawn.destroy();
    trace.destroy();
    root.remove();
  }

  return { show, destroy };
}

// The trace of a scenario's run: some steps of it as a Gantt chart, to be scrolled through from its first step to its last.

import { traceControls } from "./scenariosteps.js";
import { ganttChart } from "./gantt.js";
import { jobsTable } from "./jobs.js";
import { html } from "./svg.js";

const AFTER_MISS_STEPS = 2;

/** The section in `host`; ids begin with `id`. `ask(path, query, signal)` promises windows ("schedule") and misses
 *  ("next"); `onMove({at, span})` hears which steps are shown. */
export function scenarioTrace(host, id, ask, onMove) {
  const chartPlace = html("div");
  const tablePlace = html("div");
  const jobs = html("details", {}, html("summary", {}, "Its jobs as a table"), tablePlace);
  const steps = traceControls(id, { onMove: move, onFind: (of) => find(of), onStop: () => stop() });
  const heading = html("h2", { id: `${id}-trace` }, "The trace");
  host.append(html("section", { class: "ss-section ss-trace", "aria-labelledby": `${id}-trace` }, heading, steps.element, chartPlace, jobs));
  const chart = ganttChart(chartPlace);
  let [run, view, schedule, cursor] = [null, null, null, null];
  let [wanted, under, note] = [null, null, ""];
  jobs.addEventListener("toggle", () => jobs.open && schedule && jobsTable(tablePlace, schedule));

  function show(next) {
    const other = run !== runOf(next);
    view = next;
    run = runOf(next);
    if (!other) return;
    [schedule, cursor, note] = [null, null, ""];
    steps.fit(next.trace);
    want(steps.place());
  }

  function move() {
    [cursor, note] = [null, ""];
    go();
  }

  function go() {
    const place = steps.place();
    onMove({ at: String(place.at), span: String(place.span) });
    want(place);
  }

  /** One window at a time is asked for, and of the later ones only the last. */
  async function want(place) {
    wanted = place;
    if (under !== null) return;
    while (wanted !== null) {
      const next = wanted;
      wanted = null;
      const query = `first=${next.at}&until=${Math.min(next.at + next.span, view.trace.steps)}`;
      const found = await answered("schedule", query, (answer) => answer.schedule !== null || wanted !== null);
      if (found?.schedule && wanted === null) draw(found.schedule);
    }
  }

  function draw(next) {
    schedule = next;
    chart.show(next);
    if (jobs.open) jobsTable(tablePlace, next);
    chartPlace.dataset.first = next.origin;
    steps.told(view, note);
  }

  async function find(of) {
    stop();
    const place = steps.place();
    const after = cursor ?? Math.max(place.at - 1, 0);
    const found = await answered("next", `after=${after}&of=${of}`, (answer) => answer.found !== null || answer.simulated === answer.steps);
    if (found === null) return;
    if (found.found === null) return steps.say(`No later ${of === "miss" ? "miss" : "late landing"}; the run has ended.`);
    cursor = found.found.deadline;
    note = `: ${found.found.kind} of step ${found.found.step} misses its deadline, step ${cursor}`;
    steps.put(Math.ceil(cursor) + AFTER_MISS_STEPS - place.span);
    go();
  }

  /** What is answered in the end, when `done`; null if it was stopped or refused, which is said. */
  async function answered(path, query, done) {
    const [controller, of] = [new AbortController(), run];
    under = controller;
    try {
      for (;;) {
        const answer = await ask(path, `${of && `${of}&`}${query}`, controller.signal);
        if (controller.signal.aborted) return null;
        if (done(answer) || of !== run) return of === run ? answer : null;
        steps.simulating(answer);
      }
    } catch (error) {
      if (!controller.signal.aborted) steps.say(error.message);
      return null;
    } finally {
      if (under === controller) under = null;
    }
  }

  function stop() {
    wanted = null;
    under?.abort();
    under = null;
    steps.told(view, note);
  }

  function destroy() {
    stop();
    chart.destroy();
  }

  return { show, destroy };
}

/** What of a view's query says which run it is. */
function runOf({ query }) {
  const said = new URLSearchParams(query);
  return new URLSearchParams(["seed", "steps", "times_slower"].filter((key) => said.has(key)).map((key) => [key, said.get(key)])).toString();
}

// How a scenario's times are spread: its jobs, its sensors, and the accuracy at its output.

import { histogram } from "./histogram.js";
import { ageHistogram, jobHistogram, landingHistogram, outputHistogram } from "./scenariospread.js";
import { runJobColumns, sensorColumns } from "./scenariocolumns.js";
import { digits, html } from "./svg.js";
import { table } from "./table.js";

/** The sections in `host`, and between them `trace`, a place for the trace; ids begin with `id`. `onChange(changes)` hears what their buttons write into the query. */
export function scenarioResults(host, id, onChange) {
  const place = () => html("div");
  const [jobs, sensors, job, landing, output] = [place(), place(), place(), place(), place()];
  const section = (name, text, ...children) => {
    const element = html("section", { class: "ss-section", "aria-labelledby": `${id}-${name}` }, html("h2", { id: `${id}-${name}` }, text), ...children);
    host.append(element);
    return element;
  };
  const exact = slowPart("Find the exact probabilities", () => onChange({ exact: "yes" }));
  const along = slowPart("Find the accuracy along the run", () => onChange({ accuracy: "yes" }));
  const busy = html("p", { class: "ss-scenario-told" });
  section("deadlines", "Deadlines", busy, jobs, exact.element);
  const told = html("p", { class: "ss-scenario-told" });
  section("spread", "How the times are spread", told, html("div", { class: "ss-plots" }, job, landing));
  const trace = place();
  host.append(trace);
  section("sensors", "Measurements, and the step l = k + … in which their corrections landed", sensors);
  const ages = html("div", { class: "ss-plots" }, output);
  const said = html("p", { class: "ss-scenario-accuracy" });
  const remarks = html("ul", { class: "ss-reasons" });
  const accuracy = section("accuracy", "What it is worth at the output", said, along.element, ages, remarks);
  const [jobPlot, landingPlot, outputPlot] = [histogram(job), histogram(landing), histogram(output)];
  let agePlots = [];

  function show(view) {
    const shown = view.jobs.find(({ kind }) => kind === view.shown);
    const of = view.sensors.find(({ name }) => name === shown.sensor) ?? view.sensors[0];
    table(jobs, {
      caption: `Response times in ${view.unit}`,
      columns: runJobColumns(view),
      rows: view.jobs,
      current: view.jobs.indexOf(shown),
      onPick: ({ kind }) => onChange({ shown: kind }),
    });
    table(sensors, {
      caption: "Land by: the last step that meets the deadline",
      columns: sensorColumns(view),
      rows: view.sensors,
      current: view.sensors.indexOf(of),
      onPick: ({ kind }) => onChange({ shown: kind }),
    });
    busy.textContent = busyWords(view);
    exact.show(view.exact, exactWords(view));
    told.textContent = sentenceOf(shown);
    job.hidden = shown.histogram === null;
    if (shown.histogram !== null) jobPlot.show(jobHistogram(view, shown));
    landing.hidden = of.L.length === 0;
    if (of.L.length > 0) landingPlot.show(landingHistogram(of));
    showAccuracy(view);
  }

  function showAccuracy(view) {
    accuracy.hidden = view.accuracy_is === null;
    if (view.accuracy_is === null) return;
    along.show(view.accuracy_is, "");
    said.textContent = view.accuracy?.sentence ?? "";
    ages.hidden = view.accuracy === null;
    remarks.replaceChildren(...(view.accuracy?.remarks ?? []).map((remark) => html("li", {}, remark)));
    if (view.accuracy === null) return;
    outputPlot.show(outputHistogram(view.accuracy));
    const known = Object.entries(view.accuracy.ages).filter(([, age]) => age !== null);
    if (agePlots.length !== known.length) {
      for (const { plot, element } of agePlots) plot.destroy(element.remove());
      agePlots = known.map(() => agePlot(ages));
    }
    known.forEach(([sensor, age], index) => agePlots[index].plot.show(ageHistogram(sensor, age)));
  }

  function destroy() {
    for (const each of [jobPlot, landingPlot, outputPlot, ...agePlots.map(({ plot }) => plot)]) each.destroy();
  }

  return { trace, show, destroy };
}

function sentenceOf({ sentence, exact_miss: exact }) {
  const said = `${sentence[0].toUpperCase()}${sentence.slice(1)}.`;
  return exact === "" ? said : `${said} Exactly, P(miss): ${exact}.`;
}

function agePlot(host) {
  const element = html("div");
  host.append(element);
  return { element, plot: histogram(element) };
}

/** What may take long: a button that says what it costs, or why there is none. */
function slowPart(words, onClick) {
  const button = html("button", { type: "button", class: "ss-button" }, words);
  const text = html("span", { class: "ss-scenario-slow" });
  const element = html("p", {}, button, " ", text);
  button.addEventListener("click", onClick);
  return {
    element,
    show({ state, why, takes }, found) {
      button.hidden = state !== "not asked";
      text.textContent = state === "not asked" ? `It takes ${takes}.` : state === "none" ? `Not had exactly: ${why}.` : found;
      element.hidden = text.textContent === "";
    },
  };
}

function busyWords({ busy, demand }) {
  const shares = busy.map((share, cpu) => {
    const which = busy.length > 1 ? `Processor ${cpu + 1}` : "The processor";
    return `${which} is busy ${digits(100 * share, 3)} % of the time, for a demand of ${digits(100 * demand[cpu], 3)} %.`;
  });
  return shares.join(" ");
}

function exactWords({ exact, cycles }) {
  const found = `Exactly: for the costs as stated, each draw independent, in the mean of the first ${cycles.toLocaleString("en")} measurement cycles.`;
  return exact.why === "" ? found : `${found} ${exact.why}.`;
}

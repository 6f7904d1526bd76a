// What shows why: the designs side by side, the schedule, the curves, and the parts.

import { changedQuery, queryOf, textOf } from "./address.js";
import { html } from "./svg.js";
import { ganttChart } from "./gantt.js";
import { jobsTable } from "./jobs.js";
import { plot } from "./plot.js";
import { TRADEOFFS } from "./tradeoffs.js";
import { methodsTable, partsTable } from "./verdicts.js";

const NO_RATE = "Which parts do depends on the loop rate: give one.";
const NO_PARTS = /^no parts: /;

/**
 * The sections in `host`. `onTake(query)` hears of a design to be shown. `pinned` is the place between them for what is
 * compared.
 */
export function pictures(host, id, { onTake }) {
  const section = (name, title, ...children) => {
    const heading = html("h2", { id: `${id}-${name}` }, title);
    const named = { class: `ss-section ss-${name}`, "aria-labelledby": `${id}-${name}` };
    host.append(html("section", named, heading, ...children));
    return heading;
  };
  const place = () => html("div");
  const reasons = () => html("ul", { class: "ss-reasons", "aria-label": "Why not" });

  const methods = { host: place(), least: html("p", { class: "ss-least" }), why: reasons() };
  const heading = section("methods", "", methods.least, methods.host, methods.why);
  const pinned = place();
  host.append(pinned);
  const [drawn, listed] = [place(), place()];
  const jobs = html("details", {}, html("summary", {}, "Its jobs as a table"), listed);
  section("schedule", "The schedule", drawn, jobs);
  const chart = ganttChart(drawn);
  const places = TRADEOFFS.map(place);
  section("curves", "What it would take otherwise", html("div", { class: "ss-plots" }, ...places));
  const land = (landing) => (x, line) => {
    const L = String(landing(x, line));
    onTake(textOf(changedQuery(queryOf(line.query), { L, land_within_ms: null })));
  };
  const curves = TRADEOFFS.map(({ landing }, index) => plot(places[index], landing ? { onPick: land(landing) } : {}));
  const parts = { host: place(), why: reasons() };
  const none = html("p", {});
  section("parts", "Parts", parts.host, parts.why, none);
  let shown = null;
  jobs.addEventListener("toggle", () => jobs.open && shown !== null && jobsTable(listed, shown.schedule));

  return {
    pinned,
    /** Draws a view, with the pinned designs {letter, view} as marks. */
    show(view, pins) {
      shown = view;
      const { design: { within }, current: { unit } } = view;
      heading.textContent = within === null ? "Methods side by side" : `Designs that keep ${within} ${unit}`;
      methodsTable(methods, view, onTake);
      chart.show(view.schedule);
      if (jobs.open) jobsTable(listed, view.schedule);
      TRADEOFFS.forEach(({ of }, index) => {
        const curve = of(view, pins);
        places[index].hidden = curve === null;
        if (curve !== null) curves[index].show(curve);
      });
      parts.host.hidden = view.parts.length === 0;
      none.textContent = view.parts.length > 0 ? "" : view.period_ms === null ? NO_RATE : whyNone(view);
      partsTable(parts, view, onTake);
    },
    destroy() {
      chart.destroy();
      for (const curve of curves) curve.destroy();
    },
  };
}

/* One of the notes says it. */
function whyNone({ notes }) {
  const why = notes.find((note) => NO_PARTS.test(note)) ?? "no parts";
  return `${why[0].toUpperCase()}${why.slice(1)}.`;
}

// What shows why: the designs side by side, the schedule, the curves, and the parts.

import { changedQuery, queryOf, textOf } from "./address.js";
import { digits, html } from "./svg.js";
import { ganttChart } from "./gantt.js";
import { jobsTable } from "./jobs.js";
import { plot } from "./plot.js";
import { table } from "./table.js";

/**
 * The sections in `host`. `onTake(query)` hears of a design to be shown. `pinned` is the place between
 * them for what is compared.
 */
export function pictures(host, id, { onTake }) {
  const section = (name, ...children) => {
    const heading = html("h2", { id: `${id}-${name}` });
    const element = html("section", { class: `ss-section ss-${name}`, "aria-labelledby": `${id}-${name}` }, heading, ...children);
    host.append(element);
    return { element, heading };
  };
  const at = (name) => html("div", { class: name });
  const places = { methods: at("ss-place"), chart: at("ss-place"), jobs: at("ss-place"), parts: at("ss-place"), none: html("p", {}), least: html("p", { class: "ss-least" }) };
  const whyNot = () => html("ul", { class: "ss-reasons", "aria-label": "Why not" });
  const why = { methods: whyNot(), parts: whyNot() };
  const methods = section("methods", places.least, places.methods, why.methods);
  const pinned = at("ss-pinned");
  host.append(pinned);
  const jobs = html("details", {}, html("summary", {}, "Its jobs as a table"), places.jobs);
  section("schedule", places.chart, jobs).heading.textContent = "The schedule";
  const land = (x, { x: places, L, query }) => onTake(textOf(changedQuery(queryOf(query), { L: String(L[places.indexOf(x)]), land_within_ms: null })));
  const curves = PLOTS.map(({ picks }) => {
    const place = at("ss-place");
    return { place, plot: plot(place, picks ? { onPick: land } : {}) };
  });
  section("curves", html("div", { class: "ss-plots" }, ...curves.map(({ place }) => place))).heading.textContent = "What it would take otherwise";
  const parts = section("parts", places.parts, why.parts, places.none);
  parts.heading.textContent = "Parts";
  const chart = ganttChart(places.chart);
  let shown = null;
  jobs.addEventListener("toggle", () => jobs.open && shown && jobsTable(places.jobs, shown.schedule));

  return {
    pinned,
    /** Draws a view, with the pinned designs {letter, view} as marks. */
    show(view, pins) {
      shown = view;
      methods.heading.textContent = view.design.within === null ? "Methods side by side" : `Designs that keep ${view.design.within} ${view.current.unit ?? ""}`;
      methodsTable(places.methods, places.least, why.methods, view, onTake);
      chart.show(view.schedule);
      if (jobs.open) jobsTable(places.jobs, view.schedule);
      PLOTS.forEach((each, index) => {
        const drawn = each.of(view, [...pins, { letter: "this design", view, current: true }]);
        curves[index].place.hidden = drawn === null;
        if (drawn !== null) curves[index].plot.show(drawn);
      });
      places.parts.hidden = view.parts.length === 0;
      places.none.hidden = view.parts.length > 0;
      places.none.textContent = view.period_ms === null ? "Parts need a loop rate: give one above." : "No counted operations for these costs, so no parts.";
      partsTable(places.parts, why.parts, view, onTake);
    },
    destroy() {
      chart.destroy();
      for (const curve of curves) curve.plot.destroy();
    },
  };
}

function leastWords({ method, within: { part } }, step) {
  return `The least will do: ${method}, landed by step ${step}${part ? `, on ${part}` : ""}.`;
}

function methodsTable(host, least, why, view, onTake) {
  const asked = view.design.within !== null;
  const { unit } = view.current;
  const step = (L) => steps(L, L === null || view.period_ms === null ? null : L * view.period_ms);
  const keeps = ({ within }) => within !== null && !within.reason;
  const can = view.methods.filter(({ reason }) => !reason);
  const rows = asked ? [...can.filter(keeps).sort((a, b) => a.within.power - b.within.power), ...can.filter((row) => !keeps(row))] : can;
  const columns = asked ? [
    { key: "land", label: "land by step", numeric: true, text: ({ within }) => step(within?.L ?? null) },
    { key: "power", label: "least speed", numeric: true, text: ({ within }) => digits(within?.power) },
    { key: "part", label: "cheapest part", text: ({ within }) => within?.part ?? "–" },
    { key: "landed", label: "lands there at", numeric: true, text: ({ within }) => step(within?.landed ?? null) },
    { key: "std", label: `accuracy, ${unit}`, numeric: true, text: ({ within }) => digits(within?.landed_std ?? within?.std) },
  ] : [
    { key: "L", label: "land by step", numeric: true, text: ({ L }) => step(L) },
    { key: "power", label: "least speed", numeric: true, text: (row) => digits(row.power) },
    { key: "binding", label: "fixed by", text: ({ binding }) => binding ?? "–" },
    { key: "fits", label: "fits", holds: ({ fits }) => fits, text: ({ fits }) => (fits === null ? "" : fits ? "yes" : "no") },
    { key: "landed", label: "lands at", numeric: true, text: ({ achieved_l: L, landed_ms: ms }) => steps(L, ms) },
    ...(unit ? [{ key: "std", label: `accuracy, ${unit}`, numeric: true, text: ({ std }) => digits(std) }] : []),
  ].filter(({ key }) => key !== "fits" || rows.some(({ fits }) => fits !== null));
  table(host, {
    caption: `${asked ? "Pick a method: it is shown with the latest landing that keeps this, on that part" : "Pick a method to see it"}. Least speed: ${view.power.unit}`,
    columns: [{ key: "method", label: "method" }, ...columns],
    rows,
    onPick: (row) => onTake(asked && keeps(row) ? row.within.query : row.query),
    current: rows.findIndex(({ method }) => method === view.design.method),
  });
  const [best] = rows.filter((row) => asked && keeps(row) && row.method !== "standard");
  least.textContent = best ? leastWords(best, step(best.within.L)) : "";
  least.hidden = best === undefined;
  reasons(why, view.methods.map(({ method, reason, within }) => [method, reason || within?.reason]));
}

function partsTable(host, why, view, onTake) {
  const share = (value) => (value === null ? "–" : `${digits(100 * value.value, 3)} %`);
  const { unit } = view.current;
  table(host, {
    caption: `Pick a part to see ${view.design.method} on it. Those that do it come first, cheapest first`,
    columns: [
      { key: "title", label: "part", text: ({ title }) => briefTitle(title) },
      { key: "fits", label: "does it", holds: ({ fits }) => fits, text: ({ fits }) => (fits === null ? "" : fits ? "yes" : "no") },
      { key: "needed", label: "of its speed", numeric: true, text: ({ needed }) => share(needed) },
      { key: "load", label: "load", numeric: true, text: ({ load }) => share(load) },
      { key: "landed", label: "lands at", numeric: true, text: ({ landed, landed_ms: ms }) => steps(landed, ms) },
      ...(unit ? [{ key: "std", label: `accuracy, ${unit}`, numeric: true, text: ({ std }) => digits(std) }] : []),
    ],
    rows: view.parts,
    onPick: (row) => onTake(row.query),
    current: view.parts.findIndex(({ name }) => name === view.design.processor),
  });
  reasons(why, view.parts.map(({ title, reason }) => [briefTitle(title), reason]));
}

/* Why some do not, those with one reason together. */
function reasons(list, pairs) {
  const by = new Map();
  for (const [name, reason] of pairs) if (reason) by.set(reason, [...(by.get(reason) ?? []), name]);
  list.replaceChildren(...[...by].map(([reason, names]) => html("li", {}, html("b", {}, names.join(", ")), `: ${reason}`)));
  list.hidden = by.size === 0;
}

/* A part's title without what is special about it: "Arm Cortex-M4F at 168 MHz, e.g. STM32F407". */
function briefTitle(title) {
  const [name, example = ""] = title.split(", ");
  return example.startsWith("e.g.") ? `${name}, ${example}` : name;
}

function steps(L, ms) {
  if (L === null || L === undefined) return "–";
  return ms === null || ms === undefined ? String(L) : `${L} (${digits(ms)} ms)`;
}

const LINES = (view, of, step) => view.methods.flatMap((row) => {
  const [x, y, L = x, notes] = (row.reason ? null : of(row)) ?? [[], []];
  return x.length === 0 ? [] : [{ name: row.method, x, y, step, notes, L, query: row.query, current: row.method === view.design.method }];
});

const POINTS = (pins, of) => pins.map(({ letter, view, current = false }) => ({ ...of(view), label: letter, current }))
  .filter(({ x, y }) => x !== null && y !== null);

const ACCURACY = (view) => ({ label: `standard deviation (${view.current.unit ?? "1"})`, log: false });
const LIMIT = ({ design, current }) => (design.within === null ? null : { y: Number(design.within), label: `${design.within} ${current.unit ?? ""}` });

const PLOTS = [
  {
    picks: true,
    of: (view, pins) => ({
      title: "Land later, and a slower processor will do",
      x: { label: "L, step by which the correction has landed", log: false },
      y: { label: `least speed (${view.power.unit})`, log: true },
      lines: LINES(view, ({ staircase: { L, power } }) => [L, power], true),
      points: POINTS(pins, ({ design, current }) => ({ x: design.L, y: current.power })),
      limit: null,
    }),
  },
  {
    of: (view, pins) => ({
      title: "Where it lands on a faster processor",
      x: { label: `speed (${view.power.unit})`, log: true },
      y: { label: "l, step in which it lands", log: false },
      lines: LINES(view, ({ landing: { power, L } }) => [power, L], true),
      points: POINTS(pins, ({ current }) => ({ x: current.pace, y: current.achieved_l })),
      limit: null,
    }),
  },
  {
    picks: true,
    of: (view, pins) => (view.design.model === null ? null : {
      title: "What landing later costs in accuracy",
      x: { label: "step in which the correction lands", log: false },
      y: ACCURACY(view),
      lines: LINES(view, ({ accuracy }) => accuracy && [accuracy.L, accuracy.std], false),
      points: POINTS(pins, ({ current }) => ({ x: current.achieved_l, y: current.std })),
      limit: LIMIT(view),
    }),
  },
  {
    picks: true,
    of: (view, pins) => (view.design.model === null ? null : {
      title: "What a faster processor buys in accuracy",
      x: { label: `least speed (${view.power.unit})`, log: true },
      y: ACCURACY(view),
      lines: LINES(view, ({ front }) => front && [front.power, front.std, front.L, front.L.map((L) => `L ${L}`)], true),
      points: POINTS(pins, ({ current }) => ({ x: current.power, y: current.std_at_L })),
      limit: LIMIT(view),
    }),
  },
];

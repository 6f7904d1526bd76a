// What shows why: the designs side by side, the schedule, the curves, and the parts.

import { digits, html } from "./svg.js";
import { ganttChart } from "./gantt.js";
import { jobsTable } from "./jobs.js";
import { plot } from "./plot.js";
import { table } from "./table.js";

/**
 * The sections in `host`. `onTake(query)` hears of a design to be shown, `onLand(L)` of a step chosen in a plot.
 * `pinned` is the place between them for what is compared.
 */
export function pictures(host, id, { onTake, onLand }) {
  const section = (name, ...children) => {
    const heading = html("h2", { id: `${id}-${name}` });
    const element = html("section", { class: `ss-section ss-${name}`, "aria-labelledby": `${id}-${name}` }, heading, ...children);
    host.append(element);
    return { element, heading };
  };
  const at = (name) => html("div", { class: name });
  const places = { methods: at("ss-table"), chart: at("ss-chart"), jobs: at("ss-table"), parts: at("ss-table"), none: html("p", {}) };
  const methods = section("methods", places.methods);
  const pinned = at("ss-pinned");
  host.append(pinned);
  const jobs = html("details", {}, html("summary", {}, "Its jobs as a table"), places.jobs);
  section("schedule", places.chart, jobs).heading.textContent = "The schedule";
  const curves = PLOTS.map(({ land }) => {
    const place = at("ss-plot");
    return { place, plot: plot(place, land ? { onPick: (L) => onLand(L) } : {}) };
  });
  section("curves", html("div", { class: "ss-plots" }, ...curves.map(({ place }) => place))).heading.textContent = "What it would take otherwise";
  const parts = section("parts", places.parts, places.none);
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
      methodsTable(places.methods, view, onTake);
      chart.show(view.schedule);
      if (jobs.open) jobsTable(places.jobs, view.schedule);
      PLOTS.forEach((each, index) => {
        const drawn = each.of(view, [...pins, { letter: "", view, current: true }]);
        curves[index].place.hidden = drawn === null;
        if (drawn !== null) curves[index].plot.show(drawn);
      });
      places.parts.hidden = view.parts.length === 0;
      places.none.hidden = view.parts.length > 0;
      places.none.textContent = view.period_ms === null ? "Parts need a loop rate: give one above." : "No counted operations for these costs, so no parts.";
      if (view.parts.length > 0) partsTable(places.parts, view, onTake);
    },
    destroy() {
      chart.destroy();
      for (const curve of curves) curve.plot.destroy();
    },
  };
}

function methodsTable(host, view, onTake) {
  const asked = view.design.within !== null;
  const { unit } = view.current;
  const step = (L, ms = L === null || view.period_ms === null ? null : L * view.period_ms) => steps(L, ms);
  const why = (row) => row.reason || row.within?.reason || (row.fits === false ? "misses deadlines" : "");
  const speed = view.period_ms === null || view.design.processor === null ? "least speed" : `least speed, ${view.power.short}`;
  const columns = asked ? [
    { key: "land", label: "land by step", numeric: true, text: ({ within }) => step(within?.L ?? null) },
    { key: "power", label: speed, numeric: true, text: ({ within }) => digits(within?.power) },
    { key: "part", label: "cheapest part", text: ({ within }) => within?.part ?? "–" },
    { key: "landed", label: "lands there at", numeric: true, text: ({ within }) => step(within?.landed ?? null) },
    { key: "std", label: `accuracy, ${unit ?? ""}`, numeric: true, text: ({ within }) => digits(within?.landed_std ?? within?.std) },
  ] : [
    { key: "L", label: "land by step", numeric: true, text: ({ L }) => step(L) },
    { key: "power", label: speed, numeric: true, text: (row) => digits(row.power) },
    { key: "binding", label: "fixed by", text: ({ binding }) => binding ?? "–" },
    { key: "landed", label: "lands at", numeric: true, text: ({ achieved_l: L, landed_ms: ms }) => step(L, ms) },
    ...(unit ? [{ key: "std", label: `accuracy, ${unit}`, numeric: true, text: ({ std }) => digits(std) }] : []),
  ];
  const keeps = ({ reason, within }) => !reason && within && !within.reason;
  const rank = (row) => (keeps(row) ? row.within.power ?? Infinity : Infinity);
  const rows = asked ? [...view.methods].sort((a, b) => keeps(b) - keeps(a) || (keeps(a) ? rank(a) - rank(b) : 0)) : view.methods;
  table(host, {
    caption: asked ? "Each method at the latest landing that is accurate enough, on the cheapest part that does it" : "Each method with your timing",
    columns: [{ key: "method", label: "method" }, ...columns, ...unless(rows, why)],
    rows,
    onPick: (row) => onTake(asked && keeps(row) ? row.within.query : row.query),
    current: rows.findIndex(({ method }) => method === view.design.method),
  });
}

function partsTable(host, view, onTake) {
  const share = (value) => (value === null ? "–" : `${digits(100 * value.value, 3)} %`);
  table(host, {
    caption: `Parts that can run ${view.design.method} with this timing, cheapest first`,
    columns: [
      { key: "title", label: "part", text: ({ title }) => title },
      { key: "fits", label: "does it", holds: ({ fits }) => fits, text: ({ fits }) => (fits ? "yes" : "no") },
      { key: "needed", label: "of its speed", numeric: true, text: ({ needed }) => share(needed) },
      { key: "load", label: "load", numeric: true, text: ({ load }) => share(load) },
      { key: "landed", label: "lands at", numeric: true, text: ({ landed, landed_ms: ms }) => steps(landed, ms) },
      { key: "std", label: `accuracy, ${view.current.unit ?? ""}`, numeric: true, text: ({ std }) => digits(std) },
      ...unless(view.parts, ({ reason }) => reason || ""),
    ],
    rows: view.parts,
    onPick: (row) => onTake(row.query),
    current: view.parts.findIndex(({ name }) => name === view.design.processor),
  });
}

/* The column of reasons, where there are any. */
const unless = (rows, text) => (rows.some((row) => text(row) !== "") ? [{ key: "why", label: "why not", text }] : []);

function steps(L, ms) {
  if (L === null || L === undefined) return "–";
  return ms === null || ms === undefined ? String(L) : `${L} (${digits(ms)} ms)`;
}

const LINES = (view, of, step) => view.methods.flatMap((row) => {
  const [x, y] = of(row) ?? [[], []];
  return x.length === 0 ? [] : [{ name: row.method, x, y, step, current: row.method === view.design.method }];
});

const POINTS = (pins, of) => pins.map(({ letter, view, current = false }) => ({ ...of(view), label: letter, current }))
  .filter(({ x, y }) => x !== null && y !== null);

const ACCURACY = (view) => ({ label: `standard deviation (${view.current.unit ?? "1"})`, log: false });
const LIMIT = ({ design, current }) => (design.within === null ? null : { y: Number(design.within), label: `${design.within} ${current.unit ?? ""}` });

const PLOTS = [
  {
    land: true,
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
    land: true,
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
    of: (view, pins) => (view.design.model === null ? null : {
      title: "What a faster processor buys in accuracy",
      x: { label: `least speed (${view.power.unit})`, log: true },
      y: ACCURACY(view),
      lines: LINES(view, ({ front }) => front && [front.power, front.std], true),
      points: POINTS(pins, ({ current }) => ({ x: current.power, y: current.std_at_L })),
      limit: LIMIT(view),
    }),
  },
];

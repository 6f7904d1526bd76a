// The controls in their order: their words, their limits, and what a change of each writes into the query.

import { stepsInMs } from "./address.js";
import { evenStops, roundedTo, roundStops, wholeStops } from "./stops.js";

/*
A number has key, label, help, and of the context {query, view, mode}: `value`, `unit`, `stops`; `write(text, stop)`
gives the changes. `twin` is the same in the other mode; what is refused about it is shown here. `empty`: see numberField.
*/
const IN_TIMES = (context) => context.mode === "times";
const IN_STEPS = (context) => context.mode === "steps";

const LOOP_RATE = {
  key: "hr_hz", label: "Loop rate", help: "of your IMU: the filter propagates at each tick",
  value: ({ query }) => query.get("hr_hz") ?? "",
  unit: () => "Hz",
  stops: loopStops,
  write: (text, stop, context) => ({ hr_hz: text, ...landingInMs(context) }),
};

const TIMING = [
  { ...LOOP_RATE, shown: IN_TIMES },
  {
    key: "measurement_hz", twin: "N", label: "Measurement rate", help: "of your GPS, camera or star tracker", shown: IN_TIMES,
    value: ({ query, view }) => query.get("measurement_hz") ?? sixDigits(1000 / (view.period_ms * view.design.N)),
    unit: () => "Hz",
    stops: ({ view }) => {
      const [first, last] = view.limits.N.map((steps) => 1000 / (view.period_ms * steps));
      return roundStops(roundedTo(last, 4, Math.ceil), roundedTo(first, 3, Math.floor));
    },
    write: (text) => ({ measurement_hz: text, N: null }),
  },
  {
    key: "delay_ms", twin: "M", label: "Delay", help: "from the instant measured until the filter has it", shown: IN_TIMES,
    value: ({ query, view }) => query.get("delay_ms") ?? sixDigits(view.period_ms * view.design.M),
    unit: () => "ms",
    stops: ({ view }) => {
      const [first, last] = view.limits.M.map((steps) => steps * view.period_ms);
      return evenStops(roundedTo(first, 3, Math.ceil), roundedTo(last, 3, Math.floor));
    },
    write: (text) => ({ delay_ms: text, M: null }),
  },
  {
    key: "N", twin: "measurement_hz", label: "N", help: "steps from one measurement to the next", shown: IN_STEPS,
    value: ({ query, view }) => query.get("N") ?? String(view.design.N),
    unit: () => "steps",
    stops: ({ view }) => wholeStops(...view.limits.N),
    write: (text) => ({ N: text, measurement_hz: null }),
  },
  {
    key: "M", twin: "delay_ms", label: "M", help: "steps by which a measurement is late", shown: IN_STEPS,
    value: ({ query, view }) => query.get("M") ?? String(view.design.M ?? ""),
    unit: () => "steps",
    stops: ({ view }) => wholeStops(...view.limits.M),
    write: (text) => ({ M: text, delay_ms: null }),
  },
  {
    ...LOOP_RATE, shown: IN_STEPS, help: "steps per second; needed for parts and milliseconds",
    empty: { place: "first", words: "unknown" },
    stops: () => roundStops(1, 10000),
    write: (text) => ({ hr_hz: text }),
  },
];

const NEED = [
  {
    key: "within", label: "Needed accuracy", help: ({ view }) => `one sigma, ${view.design.metric === "rms" ? "root mean square" : "at its worst"}`,
    shown: ({ view }) => view.design.model !== null,
    empty: { place: "last", words: "any" },
    value: ({ query }) => query.get("within") ?? "",
    unit: ({ view }) => unitOf(view),
    stops: accuracyStops,
    write: (text) => ({ within: text }),
  },
  {
    key: "model", label: "Model", help: "what the filter estimates, from which sensors",
    options: ({ view }) => [{ value: "", words: "none: costs alone, no accuracy" }, ...titledChoices(view.choices.model)],
    write: (value) => ({ model: value, output: null, ...(value === "" ? { within: null } : {}) }),
  },
  {
    key: "output", label: "Output", help: "what has to be so accurate",
    shown: ({ view }) => outputsOf(view).length > 1,
    options: ({ view }) => outputsOf(view).map(({ name, unit }) => ({ value: name, words: unit ? `${name}, ${unit}` : name })),
    write: (value) => ({ output: value }),
  },
];

const DESIGN = [
  {
    key: "processor", label: "Processor", help: "without one all parts are compared, and the speed is the least that will do",
    options: ({ view }) => [{ value: "", words: "none: compare all" }, ...titledChoices(view.choices.processor)],
    write: (value) => ({ processor: value }),
  },
  {
    key: "method", label: "Method", help: "how a late measurement gets into the filter",
    options: ({ view }) => choicesOf(view.choices.method),
    write: (value) => ({ method: value }),
  },
  {
    key: "L", twin: "land_within_ms", label: "Land by", help: "when the correction has to be in the output",
    empty: { place: "last", words: "latest" },
    value: ({ query, view, mode }) => {
      if (mode === "steps") return query.has("L") || query.has("land_within_ms") ? String(view.design.L) : "";
      return query.get("land_within_ms") ?? (query.has("L") ? sixDigits(Number(query.get("L")) * view.period_ms) : "");
    },
    unit: ({ mode }) => (mode === "steps" ? "steps" : "ms"),
    stops: ({ view, mode }) => {
      const steps = wholeStops(...view.limits.L).slice(0, -1);
      return mode === "steps" ? steps : steps.map((L) => Number(sixDigits(L * view.period_ms)));
    },
    write: (text, stop, { mode, view }) => {
      if (mode === "steps" || text === "") return { L: text, land_within_ms: null };
      if (stop === null) return { land_within_ms: text, L: null };
      return { L: String(Math.round(stop / view.period_ms)), land_within_ms: null };
    },
  },
];

const FURTHER_OPTIONS = [
  {
    key: "speed", label: "Speed", help: ({ view }) => `of the processor, in ${view.power.unit}`,
    empty: { place: "first", words: "least" },
    shown: ({ view }) => view.design.processor === null,
    value: ({ query }) => query.get("speed") ?? "",
    unit: () => "",
    stops: ({ view }) => roundStops(...[0.5, 10].map((times) => Number((times * view.current.power).toPrecision(2)))),
    write: (text) => ({ speed: text }),
  },
  optionChoice("lr_propagate_by", "Low-rate propagation", "due when the measurement arrives, or when its correction lands",
    { m: "by m, the paper's rule", l: "by l, needs less for small delays" }),
  optionChoice("feedback", "Feedback", "when a correction is applied",
    { "next-step": "in the next step", "same-step": "as soon as it is known" }),
  optionChoice("gain", "Gain", "computed when the measurement is there, or before",
    { "at-update": "at the update", precomputed: "before it arrives" }),
  optionChoice("low_rate_noise", "Low-rate noise", "how process noise is summed over the steps",
    { exact: "exact, Eq. 18", sum: "sum, Eq. 23", euler: "Euler, Eq. 24" }),
  optionChoice("cpus", "CPUs", "2: high-rate jobs on one, low-rate jobs on the other", {}),
  {
    key: "context_switch", label: "Context switch", help: "work of each, in cost units (seconds on a processor)",
    empty: { place: "first", words: "0" },
    value: ({ query }) => query.get("context_switch") ?? "",
    unit: () => "",
    stops: ({ view }) => (view.design.processor === null ? evenStops(0.001, 0.1) : roundStops(1e-7, 1e-4, 1)),
    write: (text) => ({ context_switch: text }),
  },
  optionChoice("policy", "Policy", "which job runs first", { fixed: "fixed priorities", edf: "earliest deadline first" }),
  {
    key: "costs", label: "Costs", help: "the table of what each job takes",
    options: ({ view }) => [{ value: "", words: "as fits model and processor" }, ...choicesOf(view.choices.costs)],
    write: (value) => ({ costs: value }),
  },
  optionChoice("statistic", "Statistic", "which of a measured cost's figures", {}),
  optionChoice("metric", "Accuracy is", "of the steps between measurements", { worst: "that of the worst step", rms: "the root mean square" }),
  {
    key: "cycles", label: "Cycles drawn", help: "measurement intervals in the chart",
    value: ({ view }) => String(view.design.cycles),
    unit: () => "",
    stops: () => wholeStops(1, 10),
    write: (text) => ({ cycles: text }),
  },
];

/** The groups of the form, each {legend, fields}. */
export const GROUPS = [
  { legend: "What you have", fields: TIMING, mode: true },
  { legend: "What you need", fields: NEED },
  { legend: "The design", fields: DESIGN },
  { legend: "Further options", fields: FURTHER_OPTIONS, folded: true },
];

/** The field that a refusal is about, by its key and those of its twins: the one changed last, if it is mentioned or
nothing is; else what is mentioned first. Null where it is about none. */
export function fieldRefused(text, changes, fields) {
  const places = fields.map((field) => [field, Math.min(...[field.key, field.twin].filter(Boolean).map((key) => placeOf(text, key)))]);
  const said = places.filter(([, at]) => at < Infinity).sort((a, b) => a[1] - b[1]).map(([field]) => field);
  const last = fields.find((field) => changes.includes(field.key) || changes.includes(field.twin));
  return said.includes(last) || said.length === 0 ? last ?? null : said[0];
}

function placeOf(text, key) {
  const at = text.search(new RegExp(`(?<![\\w-])(--?)?${key.replaceAll("_", "[-_]")}(?![\\w-])`));
  return at < 0 ? Infinity : at;
}

function optionChoice(key, label, help, words) {
  return {
    key, label, help,
    options: ({ view }) => choicesOf(view.choices[key] ?? []).map(({ value }) => ({ value, words: words[value] ?? value })),
    shown: ({ view }) => (view.choices[key] ?? []).length > 1,
    write: (value) => ({ [key]: value }),
  };
}

const choicesOf = (names) => names.map((name) => ({ value: String(name), words: String(name) }));
const titledChoices = (entries) => entries.map(({ name, title }) => ({ value: name, words: title }));
const sixDigits = (value) => String(Number(value.toPrecision(6)));

function outputsOf(view) {
  return view.choices.model.find(({ name }) => name === view.design.model)?.outputs ?? [];
}

function unitOf(view) {
  return outputsOf(view).find(({ name }) => name === view.design.output)?.unit ?? view.current.unit ?? "";
}

function accuracyStops({ view }) {
  const all = view.methods.flatMap(({ accuracy }) => accuracy?.std ?? []).filter((std) => std > 0);
  if (all.length === 0) return [];
  const [least, most] = [Math.min(...all), Math.max(...all)];
  const margin = Math.max((most - least) / 4, most / 20);
  return evenStops(roundedTo(Math.max(least - margin, most / 1000), 3, Math.ceil), roundedTo(most + margin, 3, Math.ceil)).slice(1, -1);
}

/* Rates at which delay and landing still fit between measurements, as they do now. */
function loopStops({ query, view }) {
  const { N, M } = view.design;
  const [hz, delay] = ["measurement_hz", "delay_ms"].map((key) => (query.has(key) ? Number(query.get(key)) : null));
  const stops = roundStops(10, 10000);
  if (Number.isNaN(hz) || Number.isNaN(delay)) return stops;
  const left = N - view.limits.M[1];
  const after = view.limits.L[0] - (M ?? 0);
  const landing = query.has("land_within_ms") ? Number(query.get("land_within_ms")) : query.has("L") ? view.design.L * view.period_ms : null;
  return stops.filter((hr) => {
    const every = hz === null ? N : Math.floor(hr / hz + 1e-9);
    const late = delay === null ? M ?? 0 : Math.ceil((delay * hr) / 1000 - 1e-9);
    const by = landing === null ? Infinity : Math.floor((landing * hr) / 1000 + 1e-9) - 1;
    return every >= 1 && every <= Math.max(N, view.limits.N[1]) && (left < 0 || late <= every - left) && (by >= late + after || landing === null);
  });
}

/* A landing in steps is meant in milliseconds where the rate changes. */
function landingInMs({ query, view }) {
  return query.has("L") && query.has("hr_hz") ? { L: null, land_within_ms: stepsInMs(view.design.L, query.get("hr_hz")) } : {};
}

// The controls in their order: their words, their limits, and what a change of each writes into the query.

import { stepsInMs } from "./address.js";
import { FURTHER_OPTIONS, plainChoices } from "./furtherfields.js";
import { METHOD_WORDS } from "./methodwords.js";
import { evenStops, roundedTo, roundStops, wholeStops } from "./stops.js";

/*
A number has key, label, help, and of the context {query, view, mode}: `value`, `unit`, `stops`; `write(text, stop)`
gives the changes. `twin` is the same in the other mode; what is refused about it is shown here. `empty`: see
numberField.
*/
const IN_TIMES = (context) => context.mode === "times";
const IN_STEPS = (context) => context.mode === "steps";

const NO_MODEL = { value: "", words: "none: costs alone, no accuracy" };
const NO_PROCESSOR = { value: "", words: "none: compare all" };

const LOOP_RATE = {
  key: "hr_hz", label: "Loop rate", help: "of your IMU: at each tick the filter propagates, in a high-rate (HR) job",
  value: ({ query }) => query.get("hr_hz") ?? "",
  unit: () => "Hz",
  stops: loopStops,
  write: (text, stop, context) => ({ hr_hz: text, ...landingInMs(context) }),
};

const TIMING = [
  { ...LOOP_RATE, shown: IN_TIMES },
  {
    key: "measurement_hz", twin: "N", label: "Measurement rate", help: "of your GPS, camera or star tracker",
    shown: IN_TIMES,
    value: ({ query, view }) => query.get("measurement_hz") ?? sixDigits(1000 / (view.period_ms * view.design.N)),
    unit: () => "Hz",
    stops: ({ view }) => {
      const [first, last] = view.limits.N.map((steps) => 1000 / (view.period_ms * steps));
      return roundStops(roundedTo(last, 4, Math.ceil), roundedTo(first, 3, Math.floor));
    },
    write: (text) => ({ measurement_hz: text, N: null }),
  },
  {
    key: "delay_ms", twin: "M", label: "Delay", help: "from the instant measured until the filter has it",
    shown: IN_TIMES,
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
    key: "within", label: "Needed accuracy",
    help: ({ view }) => `one sigma, ${view.design.metric === "rms" ? "root mean square" : "at its worst"}`,
    shown: ({ view }) => view.design.model !== null,
    empty: { place: "last", words: "any" },
    value: ({ query }) => query.get("within") ?? "",
    unit: ({ view }) => unitOf(view),
    stops: accuracyStops,
    write: (text) => ({ within: text }),
  },
  {
    key: "model", label: "Model", help: "what the filter estimates, from which sensors; its rates and delay are those above",
    options: ({ view }) => [NO_MODEL, ...titledChoices(view.choices.model)],
    write: (value) => ({ model: value, output: null, ...(value === "" ? { within: null } : {}) }),
  },
  {
    key: "output", label: "Output", help: "what has to be so accurate",
    shown: ({ view }) => outputsOf(view).length > 1,
    options: ({ view }) => outputsOf(view).map(outputChoice),
    write: (value) => ({ output: value }),
  },
];

const DESIGN = [
  {
    key: "processor", label: "Processor",
    help: "without one all parts are compared, and the speed is the least that will do",
    options: ({ view }) => [NO_PROCESSOR, ...titledChoices(view.choices.processor)],
    write: (value) => ({ processor: value }),
  },
  {
    key: "method", label: "Method",
    help: ({ view }) => METHOD_WORDS[view.design.method] ?? "how a late measurement gets into the filter",
    options: ({ view }) => plainChoices(view.choices.method),
    write: (value) => ({ method: value }),
  },
  {
    key: "L", twin: "land_within_ms", label: "Land by", help: "when the correction has to be in the output",
    empty: { place: "last", words: "latest" },
    value: ({ query, view, mode }) => {
      if (mode === "steps") return query.has("L") || query.has("land_within_ms") ? String(view.design.L) : "";
      const said = query.has("L") ? sixDigits(Number(query.get("L")) * view.period_ms) : "";
      return query.get("land_within_ms") ?? said;
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

/** The groups of the form, each {legend, fields}. */
export const GROUPS = [
  { legend: "What you have", fields: TIMING, mode: true },
  { legend: "What you need", fields: NEED },
  { legend: "The design", fields: DESIGN },
  { legend: "Further options", fields: FURTHER_OPTIONS, folded: true },
];

/** The field that a refusal is about, by its key and that of its twin: the one changed last, if it is mentioned or
 *  nothing is; else what is mentioned first, before the remedy. Null where it is about none. */
export function fieldRefused(text, changes, fields) {
  const [fault] = text.split(": ");
  const first = ({ key, twin = key }) => Math.min(placeOf(fault, key), placeOf(fault, twin));
  const places = fields.map((field) => [field, first(field)]);
  const said = places.filter(([, at]) => at < Infinity).sort((a, b) => a[1] - b[1]).map(([field]) => field);
  const last = fields.find((field) => changes.includes(field.key) || changes.includes(field.twin));
  return said.includes(last) || said.length === 0 ? last ?? null : said[0];
}

/** A refusal in the words of the page: "Delay 300" for "delay_ms 300". What is meant for a terminal stays. */
export function inPageWords(text) {
  const named = GROUPS.flatMap(({ fields }) => fields).map(({ key, label }) => [key, label]);
  const labels = new Map([["land_within_ms", "Land by"], ...named]);
  const worded = (part) => part.replace(/^\w+(?= is )|(?<![\w-])\w+_\w+(?![\w=])/g, (key) => labels.get(key) ?? key);
  return text.split("`").map((part, index) => (index % 2 ? `\`${part}\`` : worded(part))).join("");
}

/** A view whose texts are in the words of the page. */
export function viewInPageWords(view) {
  const { answer, warnings, notes, methods, parts } = view;
  const worded = (row) => ({ ...row, reason: row.reason && inPageWords(row.reason) });
  return {
    ...view,
    answer: { ...answer, sentence: inPageWords(answer.sentence) },
    warnings: warnings.map(inPageWords),
    notes: notes.map(inPageWords),
    methods: methods.map((row) => ({ ...worded(row), within: row.within && worded(row.within) })),
    parts: parts.map(worded),
  };
}

/* A key that is an ordinary word, too, is meant where a text begins with it, or a value follows: the least speed is no
   field. */
function placeOf(text, key) {
  const name = `(?<![\\w-])(--?)?${key.replaceAll("_", "[-_]")}(?![\\w-])`;
  const at = text.search(new RegExp(/^[a-z]+$/.test(key) ? `^${name}|${name}(?=[= ]['\\d])` : name));
  return at < 0 ? Infinity : at;
}

function titledChoices(entries) {
  return entries.map(({ name, title }) => ({ value: name, words: title }));
}

function sixDigits(value) {
  return String(Number(value.toPrecision(6)));
}

function outputsOf(view) {
  return view.choices.model.find(({ name }) => name === view.design.model)?.outputs ?? [];
}

function unitOf(view) {
  return outputsOf(view).find(({ name }) => name === view.design.output)?.unit ?? view.current.unit ?? "";
}

function outputChoice({ name, unit }) {
  return { value: name, words: unit ? `${name}, ${unit}` : name };
}

function accuracyStops({ view }) {
  const all = view.methods.flatMap(({ accuracy }) => accuracy?.std ?? []).filter((std) => std > 0);
  if (all.length === 0) return [];
  const [least, most] = [Math.min(...all), Math.max(...all)];
  const margin = Math.max((most - least) / 4, most / 20);
  const [first, last] = [Math.max(least - margin, most / 1000), most + margin];
  return evenStops(Number(first.toPrecision(3)), Number(last.toPrecision(3))).slice(1, -1);
}

/* Rates at which delay and landing still fit between measurements, as they do now. */
function loopStops({ query, view }) {
  const stops = roundStops(10, 10000);
  const { limits, design: { N, M } } = view;
  const of = (key) => (query.has(key) ? Number(query.get(key)) : null);
  const [hz, delay, said] = ["measurement_hz", "delay_ms", "land_within_ms"].map(of);
  const landing = said ?? (query.has("L") ? view.design.L * view.period_ms : null);
  const between = N - limits.M[1];
  const after = limits.L[0] - (M ?? 0);
  return stops.filter((hr) => {
    const every = hz === null ? N : Math.floor(hr / hz + 1e-9);
    const late = delay === null ? M ?? 0 : Math.ceil((delay * hr) / 1000 - 1e-9);
    const by = landing === null ? Infinity : Math.floor((landing * hr) / 1000 + 1e-9) - 1;
    const fits = between < 0 || late + between <= every;
    return every >= 1 && every <= Math.max(N, limits.N[1]) && fits && by >= late + after;
  });
}

/* A landing in steps is meant in milliseconds where the rate changes. */
function landingInMs({ query, view }) {
  if (!query.has("L") || !query.has("hr_hz")) return {};
  return { L: null, land_within_ms: stepsInMs(view.design.L, query.get("hr_hz")) };
}

// The controls of what the paper leaves open, and of how it is counted and drawn.

import { roundStops, wholeStops } from "./stops.js";

/** As those of fields.js. */
export const FURTHER_OPTIONS = [
  {
    key: "speed", label: "Speed", help: ({ view }) => `of the processor, in ${view.power.unit}`,
    empty: { place: "first", words: "least" },
    shown: ({ view }) => view.design.processor === null,
    value: ({ query }) => query.get("speed") ?? "",
    unit: () => "",
    stops: ({ view }) => roundStops(...[0.5, 10].map((times) => Number((times * view.current.power).toPrecision(2)))),
    write: (text) => ({ speed: text }),
  },
  optionChoice("lr_propagate_by", "Low-rate propagation", "is due when the measurement arrives, or when it lands", {
    m: "by m, the paper's rule", l: "by l, needs less for small delays",
  }),
  optionChoice("feedback", "Feedback", "when a correction is applied", {
    "next-step": "in the next step", "same-step": "as soon as it is known",
  }),
  optionChoice("gain", "Gain", "computed when the measurement is there, or before", {
    "at-update": "at the update", precomputed: "before it arrives",
  }),
  optionChoice("low_rate_noise", "Low-rate noise", "how process noise is summed over the steps", {
    exact: "exact, Eq. 18", sum: "sum, Eq. 23", euler: "Euler, Eq. 24",
  }),
  optionChoice("cpus", "CPUs", "2: high-rate jobs on one, low-rate jobs on the other"),
  {
    key: "context_switch", label: "Context switch", help: "work of each, in cost units (seconds on a processor)",
    empty: { place: "first", words: "0" },
    value: ({ query }) => query.get("context_switch") ?? "",
    unit: () => "",
    stops: contextStops,
    write: (text) => ({ context_switch: text }),
  },
  optionChoice("policy", "Policy", "which job runs first", {
    fixed: "fixed priorities", edf: "earliest deadline first",
  }),
  {
    key: "costs", label: "Costs", help: "the table of what each job takes",
    options: ({ view }) => [{ value: "", words: "as fits model and processor" }, ...plainChoices(view.choices.costs)],
    write: (value) => ({ costs: value }),
  },
  optionChoice("statistic", "Statistic", "which of a measured cost's figures"),
  optionChoice("metric", "Accuracy is", "of the steps from one measurement to the next", {
    worst: "that of the worst step", rms: "the root mean square",
  }),
  {
    key: "cycles", label: "Cycles drawn", help: "intervals between measurements, in the chart",
    value: ({ view }) => String(view.design.cycles),
    unit: () => "",
    stops: () => wholeStops(1, 10),
    write: (text) => ({ cycles: text }),
  },
];

/** Names as choices. */
export function plainChoices(names) {
  return names.map((name) => ({ value: String(name), words: String(name) }));
}

function optionChoice(key, label, help, words = {}) {
  const choice = (value) => ({ value: String(value), words: words[value] ?? String(value) });
  return {
    key, label, help,
    options: ({ view }) => view.choices[key].map(choice),
    shown: ({ view }) => view.choices[key].length > 1,
    write: (value) => ({ [key]: value }),
  };
}

/* Up to a twentieth of the least work per period; without a processor that is its least speed. */
function contextStops({ view: { current } }) {
  const most = Number((current.least.value / 20).toPrecision(1));
  return roundStops(most / 1000, most, 1);
}

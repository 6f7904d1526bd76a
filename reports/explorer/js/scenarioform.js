// What can be changed of a scenario: its seed, its length, its processor, and which distribution is shown.

import { choiceField, numberField } from "./field.js";
import { roundStops, wholeStops } from "./stops.js";
import { html } from "./svg.js";

const SLOWEST = 10;
const SEEDS = 100;

/** The form in `host`; ids begin with `id`. `onChange(changes, {key, settled})` hears what a control writes into
 *  the query. */
export function scenarioForm(host, id, onChange) {
  const number = (key, label, help) =>
    numberField({ id: `${id}-${key}`, label, help }, (text, _stop, settled) => onChange({ [key]: text }, { key, settled }));
  const slower = number("times_slower", "Processor so many times as slow", "1 is that of the file; 0.5 is twice as fast. The draws stay the same.");
  const steps = number("steps", "Steps", "More steps resolve rarer misses, and take longer.");
  const seed = number("seed", "Seed", "Other draws of costs, delays and losses.");
  const shown = choiceField({ id: `${id}-shown`, label: "Distribution of", help: "Also by its name in the table." }, (kind) => onChange({ shown: kind }, { key: "shown", settled: true }));
  const parts = { times_slower: slower, steps, seed, shown };
  const fields = Object.values(parts).map(({ element }) => element);
  const group = html("fieldset", { class: "ss-group" }, html("legend", {}, "The run"), ...fields);
  const form = html("form", { class: "ss-controls", "aria-label": "Scenario", novalidate: true }, group);
  form.addEventListener("submit", (event) => event.preventDefault());
  const about = html("p", { class: "ss-help ss-scenario-about" });
  host.append(form, about);

  return {
    /** Fills it from a view; what is being typed stays unless it is forced. */
    show(view, force) {
      const [least, most] = view.limits.steps;
      slower.set(view.asked.times_slower, "×", roundStops(1 / SLOWEST, SLOWEST), force);
      steps.set(String(view.steps), "", roundStops(Math.max(least, 1), most), force);
      seed.set(String(view.seed), "", wholeStops(0, Math.max(SEEDS, view.own.seed)), force);
      shown.set(view.shown, view.kinds.map((kind) => ({ value: kind, words: kind })));
      about.textContent = aboutScenario(view);
    },
    /** Shows a refusal at the control that it begins with the key of; whether there is one. No text: none. */
    refuse(text) {
      const about = Object.keys(parts).find((key) => text.startsWith(`${key} `));
      for (const [key, part] of Object.entries(parts)) part.refuse(key === about ? text : "");
      return about !== undefined;
    },
  };
}

function aboutScenario({ name, late, hr_hz: rate, cpus, sensors }) {
  const where = cpus > 1 ? `, on ${cpus} processors` : "";
  const loop = rate === null ? "" : ` at ${rate} Hz`;
  const named = sensors.map((sensor) => `${sensor.name}: ${sensor.times}`).join(". ");
  return `${name}${loop}${where}; late measurements: ${late}. ${named}.`;
}

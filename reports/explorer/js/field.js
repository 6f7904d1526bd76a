// One control of the form: a number with a slider, or a choice; its label, a phrase of help, and what was refused.

import { html } from "./svg.js";
import { stopNear } from "./stops.js";

const PAUSE_MS = 400;

/**
 * A number field and a slider that stops at `stops`, coupled. `empty` is {place: "first" | "last", words}: the end of
 * the slider at which nothing is given, and what that means. `onChange(text, slid, settled)` hears of each change.
 */
export function numberField({ id, label, help, empty }, onChange) {
  const number = html("input", {
    type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", id, class: "ss-number",
    "aria-describedby": `${id}-help`, placeholder: empty?.words,
  });
  const range = html("input", { type: "range", class: "ss-range", "aria-label": `${label}, slider`, min: 0, step: 1 });
  const unit = html("span", { class: "ss-unit" });
  const frame = framed(id, label, help, html("span", { class: "ss-inputs" }, range, number, unit), number);
  let stops = [];
  let timer = null;
  let dragging = false;

  const place = (text) => {
    const [over, under = 1] = text.replace(",", ".").split("/").map(Number);
    const at = over / under;
    const spare = empty?.place === "first" ? 1 : 0;
    if (text === "" || Number.isNaN(at)) return empty?.place === "last" ? stops.length : 0;
    return stopNear(stops, at) + spare;
  };
  const slide = () => {
    range.value = place(number.value);
    const words = number.value === "" ? empty?.words ?? "" : `${number.value} ${unit.textContent}`;
    range.setAttribute("aria-valuetext", words);
  };
  const slid = (settled) => {
    const stop = stops[Number(range.value) - (empty?.place === "first" ? 1 : 0)];
    number.value = stop === undefined ? "" : String(stop);
    slide();
    onChange(number.value, stop ?? null, settled);
  };
  const typed = (settled) => {
    clearTimeout(timer);
    timer = null;
    slide();
    onChange(number.value.trim().replace(",", "."), null, settled);
  };
  range.addEventListener("input", () => {
    dragging = true;
    slid(false);
  });
  range.addEventListener("change", () => {
    dragging = false;
    slid(true);
  });
  number.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(() => typed(true), PAUSE_MS);
  });
  number.addEventListener("change", () => timer !== null && typed(true));

  return {
    ...frame,
    number,
    /** Shows a value and its unit, and where the slider stops. What is typed or dragged stays, unless forced. */
    set(text, unitText, newStops, force = false) {
      if (dragging && !force) return;
      stops = newStops;
      range.max = Math.max(stops.length - 1 + (empty ? 1 : 0), 0);
      range.disabled = stops.length + (empty ? 1 : 0) < 2;
      unit.textContent = unitText;
      if (force || (number.getRootNode().activeElement !== number && timer === null)) number.value = text;
      slide();
    },
  };
}

/** A choice among `options`, each {value, words}. `onChange(value)` hears of each change. */
export function choiceField({ id, label, help }, onChange) {
  const select = html("select", { id, class: "ss-select", "aria-describedby": `${id}-help` });
  select.addEventListener("change", () => onChange(select.value));
  let shown = "";
  return {
    ...framed(id, label, help, select, select),
    set(value, options) {
      const key = JSON.stringify(options);
      const option = (each) => html("option", { value: each.value }, each.words);
      if (key !== shown) select.replaceChildren(...options.map(option));
      shown = key;
      select.value = value;
    },
  };
}

/** A group of radio buttons, each option {value, words}. */
export function radioField({ id, label, options }, onChange) {
  const inputs = options.map(({ value }) => html("input", { type: "radio", name: id, value }));
  const labels = options.map(({ words }, index) => html("label", {}, inputs[index], ` ${words}`));
  const element = html("fieldset", { class: "ss-radio" }, html("legend", {}, label), ...labels);
  for (const input of inputs) input.addEventListener("change", () => onChange(input.value));
  return {
    element,
    set(value) {
      for (const input of inputs) input.checked = input.value === value;
    },
  };
}

function framed(id, label, help, inputs, input) {
  const helped = html("p", { class: "ss-help", id: `${id}-help` }, help);
  const refusal = html("p", { class: "ss-refusal", id: `${id}-refusal`, role: "alert" });
  const element = html("div", { class: "ss-field" }, html("label", { for: id }, label), inputs, helped, refusal);
  return {
    element,
    help(text) {
      if (helped.textContent !== text) helped.textContent = text;
    },
    /** Shows why the value was refused; no text takes that away. */
    refuse(text) {
      if (refusal.textContent !== text) refusal.textContent = text;
      input.setAttribute("aria-describedby", text ? `${id}-help ${id}-refusal` : `${id}-help`);
      if (text) input.setAttribute("aria-invalid", "true");
      else input.removeAttribute("aria-invalid");
    },
  };
}

// Which steps of a run are shown: a slider over all of it, a step to jump to, and buttons to the next.

import { html } from "./svg.js";

const SPANS = [12, 24, 40, 100, 200, 500];

/** The controls of a trace in an element; ids begin with `id`. `onMove()` hears that other steps are wanted, `onFind(of)`
 *  that the next "miss" or "landing" is, `onStop()` that it takes too long. */
export function traceControls(id, { onMove, onFind, onStop }) {
  const range = html("input", { type: "range", class: "ss-range", min: 0, step: 1, "aria-label": "First step shown, slider" });
  const first = html("input", { type: "text", inputmode: "numeric", class: "ss-number", id: `${id}-first`, autocomplete: "off" });
  const span = html("select", { class: "ss-select", id: `${id}-span` });
  const said = html("p", { class: "ss-trace-said", role: "status" });
  const button = (text, onClick) => {
    const element = html("button", { type: "button", class: "ss-button" }, text);
    element.addEventListener("click", onClick);
    return element;
  };
  const [previous, next] = [button("‹ Previous steps", () => shift(-1)), button("Next steps ›", () => shift(1))];
  const [miss, landing] = [button("To the next miss", () => onFind("miss")), button("To the next late landing", () => onFind("landing"))];
  const stop = button("Stop", onStop);
  const labelled = (input, text) => html("span", { class: "ss-trace-field" }, html("label", { for: input.id }, text), input);
  const fields = [labelled(first, "First step"), labelled(span, "Steps shown")];
  const line = html("div", { class: "ss-trace-line" }, ...fields, previous, next, miss, landing);
  const element = html("div", { class: "ss-trace-steps" }, range, line, html("div", { class: "ss-trace-line" }, said, stop));
  let total = 1;
  range.addEventListener("input", () => jump(Number(range.value)));
  first.addEventListener("change", () => jump(Math.round(Number(first.value.replaceAll(",", ""))) || 0));
  span.addEventListener("change", () => jump(Number(range.value)));
  stop.hidden = true;

  function jump(at) {
    put(at);
    onMove();
  }

  function shift(windows) {
    jump(place().at + windows * place().span);
  }

  /** Puts the slider and the field there, as near as the run has steps. */
  function put(at) {
    const last = Math.max(total - Number(span.value), 0);
    range.max = last;
    range.value = Math.min(Math.max(at, 0), last);
    first.value = range.value;
    range.setAttribute("aria-valuetext", `step ${range.value} of ${total}`);
    [previous.disabled, next.disabled] = [range.value === "0", Number(range.value) === last];
  }

  /** The steps that are wanted. */
  function place() {
    return { at: Number(range.value), span: Number(span.value) };
  }

  /** Fits it to a run, and to the steps that are shown of it first. */
  function fit(trace) {
    total = trace.steps;
    const lengths = [...new Set([...SPANS.filter((each) => each < total), trace.span])].sort((one, other) => one - other);
    span.replaceChildren(...lengths.map((each) => html("option", { value: each }, String(each))));
    span.value = trace.span;
    range.max = total;
    put(trace.at);
  }

  /** Which steps of a view are shown, with a note behind. */
  function told({ trace, period_ms: ms }, note) {
    const { at, span: length } = place();
    const end = Math.min(at + length, total);
    const times = ms === null ? "" : `, ${clock(at * ms)} to ${clock(end * ms)}`;
    say(`Steps ${at.toLocaleString("en")} to ${end.toLocaleString("en")} of ${total.toLocaleString("en")}${times}${note}`);
    miss.hidden = trace.misses === 0;
    landing.hidden = trace.late === 0;
  }

  function simulating({ simulated, steps }) {
    say(`Simulating: ${simulated.toLocaleString("en")} of ${steps.toLocaleString("en")} steps so far`);
    stop.hidden = false;
  }

  function say(text) {
    said.textContent = text;
    stop.hidden = true;
  }

  return { element, place, put, fit, told, simulating, say };
}

function clock(ms) {
  return ms < 10000 ? `${Number(ms.toFixed(1))} ms` : `${Number((ms / 1000).toFixed(3))} s`;
}

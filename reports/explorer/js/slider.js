// Goes through the states that a figure has, by pointer, touch and keys; what is shown is said beside it.

import { html } from "./svg.js";

/** A slider over frames of {label}, at first at the one of this index; `onFrame(frame)`: of one that is moved to. */
export function slider({ name, frames, at }, onFrame) {
  const said = html("span", { class: "ss-slider-said", "aria-hidden": "true" });
  const range = { type: "range", min: 0, max: frames.length - 1, step: 1, value: at, "aria-label": name };
  const input = html("input", range);
  const say = () => {
    const { label } = frames[Number(input.value)];
    said.textContent = label;
    input.setAttribute("aria-valuetext", label);
  };
  input.addEventListener("input", () => {
    say();
    onFrame(frames[Number(input.value)]);
  });
  say();
  return html("div", { class: "ss-slider" }, html("span", { "aria-hidden": "true" }, name), input, said);
}

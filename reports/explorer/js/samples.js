// Pieces of lines as they are drawn, and the legend of a plot: a button for each line, which shows or hides it.

import { html, svg } from "./svg.js";
import { markerPath } from "./looks.js";

const SAMPLE_WIDTH = 34;
const SAMPLE_HEIGHT = 14;

/** A piece of a line as it is drawn, with its marker. */
export function lineSample(look) {
  const middle = SAMPLE_HEIGHT / 2;
  const line = svg("path", { class: "ss-plot-line", d: `M0 ${middle}H${SAMPLE_WIDTH}`, stroke: look.colour });
  if (look.dashes) line.setAttribute("stroke-dasharray", look.dashes);
  const shape = `M${SAMPLE_WIDTH / 2} ${middle}${markerPath(look.marker)}`;
  const marker = svg("path", { class: "ss-plot-marker", d: shape });
  marker.setAttribute("stroke", look.colour);
  marker.setAttribute("fill", look.colour);
  return sampleOf(line, marker);
}

/** A piece of a path of this class: a line with these dashes, a box, or a marker. */
export function pathSample({ class: name, dashes, box, marker }) {
  const middle = SAMPLE_HEIGHT / 2;
  const line = box ? `M8 1H${SAMPLE_WIDTH - 8}V${SAMPLE_HEIGHT - 1}H8z` : `M0 ${middle}H${SAMPLE_WIDTH}`;
  const shape = marker ? `M${SAMPLE_WIDTH / 2} ${middle}${markerPath(marker)}` : line;
  return sampleOf(svg("path", { class: name, "stroke-dasharray": dashes || "none", d: shape }));
}

function sampleOf(...drawn) {
  const size = { width: SAMPLE_WIDTH, height: SAMPLE_HEIGHT };
  return svg("svg", { class: "ss-plot-sample", ...size, "aria-hidden": "true" }, ...drawn);
}

/** Buttons in an element of their own. `show(entries)`, each {name, look, current, shown}, keeps the buttons, and so
 *  the focus, while the names are the same; `onToggle(name)` is called by a button. */
export function plotLegend(onToggle) {
  const element = html("div", { class: "ss-plot-legend", role: "group", "aria-label": "Lines shown" });
  let names = [];

  function show(entries) {
    const asked = entries.map((entry) => entry.name);
    if (asked.join("\n") !== names.join("\n")) {
      element.replaceChildren(...entries.map(button));
      names = asked;
    }
    entries.forEach((entry, index) => {
      const shown = element.children[index];
      shown.setAttribute("aria-pressed", String(entry.shown));
      shown.classList.toggle("ss-plot-now", entry.current);
    });
  }

  function button(entry) {
    const made = html("button", { type: "button", class: "ss-plot-entry" }, lineSample(entry.look), entry.name);
    made.addEventListener("click", () => onToggle(entry.name));
    return made;
  }

  return { element, show };
}

// What plots and histograms share: a figure with its axis labels around an area that is drawn in pixels.

import { digits, html, svg } from "./svg.js";

/** The quantity and the unit of an axis label such as "least speed (% of rp2040)" or "L, where it lands (steps)". */
export function quantity(label) {
  const [, name, unit] = label.match(/^(.*?)(?:, .*?)?(?: \(([^()]*)\))?$/);
  return { name, unit: unit ?? "" };
}

/** A value of an axis {label, text}: as its `text` writes it, else to five digits. */
export function axisText({ text }, value) {
  return value === null || text === undefined ? digits(value, 5) : text(value);
}

/** A value's text with the quantity and the unit of its axis. */
export function saidOf({ label }, text) {
  const { name, unit } = quantity(label);
  return `${name} ${text}${unit === "" ? "" : ` ${unit}`}`;
}

/** A figure in `host`: a title, a legend, the label of the y axis, an area with a picture, the label of the x axis, and
 *  what stands below. `name({title, x, y, spoken})` writes them; `draw({width, height, font})` is called when the area
 *  has another size, and by `redraw()` while it has one. */
export function plotSheet(host, { legend, below, draw }) {
  const title = html("figcaption", { class: "ss-plot-title" });
  const picture = svg("svg", { class: "ss-plot-picture", role: "img" });
  const area = html("div", { class: "ss-plot-area" }, picture);
  const up = html("div", { class: "ss-plot-axis" });
  const across = html("div", { class: "ss-plot-axis ss-plot-across" });
  const element = html("figure", { class: "ss-plot" }, title, legend, up, area, across, below);
  host.append(element);
  let size = { width: 0, height: 0 };
  const observer = new ResizeObserver(([{ contentRect }]) => {
    size = { width: contentRect.width, height: contentRect.height };
    redraw();
  });
  observer.observe(area);

  function redraw() {
    if (size.width === 0 || size.height === 0) return;
    picture.setAttribute("viewBox", `0 0 ${size.width} ${size.height}`);
    draw({ ...size, font: `12px ${getComputedStyle(area).fontFamily}` });
  }

  function name({ title: named, x, y, spoken }) {
    title.textContent = named;
    up.textContent = y;
    across.textContent = x;
    picture.setAttribute("aria-label", spoken);
  }

  function destroy() {
    observer.disconnect();
    element.remove();
  }

  return { area, picture, name, redraw, destroy };
}

import { digits, html, svg } from "./svg.js";
import { markerPath } from "./looks.js";

// Tells the values of the curves of a printed figure: a picture with, over each of its plots, a crosshair.

/** Of the width of a plot: no value is told from farther away. */
const FAR = 0.12;
/** How much less it counts that a point of a curve is above or below the pointer. */
const ALONG = 0.02;

/** Over the picture in `host`, an element that is as large as the picture: what reports/drawing/readout.py wrote of it. */
export function readout(host, { plots }) {
  const tip = html("div", { class: "ss-told", hidden: true });
  const boxes = plots.map((plot, number) => plotBox(host, plot, number, tip));
  host.append(...boxes, tip);
  return { destroy: () => [...boxes, tip].forEach((element) => element.remove()) };
}

function plotBox(host, plot, number, tip) {
  const places = { x: shareOf(plot.x), y: shareOf(plot.y) };
  const quantity = plot.x.name || "value";
  const curves = plot.lines.map((line) => curveOf(line, plot.columns));
  const stops = stopsOfCurves(curves);
  const cross = svg("svg", { class: "ss-cross", "aria-hidden": "true" });
  const box = html("div", {
    class: "ss-readout", tabindex: 0, role: "slider", "aria-label": `${nameOf(plot, number)}: values of the curves along ${quantity}`,
    "aria-valuemin": 0, "aria-valuemax": Math.max(stops.length - 1, 1), "aria-valuenow": 0, "aria-valuetext": "use the arrow keys",
  }, cross);
  ["left", "top", "width", "height"].forEach((side, index) => { box.style[side] = `${100 * plot.box[index]}%`; });
  let stop = -1;

  const show = (x, y) => {
    const told = curves.map((curve) => ({ curve, at: curve.at(x) })).filter(({ at }) => at !== null);
    stop = nearestStop(stops, x, places.x);
    const head = `${quantity}: ${told.find(({ at }) => at.x)?.at.x ?? digits(x)}`;
    const rows = told.map(({ curve, at }) => ({ curve, text: at.y, place: places.y(at.value) }));
    box.setAttribute("aria-valuenow", Math.max(stop, 0));
    box.setAttribute("aria-valuetext", [head, ...rows.map(({ curve, text }) => `${curve.name}: ${text}`)].join("; "));
    drawCross(cross, places.x(x), rows);
    tip.replaceChildren(html("div", { class: "ss-told-head" }, head), ...(plot.y.name ? [html("div", { class: "ss-told-unit" }, plot.y.name)] : []), ...rows.map(toldRow));
    placeTold(host, tip, plot.box, places.x(x), y);
  };
  const hide = () => { cross.replaceChildren(); tip.hidden = true; };
  const point = (event) => {
    const area = box.getBoundingClientRect();
    const across = (event.clientX - area.left) / area.width;
    const up = 1 - (event.clientY - area.top) / area.height;
    const x = nearestX(curves, stops, places, across, up);
    if (x === null) hide();
    else show(x, up);
  };
  const step = (to) => { show(stops[Math.min(Math.max(to, 0), stops.length - 1)], 0.5); };
  const keys = {
    ArrowRight: () => step(stop + 1), ArrowUp: () => step(stop + 1), ArrowLeft: () => step(stop - 1), ArrowDown: () => step(stop - 1),
    PageUp: () => step(stop + 10), PageDown: () => step(stop - 10), Home: () => step(0), End: () => step(stops.length - 1), Escape: hide,
  };
  box.addEventListener("pointermove", point);
  box.addEventListener("pointerdown", point);
  box.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") hide(); });
  box.addEventListener("blur", hide);
  box.addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  return box;
}

function nameOf({ title, y }, number) {
  return title || [y.name, `plot ${number + 1}`].filter(Boolean).join(", ");
}

/** From a value to the share of the axis; `invert` gives the value back. */
function shareOf({ scale, ends, places }) {
  if (places) return piecewise(places);
  const of = scale === "log" ? Math.log10 : (value) => value;
  const back = scale === "log" ? (value) => 10 ** value : (value) => value;
  const [first, last] = ends.map(of);
  const place = (value) => (of(value) - first) / (last - first);
  place.invert = (share) => back(first + share * (last - first));
  return place;
}

/** By the values at evenly spaced places. */
function piecewise(values) {
  const pieces = values.length - 1;
  const rising = values[pieces] >= values[0];
  const place = (value) => {
    const after = values.findIndex((edge) => (rising ? edge >= value : edge <= value));
    if (after <= 0) return after < 0 ? 1 : 0;
    return (after - 1 + (value - values[after - 1]) / (values[after] - values[after - 1])) / pieces;
  };
  place.invert = (share) => {
    const piece = Math.min(Math.max(Math.floor(share * pieces), 0), pieces - 1);
    return values[piece] + (share * pieces - piece) * (values[piece + 1] - values[piece]);
  };
  return place;
}

/** `at(x)`: what the curve says there, or null; words where the figure has words, else numbers. */
function curveOf(line, columns) {
  const [x, y] = [columns[line.x], columns[line.y]];
  const words = { x: columns[line.said?.x], y: columns[line.said?.y] };
  const tell = (index) => ({ value: y[index], x: words.x?.[index], y: words.y?.[index] ?? digits(y[index]) });
  const at = (wanted) => {
    const index = line.step ? x.findLastIndex((value) => value <= wanted) : x.indexOf(wanted);
    return index < 0 || (line.step && wanted > x[x.length - 1]) ? null : tell(index);
  };
  return { name: line.name, colour: line.colour, marker: line.marker, step: Boolean(line.step), x, y, at };
}

/** Where values are told: of curves of points all their x, of steps alone where one begins. */
function stopsOfCurves(curves) {
  const points = curves.filter((curve) => !curve.step);
  return [...new Set((points.length ? points : curves).flatMap((curve) => curve.x))].sort((a, b) => a - b);
}

/** The x of the point that is nearest; where all curves are steps, that below the pointer. */
function nearestX(curves, stops, places, across, up) {
  const points = curves.filter((curve) => !curve.step);
  if (!points.length) {
    const x = places.x.invert(across);
    return x < stops[0] || x > stops[stops.length - 1] ? null : Number(x.toPrecision(4));
  }
  const sideways = points.every((curve) => curve.x.length === 1) ? 1 : ALONG;
  let [best, least] = [null, Infinity];
  for (const curve of points) {
    curve.x.forEach((x, index) => {
      const aside = Math.abs(places.x(x) - across);
      const far = aside + sideways * Math.abs(places.y(curve.y[index]) - up);
      if (aside < FAR && far < least) [best, least] = [x, far];
    });
  }
  return best;
}

function nearestStop(stops, x, place) {
  return stops.reduce((best, stop, index) => (Math.abs(place(stop) - place(x)) < Math.abs(place(stops[best]) - place(x)) ? index : best), 0);
}

function drawCross(cross, across, rows) {
  const percent = (share) => `${(100 * share).toFixed(2)}%`;
  cross.replaceChildren(
    svg("line", { class: "ss-cross-line", x1: percent(across), x2: percent(across), y1: "0", y2: "100%" }),
    ...rows.map(({ curve, place }) => svg("circle", { cx: percent(across), cy: percent(1 - place), r: 4.5, stroke: curve.colour, fill: "none" })),
  );
}

function toldRow({ curve, text }) {
  const { colour, marker } = curve;
  const line = svg("path", { d: "M-10 0h20", stroke: colour, "stroke-width": 2 });
  const sign = svg("path", { d: `M0 0${markerPath(marker, 4)}`, stroke: colour, fill: colour });
  const key = svg("svg", { class: "ss-told-key", viewBox: "-10 -6 20 12", "aria-hidden": "true" }, line, ...(marker ? [sign] : []));
  return html("div", { class: "ss-told-row" }, key, html("span", {}, curve.name), html("b", {}, text));
}

/** Beside the crosshair, on the side where there is more room; where it is narrow, below the picture. */
function placeTold(host, tip, [left, top, width, height], across, up) {
  tip.hidden = false;
  const at = host.clientWidth * (left + width * across);
  let aside = at > host.clientWidth / 2 ? at - tip.offsetWidth - 12 : at + 12;
  const wished = host.clientHeight * (top + height * (1 - up)) - tip.offsetHeight / 2;
  let down = Math.min(Math.max(wished, 0), Math.max(host.clientHeight - tip.offsetHeight, 0));
  if (tip.offsetWidth > 0.6 * host.clientWidth) [aside, down] = [0, host.clientHeight];
  tip.style.left = `${Math.min(Math.max(aside, 0), Math.max(host.clientWidth - tip.offsetWidth, 0))}px`;
  tip.style.top = `${down}px`;
}

// How something is spread: bars, the tail as steps, a deadline, quantiles.

import { digits, html, svg } from "./svg.js";
import { plotFrame } from "./frame.js";
import { markerPath } from "./looks.js";
import { linePath, valueAt } from "./paths.js";
import { plotReader } from "./reading.js";
import { pathSample } from "./samples.js";
import { extent } from "./scales.js";
import { plotSheet, quantity } from "./sheet.js";
import { plotStakes, STAKES_TOP_PX } from "./stakes.js";
import { valuesTable } from "./values.js";

const STAKE_NEAR = 1.6;
const BARS_LOOK = { class: "ss-histogram-bars", box: true };
const TAIL_LOOKS = [{ class: "ss-histogram-tail" }, { class: "ss-histogram-tail", dashes: "7 4" }];
const POINTS_LOOK = { class: "ss-histogram-point", marker: "o" };
const SHADE_LOOK = { class: "ss-histogram-unresolved", box: true };

/** A histogram in `host`. `show({title, x: {label}, y: {label, log}, edges, bars, tails, points, deadline, marks,
 *  unresolved})`
 *  draws it. `bars[i]` is the share between `edges[i]` and the next. tails, none to two, for a logarithmic axis:
 *  [{name, x, y}], the probability of more than x, which holds until the next x; the second one is dashed. points:
 *  {name, x, y} or null, circles. deadline: {x, label} or null; marks: [{x, label}], quantiles; unresolved: {y, label}
 *  or null, below it a share says nothing. `destroy()` takes it away. */
export function histogram(host) {
  const [axes, stakes] = [plotFrame(), plotStakes()];
  const bars = svg("path", { class: "ss-histogram-bars" });
  const shade = svg("path", { class: "ss-histogram-unresolved" });
  const lines = TAIL_LOOKS.map((look) => svg("path", { class: look.class, "stroke-dasharray": look.dashes ?? "none" }));
  const circles = svg("path", { class: POINTS_LOOK.class });
  const key = html("ul", { class: "ss-plot-legend" });
  const values = valuesTable();
  const sheet = plotSheet(host, { legend: key, below: values.element, draw });
  const read = plotReader(sheet.area, {
    onPoint: (across) => laid && point(binAt(given.edges, laid.x.invert(across)), false),
    onLeave: () => point(null, false),
    onWalk: (bin) => laid && point(bin, true),
  });
  sheet.picture.append(axes.element, bars, shade, ...lines, circles, stakes.element, read.element);
  let [given, laid, reading] = [null, null, null];

  function show(next) {
    given = next;
    const spoken = [`${next.title}. ${next.y.label} by ${next.x.label}`, ...stakesOf(next).map(({ label }) => label)];
    sheet.name({ title: next.title, x: next.x.label, y: next.y.label, spoken: spoken.join("; ") });
    const shaded = next.unresolved === null ? [] : [[SHADE_LOOK, next.unresolved.label]];
    const tails = tailsOf(next).map(({ name }, index) => [TAIL_LOOKS[index], name]);
    const points = next.points === null ? [] : [[POINTS_LOOK, next.points.name]];
    const looks = [[BARS_LOOK, next.y.label], ...tails, ...points, ...shaded];
    key.replaceChildren(...looks.map(([look, text]) => html("li", { class: "ss-plot-key" }, pathSample(look), text)));
    values.show(() => binsTable(next));
    sheet.redraw();
  }

  function draw(size) {
    if (given === null) return;
    const shown = { domain: downRange(given), log: given.y.log };
    const wide = { domain: acrossRange(given), whole: areWhole(given.edges) };
    laid = axes.lay({ ...size, top: STAKES_TOP_PX, x: wide, y: shown });
    const { x, y, box } = laid;
    const foot = y.domain[0];
    const high = given.bars.map((share) => y(Math.max(share, foot)) ?? box.bottom);
    const across = given.edges.map(x);
    bars.setAttribute("d", high.map((top, bin) => barPath(across[bin], across[bin + 1], top, box.bottom)).join(""));
    const resolved = given.unresolved === null ? null : y(given.unresolved.y);
    const shaded = resolved !== null && resolved < box.bottom;
    shade.setAttribute("d", shaded ? `M${box.left} ${resolved}H${box.right}V${box.bottom}H${box.left}z` : "");
    lines.forEach((line, index) => {
      const tail = tailsOf(given)[index] ?? { x: [], y: [] };
      const drawn = tail.y.map((share) => (share >= foot ? share : null));
      line.setAttribute("d", linePath(tail.x, drawn, x, y, true));
    });
    const exact = given.points ?? { x: [], y: [] };
    const there = exact.x.map((at, index) => [x(at), y(exact.y[index])]).filter((place) => !place.includes(null));
    circles.setAttribute("d", there.map(([at, up]) => `M${at.toFixed(1)} ${up.toFixed(1)}${markerPath("o")}`).join(""));
    stakes.lay({ stakes: stakesOf(given), x, box, font: size.font });
    hold();
    point(reading, false);
  }

  function point(bin, aloud) {
    reading = bin;
    if (bin === null || given.bars[bin] === undefined) return read.quiet();
    if (aloud) hold();
    const [from, until] = [given.edges[bin], given.edges[bin + 1]];
    const tails = tailsOf(given).map((tail, index) => [TAIL_LOOKS[index], tail.name, tailAt(tail, until)]);
    const inside = (given.points?.x ?? []).map((at, index) => [at, index]).filter(([at]) => at >= from && at < until);
    const points = inside.map(([, index]) => [POINTS_LOOK, given.points.name, given.points.y[index]]);
    const told = [[BARS_LOOK, given.y.label, given.bars[bin]], ...tails, ...points];
    const rows = told.map(([look, name, share]) => ({ sign: pathSample(look), name, text: digits(share) }));
    const heard = aloud ? rows.map(({ name, text }) => `${name} ${text}`).join(", ") : null;
    const middle = laid.x((from + until) / 2);
    read.tell({ x: middle, box: laid.box, heading: binText(given, bin), rows, dots: [], aloud: heard });
  }

  function hold() {
    const bin = reading ?? 0;
    const text = given.bars.length === 0 ? "no values" : binText(given, bin);
    read.hold({ label: `${given.title}: arrow keys walk along the bars`, count: given.bars.length, index: bin, text });
  }

  function destroy() {
    read.destroy();
    sheet.destroy();
  }

  return { show, destroy };
}

/** The bin that a value is in, or null. */
function binAt(edges, value) {
  const bin = edges.findIndex((edge, index) => value >= edge && value < edges[index + 1]);
  return bin < 0 ? null : bin;
}

function tailsOf({ y, tails }) {
  return y.log ? tails : [];
}

function acrossRange(given) {
  const { edges, deadline } = given;
  const reached = tailsOf(given).map(({ x, y }) => x.filter((_, index) => y[index] > 0));
  const drawn = extent(edges, given.points?.x ?? [], ...reached);
  if (deadline === null || drawn === null) return drawn;
  const [low, high] = [Math.min(drawn[0], deadline.x), Math.max(drawn[1], deadline.x)];
  return high - low <= STAKE_NEAR * (drawn[1] - drawn[0]) ? [low, high + (high - low) / 30] : drawn;
}

function downRange(given) {
  const { y, bars, unresolved } = given;
  const least = unresolved === null ? [] : [unresolved.y];
  const known = [bars, ...tailsOf(given).map((tail) => tail.y), given.points?.y ?? [], least];
  const drawn = extent(...known.map((shares) => shares.filter((share) => share > 0)));
  if (!y.log) return [0, drawn === null ? 1 : drawn[1] * 1.04];
  if (drawn === null) return [0.1, 1];
  return [10 ** Math.floor(Math.log10(drawn[0] / 1.5)), Math.max(1, drawn[1])];
}

function barPath(left, right, top, bottom) {
  const gap = right - left > 4 ? 0.5 : 0;
  const [from, until] = [left + gap, right - gap].map((pixel) => pixel.toFixed(1));
  return top >= bottom ? "" : `M${from} ${bottom}V${top.toFixed(1)}H${until}V${bottom}z`;
}

function stakesOf({ deadline, marks }) {
  return [...(deadline === null ? [] : [{ ...deadline, red: true }]), ...marks];
}

function binText({ x, edges }, bin) {
  const { name, unit } = quantity(x.label);
  const inward = areWhole(edges) ? 0.5 : 0;
  const [from, until] = [edges[bin] + inward, edges[bin + 1] - inward].map((edge) => digits(edge));
  return `${name} ${from}${from === until ? "" : ` to ${until}`}${unit === "" ? "" : ` ${unit}`}`;
}

/** Whether bins are of whole numbers, with edges halfway between them. */
function areWhole(edges) {
  return edges.every((edge) => Math.abs(edge % 1) === 0.5);
}

function tailAt({ x, y }, at) {
  return at > x.at(-1) && y.at(-1) > 0 ? null : valueAt(x, y, at, true);
}

function binsTable({ title, x, y, edges, bars, tails }) {
  const columns = tails.map((tail) => ({
    label: tail.name,
    numeric: true,
    text: (bin) => digits(tailAt(tail, edges[bin + 1])),
  }));
  return {
    caption: title,
    columns: [
      { label: x.label, numeric: true, text: (bin) => binText({ x: { label: "" }, edges }, bin) },
      { label: y.label, numeric: true, text: (bin) => digits(bars[bin]) },
      ...columns,
    ],
    rows: bars.map((_, bin) => bin),
  };
}

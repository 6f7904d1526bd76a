// The frame of a plot: axes with ticks and numbers, and the scales within it.

import { svg } from "./svg.js";
import { linear, logarithmic, tickText } from "./scales.js";
import { clearOfNext } from "./beside.js";
import { textWidth } from "./textwidth.js";

const FRAME_TOP_PX = 10;
const FRAME_RIGHT_PX = 14;
const FRAME_BOTTOM_PX = 22;
const FRAME_TICK_PX = 5;
const FRAME_MINOR_PX = 3;
const BESIDE_TICK_PX = 3;
const TICKS_ACROSS_PX = 54;
const TICKS_DOWN_PX = 42;
const TICK_TEXT_PX = 12;

/** The children of a group, as many as asked for: those that are there, and new ones. */
export function reusedChildren(group, count, make) {
  while (group.childElementCount > count) group.lastElementChild.remove();
  while (group.childElementCount < count) group.append(make());
  return [...group.children];
}

/** Axes in a group. `lay({width, height, top, font, x, y})`, x and y being {domain, log, whole}, draws them for so
 *  many pixels, and gives {x, y, box}: the scales, and the edges of the plot between them. top: left free above them;
 *  whole: ticks at whole numbers. */
export function plotFrame() {
  const grid = svg("path", { class: "ss-plot-grid" });
  const axes = svg("path", { class: "ss-plot-axes" });
  const across = svg("g", { class: "ss-plot-number", "text-anchor": "middle" });
  const down = svg("g", { class: "ss-plot-number", "text-anchor": "end" });
  const element = svg("g", {}, grid, axes, across, down);

  function lay(given) {
    const { x, y, box } = fittedScales(given);
    const counts = [(box.right - box.left) / TICKS_ACROSS_PX, (box.bottom - box.top) / TICKS_DOWN_PX];
    const [many, few] = counts.map((count) => Math.max(2, count));
    const horizontal = numberedTicks(x, given.x, many);
    const vertical = numberedTicks(y, given.y, few);
    const gridLines = [
      ...vertical.map((tick) => `M${box.left} ${crispPixel(y(tick))}H${box.right}`),
      ...horizontal.map((tick) => `M${crispPixel(x(tick))} ${box.top}V${box.bottom}`),
    ];
    grid.setAttribute("d", gridLines.join(""));
    const strokes = [
      `M${crispPixel(box.left)} ${box.top}V${crispPixel(box.bottom)}H${box.right}`,
      ...horizontal.map((tick) => `M${crispPixel(x(tick))} ${box.bottom}v${FRAME_TICK_PX}`),
      ...vertical.map((tick) => `M${box.left} ${crispPixel(y(tick))}h${-FRAME_TICK_PX}`),
      ...x.minor(many).map((tick) => `M${crispPixel(x(tick))} ${box.bottom}v${FRAME_MINOR_PX}`),
      ...y.minor(few).map((tick) => `M${box.left} ${crispPixel(y(tick))}h${-FRAME_MINOR_PX}`),
    ];
    axes.setAttribute("d", strokes.join(""));
    const below = box.bottom + FRAME_TICK_PX + BESIDE_TICK_PX + TICK_TEXT_PX * 0.75;
    writeTicks(across, ticksKept(x, horizontal, given.font), (tick) => [x(tick), below]);
    writeTicks(down, vertical, (tick) => [box.left - FRAME_TICK_PX - BESIDE_TICK_PX, y(tick) + TICK_TEXT_PX * 0.35]);
    return { x, y, box };
  }

  return { element, lay };
}

function fittedScales({ width, height, top = FRAME_TOP_PX, font, x: across, y: down }) {
  const bottom = Math.max(height - FRAME_BOTTOM_PX, top + 1);
  const y = frameScale(down, [bottom, top]);
  const heights = numberedTicks(y, down, Math.max(2, (bottom - top) / TICKS_DOWN_PX));
  const widest = Math.ceil(Math.max(...heights.map((tick) => textWidth(tickText(tick), font)), 0));
  const left = widest + FRAME_TICK_PX + BESIDE_TICK_PX + 2;
  const wide = (right) => frameScale(across, [left, Math.max(width - right, left + 1)]);
  const first = wide(FRAME_RIGHT_PX);
  const shown = numberedTicks(first, across, Math.max(2, (width - left) / TICKS_ACROSS_PX));
  const reached = Math.max(...shown.map((tick) => first(tick) + textWidth(tickText(tick), font) / 2), 0);
  const right = FRAME_RIGHT_PX + Math.max(0, Math.ceil(reached - width));
  return { x: wide(right), y, box: { left, right: Math.max(width - right, left + 1), top, bottom } };
}

function frameScale({ domain, log }, range) {
  return (log ? logarithmic : linear)(domain, range);
}

function numberedTicks(scale, { whole }, count) {
  const found = scale.ticks(count);
  return whole ? found.filter(Number.isInteger) : found;
}

function ticksKept(scale, shown, font) {
  const widths = shown.map((tick) => textWidth(tickText(tick), font));
  return clearOfNext(shown.map(scale), widths).map((index) => shown[index]);
}

function writeTicks(group, shown, place) {
  reusedChildren(group, shown.length, () => svg("text")).forEach((text, index) => {
    const [x, y] = place(shown[index]);
    text.setAttribute("x", x.toFixed(1));
    text.setAttribute("y", y.toFixed(1));
    const words = tickText(shown[index]);
    if (text.textContent !== words) text.textContent = words;
  });
}

function crispPixel(pixel) {
  return Math.round(pixel - 0.5) + 0.5;
}

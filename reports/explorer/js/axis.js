// The axes of a Gantt chart, in steps and in milliseconds, and the steps that have a name: k, m, l.

import { ticks, tickText } from "./scales.js";
import { spread, worstShift } from "./placing.js";

const TICK_PX = 5;
const TICK_GAP_PX = 14;
const NAME_BELOW_PX = 27;
const MS_BELOW_PX = 47;
const GRID_PX = 14;
const MOST_TICKS = 20;
const MARK_GAP_PX = 8;
const MARK_FARTHEST_PX = 20;
const NARROWEST_MARK_PX = 10;
const MARK_STRIDES = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

/** A fine line at each step, where they are not too close. */
export function drawGrid({ context, scale, layout, colours, line }) {
  const [first, end] = scale.domain;
  if ((layout.right - layout.left) / (end - first) < GRID_PX) return;
  context.strokeStyle = colours.pale;
  context.lineWidth = 1;
  context.beginPath();
  for (let step = Math.ceil(first); step <= Math.min(end, line.steps); step += 1) {
    context.moveTo(scale(step), layout.top);
    context.lineTo(scale(step), layout.foot);
  }
  context.stroke();
}

export function drawAxes(sheet) {
  const { context, scale, layout, colours, line } = sheet;
  const [first, end] = scale.domain;
  context.fillStyle = context.strokeStyle = colours.ink;
  const steps = fitting(sheet, first, end).filter((step) => end - first < 2 || Number.isInteger(step));
  drawAxis(sheet, layout.foot, scale, steps);
  nameAxis(sheet, layout.foot, ["start of step *j* (high-rate periods)", "start of step *j*"]);
  if (line.periodMs === null) return;
  const foot = layout.foot + MS_BELOW_PX;
  const times = fitting(sheet, first * line.periodMs, end * line.periodMs);
  drawAxis(sheet, foot, (ms) => scale(ms / line.periodMs), times);
  const rate = tickText(Number((1000 / line.periodMs).toPrecision(4)));
  nameAxis(sheet, foot, [`time (ms), HR loop at ${rate} Hz`, "time (ms)"]);
}

/** As many round values as their numbers leave room for. */
function fitting({ layout, measure }, first, end) {
  const width = layout.right - layout.left;
  for (let most = Math.min(MOST_TICKS, Math.floor(width / TICK_GAP_PX)); most > 1; most -= 1) {
    const values = ticks(first, end, most);
    const widest = Math.max(0, ...values.map((value) => measure(tickText(value))));
    if (values.length < 2 || ((values[1] - values[0]) / (end - first)) * width >= widest + TICK_GAP_PX) return values;
  }
  return ticks(first, end, 1);
}

function drawAxis({ context, layout }, y, scale, values) {
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(layout.left, y);
  context.lineTo(layout.right, y);
  for (const value of values) {
    context.moveTo(scale(value), y);
    context.lineTo(scale(value), y + TICK_PX);
  }
  context.stroke();
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const value of values) context.fillText(tickText(value), scale(value), y + TICK_PX + 2.5);
}

/** Below an axis, the first of the texts that is no wider than it; symbols are between stars. */
function nameAxis({ context, layout, measure }, y, texts) {
  const across = layout.right - layout.left;
  const text = texts.find((each) => measure(each.replaceAll("*", "")) <= across) ?? texts[texts.length - 1];
  const pieces = text.split("*").map((piece, index) => [piece, index % 2 === 1]);
  writeSymbols(context, pieces, (layout.left + layout.right) / 2, y + NAME_BELOW_PX);
}

/** Pieces of text, some of them in italics, centred. */
function writeSymbols(context, pieces, centre, y) {
  const upright = context.font;
  const widths = pieces.map(([text, italic]) => {
    context.font = italic ? `italic ${upright}` : upright;
    return context.measureText(text).width;
  });
  let x = centre - widths.reduce((sum, width) => sum + width, 0) / 2;
  context.textAlign = "left";
  pieces.forEach(([text, italic], index) => {
    context.font = italic ? `italic ${upright}` : upright;
    context.fillText(text, x, y);
    x += widths[index];
  });
  context.font = upright;
}

function airy(label) {
  return label.replaceAll("+", " + ");
}

/** "l = k+29" as symbols, which are single letters, in italics and the rest upright. */
function symbolsOf(label) {
  return airy(label).split(/(?<![A-Za-z])([A-Za-z])(?![A-Za-z])/).map((text, index) => [text, index % 2 === 1]);
}

/** Dashed lines down the rows and their labels above. */
export function drawMarks({ context, scale, layout, colours, line, measure }) {
  context.strokeStyle = context.fillStyle = colours.ink;
  context.lineWidth = 1;
  context.textBaseline = "alphabetic";
  for (const { mark, centre } of markLabels(line.marks, scale, layout, measure)) {
    const x = scale(mark.step);
    context.setLineDash([5, 3]);
    context.beginPath();
    context.moveTo(x, layout.foot);
    context.lineTo(x, layout.top);
    context.stroke();
    context.setLineDash([]);
    context.beginPath();
    context.moveTo(x, layout.top);
    context.lineTo(x + (centre - x) * 0.6, layout.top - 4);
    context.stroke();
    writeSymbols(context, symbolsOf(mark.label), centre, layout.top - 7);
  }
}

/** The marks that can be labelled without crowding: where not all fit, m and l of later cycles go first, then all m and
 *  l, then every second k, and so on. */
function markLabels(marks, scale, layout, measure) {
  const [first, end] = scale.domain;
  const seen = marks.filter(({ step }) => step >= first && step <= end);
  const taken = seen.filter(({ label }) => label.startsWith("k"));
  const choices = [seen, seen.filter(({ label }) => label.startsWith("k") || !label.includes("+"))];
  choices.push(...MARK_STRIDES.map((stride) => taken.filter((mark) => cycleOf(mark) % stride === 0)));
  for (const chosen of choices) {
    if (chosen.length * NARROWEST_MARK_PX > layout.width) continue;
    const centres = chosen.map(({ step }) => scale(step));
    const widths = chosen.map(({ label }) => measure(airy(label)));
    const places = spread(centres, widths, layout.left - 20, layout.width, MARK_GAP_PX);
    if (worstShift(centres, places) > MARK_FARTHEST_PX) continue;
    return chosen.map((mark, at) => ({ mark, centre: places[at] }));
  }
  return [];
}

/** Of "k+3N" 3. */
function cycleOf({ label }) {
  const [, times] = /^k\+?(\d*)/.exec(label);
  return times ? Number(times) : Number(label.includes("N"));
}

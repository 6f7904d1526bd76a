// Labels in bars that are long enough, and above the row for work that is too short.

import { shownOf } from "./bars.js";
import { barLabel } from "./colours.js";
import { ABOVE_PX } from "./lanes.js";
import { spread, worstShift } from "./placing.js";

const PADDING_PX = 3;
const CALLOUT_GAP_PX = 6;
const FARTHEST_PX = 17;
const APART_PX = 52;
const APART_INSIDE_PX = 130;
const SHORT_PX = 10;
const LEAST_LABEL_PX = 9;
const HALO_PX = 3.5;

/** In each bar of the row that is long enough where it is shown. */
export function drawLabels({ context, scale, layout, colours, line, measure }, lane) {
  const { start, end, style, late } = lane.row;
  const [from, until] = shownOf(lane.row, ...scale.domain);
  const texts = line.styles.map(barLabel);
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.lineWidth = HALO_PX;
  if ((until - from) * LEAST_LABEL_PX > 2 * layout.width + 1000) return;
  for (let at = from; at < until; at += 1) {
    const [x, toX] = visible(scale, layout, start[at], end[at]);
    const text = texts[style[at]];
    if (!text || toX - x < LEAST_LABEL_PX || toX - x < measure(text) + 2 * PADDING_PX) continue;
    const { fill, ink, hatch } = colours.fills[style[at]];
    const tardy = late[at] < Infinity;
    if (hatch || tardy) {
      context.strokeStyle = tardy ? colours.ground : fill;
      context.strokeText(text, (x + toX) / 2, lane.middle + 0.5);
    }
    context.fillStyle = hatch || tardy ? colours.ink : ink;
    context.fillText(text, (x + toX) / 2, lane.middle + 0.5);
  }
}

/** Over the work of jobs in which no bar is long enough, with a bracket or a leader; none where they would crowd. */
export function drawCallouts(sheet, lane) {
  const { context, colours, measure } = sheet;
  const foot = lane.head - ABOVE_PX;
  const middle = foot - 8;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  for (const { text, centre, start, end } of calloutsOf(sheet, lane)) {
    const half = measure(text) / 2 + 4;
    context.strokeStyle = colours.ground;
    context.lineWidth = 4;
    context.strokeText(text, centre, middle);
    context.strokeStyle = colours.grey;
    context.lineWidth = 0.9;
    context.beginPath();
    if (end - start > 2 * half + 10) {
      path(context, [start, foot], [start, middle], [centre - half, middle]);
      path(context, [centre + half, middle], [end, middle], [end, foot]);
    } else if (end - start > SHORT_PX) {
      path(context, [start, foot + 3], [start, foot], [end, foot], [end, foot + 3]);
    } else {
      path(context, [(start + end) / 2, lane.head], [(start + end) / 2, foot], [centre, foot - 2]);
    }
    context.stroke();
    context.fillStyle = colours.ink;
    context.fillText(text, centre, middle);
  }
}

/** [{text, centre, start, end}], in pixels. */
function calloutsOf({ scale, layout, line, measure }, lane) {
  const width = layout.right - layout.left;
  const kept = new Map();
  lane.row.works.forEach((works, style) => {
    const text = works && barLabel(line.styles[style]);
    if (!text) return;
    const [from, until] = shownOf(works, ...scale.domain);
    if ((until - from) * APART_PX > width) return;
    const needed = measure(text) + 2 * PADDING_PX;
    const outside = [];
    for (let at = from; at < until; at += 1) {
      const inside = works.pieces[at].some(([start, end]) => scale(end) - scale(start) >= needed);
      const [start, end] = visible(scale, layout, works.start[at], works.end[at]);
      if (!inside && start <= end) outside.push({ text, start, end });
    }
    const apart = outside.length < until - from ? APART_INSIDE_PX : APART_PX;
    if (outside.length && outside.length * apart <= width) kept.set(style, outside);
  });
  for (;;) {
    const wanted = [...kept.values()].flat().sort((one, other) => one.start + one.end - other.start - other.end);
    const centres = wanted.map(({ start, end }) => (start + end) / 2);
    const placed = spread(centres, wanted.map(({ text }) => measure(text)), layout.left, layout.right, CALLOUT_GAP_PX);
    if (worstShift(centres, placed) <= FARTHEST_PX) {
      return wanted.map((callout, at) => ({ ...callout, centre: placed[at] }));
    }
    const [most] = [...kept].sort((one, other) => other[1].length - one[1].length)[0];
    kept.delete(most);
  }
}

function visible(scale, layout, start, end) {
  return [Math.max(scale(start), layout.left), Math.min(scale(end), layout.right)];
}

function path(context, [x, y], ...points) {
  context.moveTo(x, y);
  for (const [toX, toY] of points) context.lineTo(toX, toY);
}

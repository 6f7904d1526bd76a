// The work on a row: bars, what is under a pixel merged, work after its deadline in red, and jobs that wait.

import { after } from "./timeline.js";
import { channels, hatchPattern } from "./colours.js";
import { BAR_PX } from "./lanes.js";

const NARROW_PX = 1.5;
const WAIT_PX = 3.5;
const JOINT_PX = 15;
const EDGE_PX = 0.8;
/** Hatches are too fine to be seen in less. */
const HATCHED_PX = 3;
/** What there is at all is seen. */
const FAINTEST = 0.2;

/** Which of the ascending, disjoint intervals {start, end} are within [first, end]: [from, until) of their indices. */
export function shownOf(intervals, first, end) {
  return [after(intervals.end, first), after(intervals.start, end)];
}

/** A thin bar where a job of the row was released and did not run. */
export function drawWaits({ context, scale, ratio, layout, colours }, lane) {
  const columns = columnsOf(layout, ratio);
  const cover = new Float32Array(columns);
  const [first, end] = scale.domain;
  const { waits } = lane.row;
  const [from, until] = shownOf(waits, first, end);
  context.fillStyle = colours.grey;
  for (let at = from; at < until; at += 1) {
    const [x, toX] = [scale(Math.max(waits.start[at], first)), scale(Math.min(waits.end[at], end))];
    if (toX - x >= NARROW_PX) context.fillRect(x, lane.middle - WAIT_PX / 2, toX - x, WAIT_PX);
    else covered(cover, 0, columns, (x - layout.left) * ratio, (toX - layout.left) * ratio);
  }
  drawStrip({ context, ratio, layout }, cover, [channels(colours.grey)], lane.middle - WAIT_PX / 2, WAIT_PX);
}

/** The bars of a row; those under a pixel mixed by what they take of it. None that is late is lost. */
export function drawBars({ context, scale, ratio, layout, colours }, lane) {
  const { start, end, style, late } = lane.row;
  const [first, last] = scale.domain;
  const [from, until] = shownOf(lane.row, first, last);
  const columns = columnsOf(layout, ratio);
  const cover = new Float32Array(columns * colours.fills.length);
  const lateColumns = new Uint8Array(columns);
  const boxes = colours.fills.map(() => []);
  const lateBoxes = [];
  const perStep = (layout.right - layout.left) / (last - first);
  for (let at = from; at < until; at += 1) {
    const x = (Math.max(start[at], first) - first) * perStep;
    const toX = (Math.min(end[at], last) - first) * perStep;
    if (toX - x >= NARROW_PX) boxes[style[at]].push(layout.left + x, toX - x);
    else covered(cover, style[at] * columns, columns, x * ratio, toX * ratio);
    if (late[at] < last) {
      const lateX = (Math.max(late[at], first) - first) * perStep;
      if (toX - lateX >= HATCHED_PX) lateBoxes.push(layout.left + lateX, toX - lateX);
      else lateColumns.fill(1, Math.min(lateX * ratio, columns - 1), Math.ceil(Math.max(toX, lateX + 1) * ratio));
    }
  }
  drawStrip({ context, ratio, layout }, cover, colours.fills.map(({ fill }) => channels(fill)), lane.head, BAR_PX);
  drawBoxes(context, boxes, colours, lane, layout.left - first * perStep);
  if (perStep >= JOINT_PX) drawJoints({ context, scale, colours }, lane, from, until);
  drawLate({ context, ratio, layout, colours }, lateBoxes, lateColumns, lane, layout.left - first * perStep);
}

function drawBoxes(context, boxes, colours, lane, shift) {
  boxes.forEach((own, index) => {
    const { fill, ink, hatch, edge } = colours.fills[index];
    if (!own.length) return;
    context.fillStyle = fill;
    for (let at = 0; at < own.length; at += 2) context.fillRect(own[at], lane.head, own[at + 1], BAR_PX);
    if (hatch) {
      context.fillStyle = hatchPattern(context, hatch, ink, shift);
      for (let at = 0; at < own.length; at += 2) {
        if (own[at + 1] >= HATCHED_PX) context.fillRect(own[at], lane.head, own[at + 1], BAR_PX);
      }
    }
    if (!edge) return;
    context.strokeStyle = edge;
    context.lineWidth = EDGE_PX;
    for (let at = 0; at < own.length; at += 2) {
      const wide = own[at + 1] - EDGE_PX;
      if (own[at + 1] >= HATCHED_PX) context.strokeRect(own[at] + EDGE_PX / 2, lane.head, wide, BAR_PX);
    }
  });
}

/** A fine line where one job follows another without a gap. */
function drawJoints({ context, scale, colours }, lane, from, until) {
  const { start, end, job } = lane.row;
  context.strokeStyle = colours.ink;
  context.lineWidth = 0.6;
  context.beginPath();
  for (let at = Math.max(from, 1); at < until; at += 1) {
    if (start[at] !== end[at - 1] || job[at] === job[at - 1] || start[at] < scale.domain[0]) continue;
    context.moveTo(scale(start[at]), lane.head);
    context.lineTo(scale(start[at]), lane.foot);
  }
  context.stroke();
}

function drawLate({ context, ratio, layout, colours }, boxes, columns, lane, shift) {
  context.fillStyle = colours.ground;
  context.globalAlpha = 0.55;
  for (let at = 0; at < boxes.length; at += 2) context.fillRect(boxes[at], lane.head, boxes[at + 1], BAR_PX);
  context.globalAlpha = 1;
  if (boxes.length) context.fillStyle = hatchPattern(context, "x", colours.red, shift);
  for (let at = 0; at < boxes.length; at += 2) context.fillRect(boxes[at], lane.head, boxes[at + 1], BAR_PX);
  context.fillStyle = colours.red;
  let from = columns.indexOf(1);
  while (from >= 0) {
    const end = columns.indexOf(0, from);
    const until = end < 0 ? columns.length : end;
    context.fillRect(layout.left + from / ratio, lane.head, (until - from) / ratio, BAR_PX);
    from = columns.indexOf(1, until);
  }
}

function columnsOf(layout, ratio) {
  return Math.ceil((layout.right - layout.left) * ratio);
}

/** Adds to each column from `offset` on what [x, toX) takes of it. */
function covered(cover, offset, columns, x, toX) {
  for (let column = Math.floor(x); column < toX && column < columns; column += 1) {
    cover[offset + column] += Math.min(toX, column + 1) - Math.max(x, column);
  }
}

/** One pixel high, and drawn `height` high: of each column the colours, mixed by what they cover. */
function drawStrip({ context, ratio, layout }, cover, colours, y, height) {
  if (!cover.some((part) => part > 0)) return;
  const columns = columnsOf(layout, ratio);
  const strip = new ImageData(columns, 1);
  for (let column = 0; column < columns; column += 1) {
    let total = 0;
    const mixed = [0, 0, 0];
    colours.forEach((colour, index) => {
      const part = cover[index * columns + column];
      total += part;
      for (let channel = 0; channel < 3; channel += 1) mixed[channel] += part * colour[channel];
    });
    if (total === 0) continue;
    for (let channel = 0; channel < 3; channel += 1) strip.data[column * 4 + channel] = mixed[channel] / total;
    strip.data[column * 4 + 3] = 255 * Math.min(Math.max(total, FAINTEST), 1);
  }
  const canvas = new OffscreenCanvas(columns, 1);
  canvas.getContext("2d").putImageData(strip, 0, 0);
  context.imageSmoothingEnabled = false;
  context.drawImage(canvas, layout.left, y, columns / ratio, height);
}

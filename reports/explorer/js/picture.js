// One frame of a Gantt chart on a canvas.

import { linear } from "./scales.js";
import { drawArrows, arrowStride } from "./arrows.js";
import { drawAxes, drawGrid, drawMarks } from "./axis.js";
import { drawBars, drawWaits } from "./bars.js";
import { drawCallouts, drawLabels } from "./labels.js";
import { drawNames, lanesOf } from "./lanes.js";
import { textWidth } from "./textwidth.js";

const FONT_PX = 12.5;
const MOST_RATIO = 3;
const TRACK_PX = 3;

/** Draws `stretch` of a timeline into `canvas`, `width` wide; {line, layout, scale, every}: what it then shows where, and
 *  of how many jobs of a crowded row one has its arrows. */
export function drawGantt(canvas, line, stretch, width, colours, ratio = devicePixelRatio) {
  const context = canvas.getContext("2d");
  const sharp = Math.min(ratio, MOST_RATIO);
  const font = `${FONT_PX}px ${getComputedStyle(canvas).fontFamily}`;
  const measure = (text) => textWidth(text, font);
  const layout = lanesOf(line, width, measure);
  sized(canvas, width, layout.height, sharp);
  context.setTransform(sharp, 0, 0, sharp, 0, 0);
  context.clearRect(0, 0, width, layout.height);
  context.font = font;
  const scale = linear([stretch.first, stretch.end], [layout.left, layout.right]);
  const sheet = { context, scale, ratio: sharp, layout, colours, line, measure };
  const every = arrowStride(sheet);
  drawGrid(sheet);
  drawMarks(sheet);
  drawNames(sheet);
  for (const lane of layout.lanes) {
    drawWaits(sheet, lane);
    drawBars(sheet, lane);
    drawLabels(sheet, lane);
    drawCallouts(sheet, lane);
    drawArrows(sheet, lane, every);
  }
  drawAxes(sheet);
  drawTrack(sheet);
  return { line, layout, scale, every };
}

function sized(canvas, width, height, ratio) {
  const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width === across && canvas.height === down) return;
  [canvas.width, canvas.height] = [across, down];
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
}

/** Which part of all steps is shown, where that is not all. */
function drawTrack({ context, scale, layout, colours, line }) {
  const [first, end] = scale.domain;
  const steps = line.whole.end - line.whole.first;
  if (end - first >= steps) return;
  const across = layout.right - layout.left;
  const y = layout.height - TRACK_PX;
  context.fillStyle = colours.pale;
  context.fillRect(layout.left, y, across, TRACK_PX);
  context.fillStyle = colours.accent;
  const length = Math.max(((end - first) / steps) * across, 6);
  const shift = Math.min(((first - line.whole.first) / steps) * across, across - length);
  context.fillRect(layout.left + shift, y, length, TRACK_PX);
}

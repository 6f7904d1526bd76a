// The rows of a Gantt chart: their places from top to bottom, in pixels, and their names.

export const BAR_PX = 22;
export const ABOVE_PX = 13;
const BELOW_PX = 12;
const CALLOUT_PX = 17;
const LANE_GAP_PX = 3;
const MARKS_PX = 22;
const STEPS_PX = 49;
const MS_PX = 47;
const RIGHT_PX = 22;
const LEAST_NAMES_PX = 34;
const MOST_NAMES_PX = 120;
const NAMES_SHARE = 0.22;

/** {left, right, top, foot, height, lanes}: of the rows of a timeline, in a chart so wide; `measure` gives the width of
 *  a text. Each lane: {row, head, foot, middle}, of its bars. */
export function lanesOf(line, width, measure) {
  const names = line.rows.flatMap((row) => [measure(row.name), measure(row.cpu)]);
  const left = 12 + Math.min(Math.max(LEAST_NAMES_PX, ...names), MOST_NAMES_PX, width * NAMES_SHARE);
  let y = MARKS_PX;
  const lanes = line.rows.map((row) => {
    const head = y + ABOVE_PX + (row.calls ? CALLOUT_PX : 0);
    y = head + BAR_PX + BELOW_PX + LANE_GAP_PX;
    return { row, head, foot: head + BAR_PX, middle: head + BAR_PX / 2 };
  });
  const height = y + STEPS_PX + (line.periodMs === null ? 0 : MS_PX);
  return { left, right: Math.max(width - RIGHT_PX, left + 1), top: MARKS_PX, foot: y, height, width, lanes };
}

/** The lane of a point, with what is above and below its bars; null if there is none. */
export function laneAt(layout, y) {
  const within = y >= layout.top && y <= layout.foot;
  return within ? (layout.lanes.find((lane) => y <= lane.foot + BELOW_PX + LANE_GAP_PX) ?? null) : null;
}

/** Names at the left, and a base line below each row as far as the schedule goes. */
export function drawNames({ context, scale, layout, colours, line }) {
  const until = Math.min(scale(line.steps), layout.right);
  context.strokeStyle = colours.grey;
  context.lineWidth = 0.75;
  context.beginPath();
  for (const { foot } of layout.lanes) {
    context.moveTo(layout.left, foot);
    context.lineTo(until, foot);
  }
  context.stroke();
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const { row, middle } of layout.lanes) {
    const shift = row.cpu ? 7 : 0;
    context.fillStyle = colours.ink;
    context.fillText(shortened(context, row.name, layout.left - 12), layout.left - 10, middle - shift);
    context.fillStyle = colours.grey;
    context.fillText(row.cpu, layout.left - 10, middle + shift);
  }
}

/** A text, cut where it would be wider. */
function shortened(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  let letters = text.length;
  while (letters > 1 && context.measureText(`${text.slice(0, letters)}…`).width > width) letters -= 1;
  return `${text.slice(0, letters)}…`;
}

// Releases as arrows up below a row, deadlines as arrows down above it, missed ones in red with a cross.

import { after } from "./timeline.js";

const ARROW_ROOM_PX = 10;
const TAIL_PX = 11.5;
const TIP_PX = 2;
const HEAD_PX = 5;
const CROSS_PX = 3.2;
const CROSS_ROOM_PX = 7;
const ARROW_STRIDES = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 100000];

/** Of how many jobs of a crowded row one has its arrows, so that none is crowded any more; 1 if none is. */
export function arrowStride({ scale, layout, line }) {
  const room = (layout.right - layout.left) / ARROW_ROOM_PX;
  const [first, end] = scale.domain;
  const most = Math.max(0, ...line.rows.map(({ arrows }) => mostArrows(arrows, first, end)));
  return ARROW_STRIDES.find((stride) => most <= stride * room + 1);
}

function mostArrows({ release, deadline }, first, end) {
  return Math.max(...[release, deadline].map(({ at }) => after(at, end) - after(at, first)));
}

/** Those of one row; `every`: of its jobs where it is crowded. */
export function drawArrows({ context, scale, layout, colours }, lane, every) {
  const [first, end] = scale.domain;
  const { release, deadline, missed } = lane.row.arrows;
  const crowded = mostArrows(lane.row.arrows, first, end) > (layout.right - layout.left) / ARROW_ROOM_PX + 1;
  const stride = crowded ? every : 1;
  const shown = ({ at, number }) => {
    const kept = within(at, first, end).filter((index) => number[index] % stride === 0);
    return kept.map((index) => scale(at[index]));
  };
  arrowRow(context, shown(release), lane.foot + TAIL_PX, lane.foot + TIP_PX, colours.ink);
  arrowRow(context, shown(deadline), lane.head - TAIL_PX, lane.head - TIP_PX, colours.ink);
  drawMissed({ context, colours }, within(missed, first, end).map((index) => scale(missed[index])), lane);
}

/** Arrows from `tail` to `tip` at each x. */
export function arrowRow(context, xs, tail, tip, colour) {
  const back = tip + Math.sign(tail - tip) * HEAD_PX;
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 1.1;
  context.beginPath();
  for (const x of xs) {
    context.moveTo(x, tail);
    context.lineTo(x, back);
  }
  context.stroke();
  context.beginPath();
  for (const x of xs) {
    context.moveTo(x, tip);
    context.lineTo(x - HEAD_PX * 0.6, back);
    context.lineTo(x + HEAD_PX * 0.6, back);
  }
  context.fill();
}

/** Red arrows with a cross; a line joins those too close to each other for crosses of their own. */
export function drawMissed({ context, colours }, xs, lane) {
  const middle = lane.head - TAIL_PX + 1;
  const apart = [];
  context.fillStyle = colours.red;
  xs.forEach((x, index) => {
    const last = index === xs.length - 1;
    if (!apart.length || x - apart[apart.length - 1] >= CROSS_ROOM_PX || last) apart.push(x);
    if (index && x - xs[index - 1] < CROSS_ROOM_PX) {
      context.fillRect(xs[index - 1] - 0.5, lane.head - TIP_PX - 1, Math.max(x - xs[index - 1], 0) + 1, 1.5);
    }
  });
  arrowRow(context, apart, lane.head - TAIL_PX, lane.head - TIP_PX, colours.red);
  context.strokeStyle = colours.red;
  context.lineWidth = 1.7;
  context.beginPath();
  for (const x of apart) {
    context.moveTo(x - CROSS_PX, middle - CROSS_PX);
    context.lineTo(x + CROSS_PX, middle + CROSS_PX);
    context.moveTo(x - CROSS_PX, middle + CROSS_PX);
    context.lineTo(x + CROSS_PX, middle - CROSS_PX);
  }
  context.stroke();
}

/** Indices of ascending instants from `first` to `end`. */
function within(at, first, end) {
  const from = after(at, first - 1e-9);
  return Array.from({ length: after(at, end) - from }, (_, index) => from + index);
}

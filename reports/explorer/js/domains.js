// Which part of the axes a plot shows.

import { extent } from "./scales.js";

const PLOT_MARGIN = 0.04;
const LIMIT_NEAR = 4;

/** The x axis of lines and designs, as `plotFrame` takes it. */
export function acrossDomain({ x, points }, lines) {
  const known = lines.map((line) => line.x.filter((_, index) => line.y[index] !== null));
  const domain = roomyDomain(extent(points.map((point) => point.x), ...known), x.log, PLOT_MARGIN / 2);
  return { ...x, domain, whole: lines.length > 0 && lines.every((line) => line.whole) };
}

/** The y axis: with the limit, unless that would make what is drawn too small to see. */
export function downDomain({ y, points, limit }, lines) {
  const values = [points.map((point) => point.y), ...lines.map((line) => line.y)];
  const drawn = extent(...values.map((each) => (y.log ? each.filter((value) => value > 0) : each)));
  const near = limit !== null && (drawn === null || y.log || isLimitNear(limit.y, drawn));
  return { ...y, domain: roomyDomain(near ? extent(drawn ?? [], [limit.y]) : drawn, y.log, PLOT_MARGIN), whole: false };
}

function isLimitNear(limit, [low, high]) {
  const length = high - low || Math.abs(high) * PLOT_MARGIN;
  return Math.max(limit, high) - Math.min(limit, low) <= LIMIT_NEAR * length;
}

/** A domain with a margin of this share of its length at both ends. */
function roomyDomain(domain, log, margin) {
  if (domain === null || domain[0] === domain[1] || (log && domain[0] <= 0)) return domain;
  const [low, high] = domain;
  const ratio = log ? (high / low) ** margin : margin * (high - low);
  return log ? [low / ratio, high * ratio] : [low - ratio, high + ratio];
}

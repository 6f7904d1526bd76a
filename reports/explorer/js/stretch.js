// The stretch of steps that a chart shows: {first, end}, within 0 and the number of steps there are.

/** No less of a step can be shown. */
export const NARROWEST_STEPS = 0.02;

/** All of them. */
export function wholeStretch(steps) {
  return { first: 0, end: Math.max(steps, NARROWEST_STEPS) };
}

export function isWhole(stretch, steps) {
  return stretch.first <= 0 && stretch.end >= steps;
}

/** `factor` times as long, with the step `at` where it was. */
export function zoomedStretch(stretch, factor, at, steps) {
  const length = clamped((stretch.end - stretch.first) * factor, NARROWEST_STEPS, Math.max(steps, NARROWEST_STEPS));
  const share = (at - stretch.first) / (stretch.end - stretch.first);
  return placed(at - share * length, length, steps);
}

/** As long, and so many steps later. */
export function movedStretch(stretch, by, steps) {
  return placed(stretch.first + by, stretch.end - stretch.first, steps);
}

/** As long, and moved no farther than it takes to show [start, end]; its start, if it is longer. */
export function stretchWith(stretch, start, end, steps) {
  const length = stretch.end - stretch.first;
  if (start >= stretch.first && end <= stretch.end) return stretch;
  const margin = Math.max(0, Math.min(length / 8, (length - (end - start)) / 2));
  const first = start < stretch.first || end - start > length ? start - margin : end + margin - length;
  return placed(first, length, steps);
}

function placed(first, length, steps) {
  const from = clamped(first, 0, Math.max(0, steps - length));
  return { first: from, end: from + length };
}

/** The nearest number to `value` in [low, high]. */
export function clamped(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

// The stretch of steps that a chart shows, {first, end}, within the whole of those there are.

/** No less of a step can be shown. */
const NARROWEST_STEPS = 0.02;

/** From `first` to `end`, or a little more where that is nothing. */
export function wholeStretch(first, end) {
  return { first, end: Math.max(end, first + NARROWEST_STEPS) };
}

export function sameStretch(one, other) {
  return one?.first === other.first && one.end === other.end;
}

/** `factor` times as long, with the step `at` where it was. */
export function zoomedStretch(stretch, factor, at, whole) {
  const length = clamped((stretch.end - stretch.first) * factor, NARROWEST_STEPS, whole.end - whole.first);
  const share = (at - stretch.first) / (stretch.end - stretch.first);
  return placed(at - share * length, length, whole);
}

/** As long, and so many steps later. */
export function movedStretch(stretch, by, whole) {
  return placed(stretch.first + by, stretch.end - stretch.first, whole);
}

/** As long, and moved no farther than it takes to show [start, end]; its start, if it is longer. */
export function stretchWith(stretch, start, end, whole) {
  const length = stretch.end - stretch.first;
  if (start >= stretch.first && end <= stretch.end) return stretch;
  const margin = Math.max(0, Math.min(length / 8, (length - (end - start)) / 2));
  const first = start < stretch.first || end - start > length ? start - margin : end + margin - length;
  return placed(first, length, whole);
}

function placed(first, length, whole) {
  if (length >= whole.end - whole.first) return whole;
  const from = clamped(first, whole.first, whole.end - length);
  return { first: from, end: from + length };
}

/** The nearest number to `value` in [low, high]. */
function clamped(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

// Path data of lines, thinned to what pixels can show.

const COLUMN_PX = 0.5;
const CLEAR_PX = 8;

/** Of a line through these points, in the pixels of two scales: a step line holds each value until the next x. Where a
 *  value is null, or has no place on its scale, there is a gap. Within a column of half a pixel it keeps the first, the
 *  extreme and the last value. */
export function linePath(xs, ys, x, y, step) {
  const parts = [];
  let column = null;
  let begun = false;
  const flush = () => {
    if (column === null) return;
    if (!begun) parts.push(`M${column.x} ${column.first}`);
    else parts.push(step ? `H${column.x}V${column.first}` : `L${column.x} ${column.first}`);
    const stays = column.low === column.high;
    if (stays && !begun) parts.push("h0");
    if (!stays) parts.push(`V${column.low}V${column.high}V${column.last}`);
    begun = true;
    column = null;
  };
  for (let index = 0; index < xs.length; index += 1) {
    const across = tenthOfPixel(x(xs[index]));
    const down = tenthOfPixel(y(ys[index]));
    if (across === null || down === null) {
      flush();
      if (begun && step && across !== null) parts.push(`H${across}`);
      begun = false;
    } else if (column !== null && Math.abs(across - column.x) < COLUMN_PX) {
      column.low = Math.min(column.low, down);
      column.high = Math.max(column.high, down);
      column.last = down;
    } else {
      flush();
      column = { x: across, first: down, low: down, high: down, last: down };
    }
  }
  flush();
  return parts.join("");
}

function tenthOfPixel(pixel) {
  return pixel === null ? null : Math.round(pixel * 10) / 10;
}

/** Pixels [across, down] at which a line, {x, y, step, whole}, gets a marker: some `apart` from the one before, the
 *  first about `from` behind its start, so that lines which lie on each other differ. A step line has them wherever it
 *  holds, at whole x where all of its own are; another one at its points, and at each that stands alone. */
export function markerPlaces(line, { x, y }, apart, from) {
  const points = line.x.map((at, index) => [x(at), y(line.y[index])]);
  const known = points.map((point) => !point.includes(null));
  const drawn = points.filter((_, index) => known[index]);
  if (drawn.length === 0) return [];
  const held = line.step ? heldPlaces(line, { x, y }, drawn[0][0] + from, apart) : [];
  if (line.step) return held.length > 0 ? held : drawn.slice(0, 1);
  let next = drawn[0][0] + from;
  return points.filter((point, index) => {
    const alone = !known[index - 1] && !known[index + 1];
    if (!known[index] || (!alone && point[0] < next)) return false;
    next = Math.max(next, point[0]) + apart;
    return true;
  });
}

function heldPlaces(line, { x, y }, first, apart) {
  const found = [];
  const end = x(line.x[line.x.length - 1]);
  for (let across = first; across <= end; across += apart) {
    const at = line.whole ? Math.round(x.invert(across)) : x.invert(across);
    const place = [x(at), y(valueAt(line.x, line.y, at, true))];
    if (!place.includes(null)) found.push(place);
  }
  return found;
}

/** The value of a line at x: of a step line what holds there, behind its last point too; of another one what is at that
 *  very x; null where there is nothing. xs ascend. */
export function valueAt(xs, ys, at, step) {
  const index = indexAt(xs, at);
  if (index < 0) return null;
  return step || xs[index] === at ? ys[index] : null;
}

/** A line with its points from the least x to the greatest, where they are the other way round. */
export function ascending(line) {
  if (line.x.length === 0 || line.x[0] <= line.x[line.x.length - 1]) return line;
  const turned = (values) => values && [...values].reverse();
  return { ...line, x: turned(line.x), y: turned(line.y), notes: turned(line.notes) };
}

/** A step line with one more point, at which it still holds its last value. */
export function heldUntil(line, end) {
  const last = line.x.length - 1;
  if (!line.step || last < 0 || line.x[last] >= end) return line;
  return { ...line, x: [...line.x, end], y: [...line.y, line.y[last]] };
}

/** The last index whose x is no more than this; −1 before the first. */
export function indexAt(xs, at) {
  let [low, high] = [-1, xs.length - 1];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (xs[middle] <= at) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Points on a line that are some pixels apart, for labels to stay clear of. */
export function pointsAlong(line, { x, y }) {
  const found = [];
  let before = null;
  line.x.forEach((at, index) => {
    const here = [x(at), y(line.y[index])];
    if (here.includes(null)) return (before = null);
    const long = before === null ? CLEAR_PX : Math.hypot(here[0] - before[0], here[1] - before[1]);
    if (long < CLEAR_PX / 2) return null;
    const count = Math.ceil(long / CLEAR_PX);
    for (let part = 1; part < count; part += 1) {
      const share = part / count;
      const down = line.step ? before[1] : before[1] + share * (here[1] - before[1]);
      found.push([before[0] + share * (here[0] - before[0]), down]);
    }
    found.push(here);
    before = here;
    return null;
  });
  return found;
}

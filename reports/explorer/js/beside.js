// Where texts go: beside their points, within the plot, and not on one another.

const TEXT_GAP_PX = 4;
const LABEL_AWAY_PX = [9, 22, 38];

/** The places of texts, each {x, y, width, height} beside its point {x, y}, as a box {left, top, right, bottom, far} or
 *  null where there is none: within `bounds`, a box, and clear of each other and of the boxes `taken`. The nearest that
 *  covers none of the points `lines`, [[x, y], ...], else the nearest. far: so far away that a line has to lead
 *  there. */
export function besidePoints(points, bounds, taken, lines) {
  const boxes = [...taken];
  return points.map((point) => {
    const places = placesBeside(point);
    const place = firstClear(coveringNone(places, lines), bounds, boxes) ?? firstClear(places, bounds, boxes);
    if (place !== null) boxes.push(place);
    return place;
  });
}

/** The first box that is within the bounds and clear of those taken, or null. */
export function firstClear(boxes, bounds, taken) {
  return boxes.find((box) => isInside(box, bounds) && !taken.some((other) => doOverlap(box, other))) ?? null;
}

/** The boxes that cover none of these points. */
export function coveringNone(boxes, points) {
  const covers = (box, [x, y]) => x > box.left && x < box.right && y > box.top && y < box.bottom;
  return boxes.filter((box) => !points.some((point) => covers(box, point)));
}

function placesBeside({ x, y, width, height }) {
  return LABEL_AWAY_PX.flatMap((away, ring) => {
    const [right, left] = [x + away, x - away - width];
    const [above, below, middle] = [y - away - height, y + away, y - height / 2];
    const centre = x - width / 2;
    const corners = [middle - away / 2 - 4, middle + away / 2 + 4].flatMap((top) => [[right, top], [left, top]]);
    const places = [...corners, [right, middle], [left, middle], [centre, above], [centre, below]];
    return places.map(([at, top]) => ({ left: at, top, right: at + width, bottom: top + height, far: ring > 0 }));
  });
}

function isInside(box, bounds) {
  return box.left >= bounds.left && box.right <= bounds.right && box.top >= bounds.top && box.bottom <= bounds.bottom;
}

/** Whether two boxes have anything in common. */
export function doOverlap(one, other) {
  return one.left < other.right && other.left < one.right && one.top < other.bottom && other.top < one.bottom;
}

/** The indices of texts on a line that are kept, so that none comes near the next: those of every second, third, ...
 *  of them. */
export function clearOfNext(centres, widths) {
  for (let every = 1; every < centres.length; every += 1) {
    const kept = centres.map((_, index) => index).filter((index) => index % every === 0);
    const clear = kept.every((index, number) => {
      if (number === 0) return true;
      const before = kept[number - 1];
      return Math.abs(centres[index] - centres[before]) >= (widths[index] + widths[before]) / 2 + 2 * TEXT_GAP_PX;
    });
    if (clear) return kept;
  }
  return centres.length > 0 ? [0] : [];
}

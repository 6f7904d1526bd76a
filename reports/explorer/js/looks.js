// How lines look: each method as in print, other names in turn. Colour, dashes and marker all differ.

const METHOD_LOOKS = {
  standard: ["1 1.2", "s"],
  recalculate: ["5 1.5 1 1.5", "D"],
  larsen: ["4 1.5", "^"],
  "dual-rate": ["", "o"],
  clone: ["6 1.5", "v"],
  "clone-split": ["2.5 1", "<"],
  "carried-gain": ["6 1.5 1 1.5 1 1.5", "P"],
  "delayed-horizon": ["9 1.2 1.5 1.2", ">"],
  "px4-predictor": ["3.5 1 1 1", "p"],
  augmentation: ["8 2.5", "h"],
  "fuse-as-fresh": ["1 2.4", "X"],
};
const SOURCE_MARKERS = ["|", "o", "^", "s", "D"];
const SOURCE_DASHES = ["", "7 2", "2 1.5", "5 1.5 1 1.5", "10 2 2 2"];
const STROKE_PX = 1.6;
const MARKER_PX = 3.6;
const CROSS_THICKNESS = 0.4;

/** Of each name, in their order: its colour, dashes in pixels ("" for none) and marker. */
export function looksOf(names) {
  let others = 0;
  return names.map((name) => {
    if (name in METHOD_LOOKS) return lookOf(`--ss-method-${name}`, ...METHOD_LOOKS[name]);
    const turn = others++ % SOURCE_MARKERS.length;
    return lookOf(`--ss-source-${turn}`, SOURCE_DASHES[turn], SOURCE_MARKERS[turn]);
  });
}

function lookOf(colour, dashes, marker) {
  const inPixels = dashes.split(" ").map((dash) => dash && Math.round(Number(dash) * STROKE_PX * 10) / 10);
  return { colour: `var(${colour})`, dashes: inPixels.join(" "), marker };
}

/** Path data of a marker about the point where the path is: to be put behind an `M x y`; "" of one that is not here. */
export function markerPath(marker, radius = MARKER_PX) {
  return MARKER_SHAPES[marker]?.(radius) ?? "";
}

const MARKER_SHAPES = {
  o: (r) => `m${-r} 0a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`,
  s: (r) => polygon(4, r * 1.2, Math.PI / 4),
  D: (r) => polygon(4, r * 1.25, 0),
  "^": (r) => polygon(3, r * 1.25, -Math.PI / 2),
  v: (r) => polygon(3, r * 1.25, Math.PI / 2),
  "<": (r) => polygon(3, r * 1.25, Math.PI),
  ">": (r) => polygon(3, r * 1.25, 0),
  p: (r) => polygon(5, r * 1.2, -Math.PI / 2),
  h: (r) => polygon(6, r * 1.2, 0),
  P: (r) => crossShape(r * 1.25, 0),
  X: (r) => crossShape(r * 1.25, Math.PI / 4),
  "|": (r) => `m0 ${-1.4 * r}v${2.8 * r}`,
};

function polygon(corners, radius, turn) {
  const angles = Array.from({ length: corners }, (_, corner) => turn + (corner * 2 * Math.PI) / corners);
  return closedPath(angles.map((angle) => [radius * Math.cos(angle), radius * Math.sin(angle)]));
}

function crossShape(radius, turn) {
  const thick = radius * CROSS_THICKNESS;
  const arm = [
    [radius, -thick],
    [radius, thick],
    [thick, thick],
  ];
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const quarters = [([x, y]) => [x, y], ([x, y]) => [-y, x], ([x, y]) => [-x, -y], ([x, y]) => [y, -x]];
  const corners = quarters.flatMap((turned) => arm.map(turned));
  return closedPath(corners.map(([x, y]) => [cos * x - sin * y, sin * x + cos * y]));
}

function closedPath(corners) {
  const steps = corners.map(([x, y], corner) => {
    const [fromX, fromY] = corners[corner - 1] ?? [0, 0];
    return `${corner === 0 ? "m" : "l"}${(x - fromX).toFixed(2)} ${(y - fromY).toFixed(2)}`;
  });
  return `${steps.join("")}z`;
}

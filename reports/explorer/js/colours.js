// Colours of palette.css as a canvas takes them, and hatches.

import { isTask, taskName } from "./tasks.js";

/** The hatch of each label of reports/drawing/style.FILLS that has one. */
export const HATCHES = { G: "\\", R: "\\", CA: ".", LA: "/", LRP: "/", LRG: "\\", OC: "\\", RP: "\\", CU: "/" };
/** Of the user's tasks, in turn. */
export const TASK_HATCHES = ["-", "\\", "", "+"];

const GENERAL = ["ground", "raised", "ink", "grey", "pale", "red", "accent"];
const TILE = 8;
const RISING = [[-0.5, 0.5, 0.5, -0.5], [-0.5, 1.5, 1.5, -0.5], [0.5, 1.5, 1.5, 0.5]];
const FALLING = [[-0.5, 0.5, 0.5, 1.5], [-0.5, -0.5, 1.5, 1.5], [0.5, -0.5, 1.5, 0.5]];
const ACROSS = [[0, 0.5, 1, 0.5]];
const HATCH_LINES = {
  "/": RISING,
  "\\": FALLING,
  x: [...RISING, ...FALLING],
  "-": ACROSS,
  "+": [...ACROSS, [0.5, 0, 0.5, 1]],
};

/** Under which names palette.css has the work of each style, in order. */
export function fillNames(styles) {
  const tasks = styles.map((style) => style.label).filter(isTask).sort();
  return styles.map(({ label }) => (isTask(label) ? `task${tasks.indexOf(label) % TASK_HATCHES.length}` : label));
}

/** What a bar of this style is labelled with: nothing for context switches. */
export function barLabel({ label }) {
  if (label === "switch") return "";
  return isTask(label) ? taskName(label) : label;
}

/** The colours that `element` has at present: {ground, ink, ...} and `fills` of the styles, each {fill, ink,
 *  hatch, edge}: of the outline, "" where the fill stands out from the ground. */
export function coloursOf(element, styles) {
  const probe = document.createElement("span");
  probe.className = "ss-gantt-probe";
  element.append(probe);
  const seen = (value) => {
    probe.style.color = value;
    return getComputedStyle(probe).color;
  };
  const general = Object.fromEntries(GENERAL.map((name) => [name, seen(`var(--ss-${name})`)]));
  const outlined = matchMedia("(forced-colors: active)").matches;
  const fills = fillNames(styles).map((name) => {
    const fill = seen(`var(--ss-fill-${name}, var(--ss-fill-task0))`);
    const ink = seen(`var(--ss-ink-${name}, var(--ss-ink-task0))`);
    const hatch = name.startsWith("task") ? TASK_HATCHES[Number(name.slice(4))] : (HATCHES[name] ?? "");
    return { fill, ink, hatch, edge: outlined ? general.ink : contrastOf(fill, general.ground) < 3 ? ink : "" };
  });
  probe.remove();
  return { ...general, fills };
}

/** Of two computed colours, as the Web Content Accessibility Guidelines define it. */
function contrastOf(one, other) {
  const [dark, light] = [one, other].map(luminanceOf).sort((a, b) => a - b);
  return (light + 0.05) / (dark + 0.05);
}

function luminanceOf(colour) {
  const parts = channels(colour).map((part) => (part <= 10 ? part / 3294.6 : ((part / 255 + 0.055) / 1.055) ** 2.4));
  return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
}

/** [red, green, blue] of a computed colour. */
export function channels(colour) {
  return colour.match(/[\d.]+/g).slice(0, 3).map(Number);
}

/** A pattern of lines or dots in `colour`; they move with `shift`, in pixels. */
export function hatchPattern(context, sign, colour, shift = 0) {
  const ratio = context.getTransform().a;
  const tile = new OffscreenCanvas(Math.round(TILE * ratio), Math.round(TILE * ratio));
  const pen = tile.getContext("2d");
  pen.scale(tile.width / TILE, tile.height / TILE);
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = 1;
  pen.beginPath();
  for (const [x, y, toX, toY] of HATCH_LINES[sign] ?? []) {
    pen.moveTo(x * TILE, y * TILE);
    pen.lineTo(toX * TILE, toY * TILE);
  }
  pen.stroke();
  if (sign === ".") for (const [x, y] of [[2, 2], [6, 6]]) pen.fillRect(x - 0.8, y - 0.8, 1.6, 1.6);
  const pattern = context.createPattern(tile, "repeat");
  pattern.setTransform(new DOMMatrix().translate(shift % TILE, 0).scale(TILE / tile.width));
  return pattern;
}

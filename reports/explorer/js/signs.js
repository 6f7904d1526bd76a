// What a plot marks besides its lines: designs with a ring and a label, and a limit with what lies beyond it.

import { svg } from "./svg.js";
import { besidePoints, coveringNone, firstClear } from "./beside.js";
import { textWidth } from "./textwidth.js";
import { reusedChildren } from "./frame.js";

const DESIGN_RING_PX = 7;
const DESIGN_PIN_PX = 4;
const LABEL_HEIGHT = 15;
const LIMIT_INSET_PX = 6;

/** Marks in a group. `lay({points, limit, lines, x, y, box, font})` draws them within a frame. points: [{x, y,
 *  label, current}]; limit: {y, label} or null; lines: [[x, y], ...] in pixels, which labels leave free if they can.
 *  What has no place in the frame is left out, and an arrow says where a limit is that lies outside. */
export function plotSigns() {
  const beyond = svg("path", { class: "ss-plot-beyond" });
  const edge = svg("path", { class: "ss-plot-limit" });
  const said = svg("text", { class: "ss-plot-limit-label" });
  const [rings, leads, labels] = [svg("g"), svg("path", { class: "ss-plot-lead" }), svg("g")];
  const under = svg("g", {}, beyond, edge);
  const over = svg("g", {}, leads, rings, said, labels);

  function lay({ points, limit, lines, x, y, box, font }) {
    const radiusOf = (point) => (point.current ? DESIGN_RING_PX : DESIGN_PIN_PX);
    const all = points.map((point) => ({ ...point, x: x(point.x), y: y(point.y), radius: radiusOf(point) }));
    const placed = all.filter((point) => point.x !== null && point.y !== null);
    const boxes = placed.map(({ x: across, y: down, radius }) => boxAround(across, down, radius + 1));
    const written = layLimit({ limit, y, box, font, boxes, lines });
    if (written !== null) boxes.push(written);
    layRings(placed);
    layLabels({ placed, box, font, boxes, lines });
  }

  function layLimit({ limit, y, box, font, boxes, lines }) {
    const at = limit === null ? null : y(limit.y);
    const above = at !== null && at < box.top;
    const below = at !== null && at > box.bottom;
    const down = at === null ? null : Math.min(Math.max(at, box.top), box.bottom);
    beyond.setAttribute("d", down === null || above ? "" : `M${box.left} ${box.top}H${box.right}V${down}H${box.left}z`);
    edge.setAttribute("d", down === null || above || below ? "" : `M${box.left} ${down}H${box.right}`);
    said.textContent = down === null ? "" : `${above ? "↑ " : below ? "↓ " : ""}${limit.label}`;
    if (down === null) return null;
    const width = textWidth(said.textContent, font);
    const tops = above ? [down + 2] : below ? [down - LABEL_HEIGHT - 2] : [down - LABEL_HEIGHT - 2, down + 3];
    const lefts = [box.right - width - LIMIT_INSET_PX, box.left + LIMIT_INSET_PX, (box.left + box.right - width) / 2];
    const boxOf = (left, top) => ({ left, top, right: left + width, bottom: top + LABEL_HEIGHT });
    const places = tops.flatMap((top) => lefts.map((left) => boxOf(left, top)));
    const tried = [[coveringNone(places, lines), boxes], [places, boxes], [places, []]];
    const place = tried.reduce((found, [each, taken]) => found ?? firstClear(each, box, taken), null) ?? places[0];
    putText(said, place);
    return place;
  }

  function layRings(placed) {
    reusedChildren(rings, placed.length, () => svg("circle")).forEach((ring, index) => {
      const { x, y, radius, current } = placed[index];
      ring.setAttribute("class", current ? "ss-plot-ring" : "ss-plot-pin");
      ring.setAttribute("cx", x.toFixed(1));
      ring.setAttribute("cy", y.toFixed(1));
      ring.setAttribute("r", radius);
    });
  }

  function layLabels({ placed, box, font, boxes, lines }) {
    const named = placed.filter((point) => point.label !== "");
    const first = named.sort((one, other) => Number(other.current) - Number(one.current));
    const widthOf = (point) => textWidth(point.label, `bold ${font}`);
    const sized = first.map((point) => ({ ...point, width: widthOf(point), height: LABEL_HEIGHT }));
    const bounds = { ...box, top: box.top - 8, right: box.right + 8 };
    const places = besidePoints(sized, bounds, boxes, lines);
    const shown = sized.filter((_, index) => places[index] !== null);
    const found = places.filter((place) => place !== null);
    const lead = (place, { x, y }) => `M${x.toFixed(1)} ${y.toFixed(1)}L${edgeToward(place, x, y)}`;
    const led = found.map((place, index) => (place.far ? lead(place, shown[index]) : ""));
    leads.setAttribute("d", led.join(""));
    reusedChildren(labels, shown.length, () => svg("text", { class: "ss-plot-label" })).forEach((text, index) => {
      text.textContent = shown[index].label;
      putText(text, found[index]);
    });
  }

  return { under, over, lay };
}

function boxAround(x, y, radius) {
  return { left: x - radius, top: y - radius, right: x + radius, bottom: y + radius };
}

function edgeToward({ left, top, right, bottom }, x, y) {
  return `${Math.min(Math.max(x, left), right).toFixed(1)} ${Math.min(Math.max(y, top), bottom).toFixed(1)}`;
}

function putText(text, { left, top }) {
  text.setAttribute("x", left.toFixed(1));
  text.setAttribute("y", (top + LABEL_HEIGHT * 0.78).toFixed(1));
}

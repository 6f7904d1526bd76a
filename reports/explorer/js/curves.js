// The lines of a plot, each a path and a path of markers.

import { svg } from "./svg.js";
import { reusedChildren } from "./frame.js";
import { markerPath } from "./looks.js";
import { linePath, markerPlaces } from "./paths.js";

const MARKERS_APART_PX = 76;

/** Draws lines, {name, x, y, step, current, look}, into a group within a frame, the current one on top. */
export function drawCurves(group, lines, { x, y, box }) {
  const apart = Math.min(MARKERS_APART_PX, box.right - box.left);
  const last = [...lines].sort((one, other) => Number(one.current ?? false) - Number(other.current ?? false));
  const make = () => svg("g", {}, svg("path", { class: "ss-plot-line" }), svg("path", { class: "ss-plot-marker" }));
  reusedChildren(group, last.length, make).forEach((element, index) => {
    const line = last[index];
    const [path, markers] = element.children;
    element.setAttribute("class", line.current ? "ss-plot-now" : "");
    for (const each of [path, markers]) each.setAttribute("stroke", line.look.colour);
    path.setAttribute("d", linePath(line.x, line.y, x, y, line.step));
    path.setAttribute("stroke-dasharray", line.look.dashes || "none");
    markers.setAttribute("fill", line.look.colour);
    const from = ((lines.indexOf(line) + 0.5) / lines.length) * apart;
    const shape = markerPath(line.look.marker);
    const places = markerPlaces(line, { x, y }, apart, from);
    const data = places.map(([across, down]) => `M${across.toFixed(1)} ${down.toFixed(1)}${shape}`);
    markers.setAttribute("d", data.join(""));
  });
}

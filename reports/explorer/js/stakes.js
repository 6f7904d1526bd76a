// Lines across a histogram with their names above it: a deadline, quantiles.

import { svg } from "./svg.js";
import { reusedChildren } from "./frame.js";
import { doOverlap } from "./beside.js";
import { textWidth } from "./textwidth.js";

const STAKE_ROWS = 3;
const STAKE_ROW_PX = 15;
/** What has to be free above the frame. */
export const STAKES_TOP_PX = STAKE_ROWS * STAKE_ROW_PX + 4;

/** Lines in an element of their own. `lay({stakes, x, box, font})` draws those of [{x, label, red}], and their labels
 *  above them, in as many rows as keep these apart. Of one that lies outside the frame an arrow at its edge says
 *  so. */
export function plotStakes() {
  const [lines, names] = [svg("g"), svg("g")];
  const element = svg("g", {}, lines, names);

  function lay({ stakes, x, box, font }) {
    const placed = placedNames(stakes, x, box, font);
    reusedChildren(lines, placed.length, () => svg("path")).forEach((line, index) => {
      const { at, top, red, outside } = placed[index];
      line.setAttribute("class", red ? "ss-histogram-deadline" : "ss-histogram-mark");
      line.setAttribute("d", outside ? "" : `M${at.toFixed(1)} ${top + STAKE_ROW_PX}V${box.bottom}`);
    });
    reusedChildren(names, placed.length, () => svg("text")).forEach((name, index) => {
      const { left, top, text, red } = placed[index];
      name.setAttribute("class", red ? "ss-plot-limit-label" : "ss-histogram-name");
      name.setAttribute("x", left.toFixed(1));
      name.setAttribute("y", (top + STAKE_ROW_PX * 0.75).toFixed(1));
      name.textContent = text;
    });
  }

  return { element, lay };
}

function placedNames(stakes, x, box, font) {
  const taken = [];
  return stakes.flatMap((stake) => {
    const at = x(stake.x);
    if (at === null) return [];
    const outside = at < box.left - 1 ? "← " : at > box.right + 1 ? " →" : "";
    const text = outside === "← " ? outside + stake.label : stake.label + outside;
    const width = textWidth(text, font);
    const left = Math.min(Math.max(at - width / 2, 0), box.right + 12 - width);
    const rows = Array.from({ length: STAKE_ROWS }, (_, row) => box.top - (row + 1) * STAKE_ROW_PX - 2);
    const boxes = rows.map((top) => ({ left: left - 4, right: left + width + 4, top, bottom: top + STAKE_ROW_PX }));
    const clear = boxes.find((one) => !taken.some((other) => doOverlap(one, other)));
    if (clear === undefined) return [];
    taken.push(clear);
    return [{ ...stake, at, left, top: clear.top, text, outside: outside !== "" }];
  });
}

// Reading a plot: by pointer, by touch and by keys, what all lines say at one x.

import { html, svg } from "./svg.js";
import { reusedChildren } from "./frame.js";
import { valueAt } from "./paths.js";

const TIP_AWAY_PX = 14;

/** The point {line, x} of these lines that is nearest to a pixel: one of a line's own, or of a step line any x that it
 *  holds for, a whole one where all of its own are. Null where nothing is drawn. */
export function nearestPoint(lines, x, y, across, down) {
  let best = null;
  const offer = (line, at, value) => {
    const [px, py] = [x(at), y(value)];
    if (px === null || py === null) return;
    const distance = Math.hypot(px - across, py - down);
    if (best === null || distance < best.distance) best = { line, x: at, distance };
  };
  for (const line of lines) {
    line.x.forEach((at, index) => offer(line, at, line.y[index]));
    if (!line.step) continue;
    const there = Math.min(Math.max(x.invert(across), x.domain[0]), x.domain[1]);
    const at = line.whole ? Math.round(there) : Number(there.toPrecision(4));
    if (at <= x.domain[1]) offer(line, at, valueAt(line.x, line.y, at, true));
  }
  return best === null ? null : { line: best.line, x: best.x };
}

/** What is laid over the area of a plot: an input of type range, which keys move along a line, a cross line with dots,
 *  a tip, and a text that is read aloud when keys were used.
 *
 *  `onPoint(across, down)` and `onLeave()`: of a pointer, in pixels of the area; `onWalk(index)`; and where there is
 *  something to pick, or several lines, `onClick(across, down)`, `onEnter()`, and `onTurn(by)` to the next line or the
 *  one before.
 *  `hold({label, count, index, text})` is what the input says; `tell({x, box, heading, rows, dots, aloud})` shows the
 *  values, a row being {sign, name, text}, a dot {y, look}; `quiet()` hides them. */
export function plotReader(area, { onPoint, onLeave, onClick, onWalk, onTurn, onEnter }) {
  const cross = svg("path", { class: "ss-plot-cross" });
  const dots = svg("g");
  const element = svg("g", { class: "ss-plot-reading" }, cross, dots);
  const walk = html("input", { type: "range", class: "ss-plot-walk", min: 0, step: 1 });
  const tip = html("div", { class: "ss-plot-tip", "aria-hidden": "true", hidden: true });
  const said = html("p", { class: "ss-plot-said", "aria-live": "polite" });
  area.append(walk, tip, said);

  const turns = onTurn === undefined ? {} : { ArrowUp: () => onTurn(-1), ArrowDown: () => onTurn(1) };
  const keys = { ...turns, Enter: onEnter, Escape: onLeave };
  const isWalked = () => walk.matches(":focus");
  const at = (event) => {
    const { left, top } = area.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  area.addEventListener("pointermove", (event) => onPoint(...at(event)));
  area.addEventListener("pointerdown", (event) => onPoint(...at(event)));
  area.addEventListener("pointerleave", (event) => event.pointerType !== "touch" && onLeave());
  area.addEventListener("click", (event) => onClick?.(...at(event)));
  const isElsewhere = (event) => !event.composedPath().includes(area);
  const elsewhere = (event) => isElsewhere(event) && !tip.hidden && !isWalked() && onLeave();
  document.addEventListener("pointerdown", elsewhere);
  walk.addEventListener("input", () => onWalk(Number(walk.value)));
  walk.addEventListener("focus", () => onWalk(Number(walk.value)));
  walk.addEventListener("blur", onLeave);
  walk.addEventListener("keydown", (event) => {
    const does = keys[event.key];
    if (does === undefined || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    does();
  });

  function hold({ label, count, index, text }) {
    walk.max = Math.max(count - 1, 0);
    walk.value = index;
    walk.setAttribute("aria-label", label);
    walk.setAttribute("aria-valuetext", text);
  }

  function tell({ x, box, heading, rows, dots: points, aloud }) {
    cross.setAttribute("d", `M${x.toFixed(1)} ${box.top}V${box.bottom}`);
    reusedChildren(dots, points.length, () => svg("circle", { class: "ss-plot-dot", r: 4.5 })).forEach((dot, index) => {
      dot.setAttribute("cx", x.toFixed(1));
      dot.setAttribute("cy", points[index].y.toFixed(1));
      dot.setAttribute("fill", points[index].look.colour);
    });
    element.removeAttribute("visibility");
    tip.replaceChildren(html("strong", {}, heading), ...rows.map(row));
    tip.hidden = false;
    const [width, wide] = [tip.offsetWidth, area.clientWidth];
    const right = x + TIP_AWAY_PX + width <= wide;
    const left = right ? x + TIP_AWAY_PX : Math.max(0, x - TIP_AWAY_PX - width);
    tip.style.left = `${Math.min(left, Math.max(0, wide - width))}px`;
    if (aloud !== null) said.textContent = aloud;
  }

  function row({ sign, name, text }) {
    const value = html("span", { class: "ss-plot-value" }, text);
    return html("div", { class: "ss-plot-row" }, sign, html("span", {}, name), value);
  }

  function quiet() {
    element.setAttribute("visibility", "hidden");
    tip.hidden = true;
  }

  quiet();
  const destroy = () => document.removeEventListener("pointerdown", elsewhere);
  return { element, hold, tell, quiet, isWalked, destroy };
}

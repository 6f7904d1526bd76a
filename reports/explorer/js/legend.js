// The legend of a Gantt chart: what its fills, signs and marks mean.

import { html } from "./svg.js";
import { arrowRow, drawMissed } from "./arrows.js";
import { hatchPattern } from "./colours.js";
import { grouped, inMs } from "./facts.js";
import { isTask } from "./tasks.js";

const SWATCH = { width: 28, height: 14 };
const SIGN = { width: 10, height: 16 };

/** Entries for what is in the schedule; `every`: of how many jobs of a crowded row one has its arrows. */
export function ganttLegend({ line, colours }, every) {
  const some = every > 1 ? ` (1 in ${grouped(every)} where crowded)` : "";
  const worked = new Set(line.rows.flatMap((row) => [...new Set(row.style)]));
  const styles = line.styles.flatMap((style, index) => (worked.has(index) ? [[style, colours.fills[index]]] : []));
  styles.sort(([one], [other]) => legendPlace(one) - legendPlace(other));
  const waiting = line.rows.some(({ waits }) => waits.start.length);
  const missing = line.schedule.jobs.missed.some(Boolean);
  const late = line.rows.some((row) => row.late.some((from) => from < Infinity));
  const any = line.schedule.jobs.row.length > 0;
  return [
    ...styles.map(([style, fill]) => drawn(workWords(style), SWATCH, (pen, box) => drawFill(pen, box, fill))),
    waiting && drawn("released, not running", SWATCH, (pen, box) => {
      pen.fillStyle = colours.grey;
      pen.fillRect(0, box.height / 2 - 1.75, box.width, 3.5);
    }),
    any && drawn(`release${some}`, SIGN, (pen) => arrowRow(pen, [5], 14, 3, colours.ink)),
    any && drawn(`deadline${some}`, SIGN, (pen) => arrowRow(pen, [5], 3, 14, colours.ink)),
    missing && drawn("missed deadline", SIGN, (pen) => drawMissed({ context: pen, colours }, [5], { head: 16 })),
    late && drawn("work after its deadline", SWATCH, (pen, box) => {
      pen.fillStyle = hatchPattern(pen, "x", colours.red);
      pen.fillRect(0, 0, box.width, box.height);
    }),
    ...markEntries(line),
  ].filter(Boolean);
}

/** Puts the entries into a list, unless it has them; those of the same text and colours are the same. */
export function showLegend(list, entries, look) {
  const key = `${look}\n${entries.map(({ text, symbol }) => `${symbol ?? ""} ${text}`).join("\n")}`;
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  const sign = ({ symbol, picture }) => (symbol ? html("i", {}, symbol) : picture());
  const items = entries.map((entry) => html("li", {}, sign(entry), entry.text));
  list.replaceChildren(...items);
}

/** One for each symbol, with what it means in any cycle, and when it is where it is but once. */
function markEntries(line) {
  const of = new Map();
  for (const { step, label, meaning } of line.marks.filter((mark) => mark.meaning)) {
    const symbols = label.split(" = ");
    const meanings = symbols.length > 1 ? meaning.split(", ") : [meaning];
    meanings.forEach((each, index) => {
      const symbol = symbols[index].split("+")[0];
      of.set(symbol, { text: each.replace(/ \d+/, ""), steps: [...(of.get(symbol)?.steps ?? []), step] });
    });
  }
  const when = (step) => (line.periodMs === null ? "" : ` (${inMs(line, step)} ms)`);
  const once = ([step, ...others]) => (others.length ? "" : `, step ${grouped(step)}${when(step)}`);
  return [...of].map(([symbol, { text, steps }]) => ({ symbol, text: text + once(steps) }));
}

/** The filter's work, then tasks, then context switches. */
function legendPlace({ label }) {
  return label === "switch" ? 2 : isTask(label) ? 1 : 0;
}

function workWords(style) {
  return legendPlace(style) ? style.meaning : `${style.label}  ${style.meaning}`;
}

function drawn(text, box, draw) {
  const picture = () => {
    const ratio = Math.max(2, devicePixelRatio);
    const canvas = html("canvas", { width: box.width * ratio, height: box.height * ratio, "aria-hidden": "true" });
    canvas.style.width = `${box.width}px`;
    canvas.style.height = `${box.height}px`;
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    draw(pen, box);
    return canvas;
  };
  return { text, picture };
}

function drawFill(pen, { width, height }, { fill, ink, hatch, edge }) {
  pen.fillStyle = fill;
  pen.fillRect(0, 0, width, height);
  if (hatch) {
    pen.fillStyle = hatchPattern(pen, hatch, ink);
    pen.fillRect(0, 0, width, height);
  }
  if (!edge) return;
  pen.strokeStyle = edge;
  pen.strokeRect(0.5, 0.5, width - 1, height - 1);
}

// A plot of lines by method: shown, hidden, read and picked from.

import { digits, svg } from "./svg.js";
import { drawCurves } from "./curves.js";
import { acrossDomain, downDomain } from "./domains.js";
import { plotFrame } from "./frame.js";
import { looksOf } from "./looks.js";
import { ascending, heldUntil, indexAt, pointsAlong, valueAt } from "./paths.js";
import { nearestPoint, plotReader } from "./reading.js";
import { lineSample, plotLegend } from "./samples.js";
import { axisText, plotSheet, quantity, saidOf } from "./sheet.js";
import { plotSigns } from "./signs.js";
import { valuesOf, valuesTable } from "./values.js";

/** A plot in `host`. `show({title, x: {label, log, text}, y: {label, log, text}, lines, points, limit})` draws it and may
 *  be called as often as there is a new picture. `text(value)` (may be left out) writes a value of the axis. lines:
 *  [{name, x, y, step, current, notes}], x in order, null where there is no value; a step line holds each value until the next x, and the last one to the end; notes (may be left out) are texts
 *  for its points. points: [{x, y, label, current}] are designs; limit: {y, label} or null, what lies above it is
 *  shaded. `onPick(x, line)`, where it is given, is called with a point that is clicked, or that Enter is pressed on.
 *  `destroy()` takes the plot away. */
export function plot(host, { onPick = null } = {}) {
  const hidden = new Set();
  const [axes, marks, curves] = [plotFrame(), plotSigns(), svg("g")];
  const values = valuesTable();
  const entries = plotLegend((name) => {
    hidden[hidden.has(name) ? "delete" : "add"](name);
    redraw();
  });
  const sheet = plotSheet(host, { legend: entries.element, below: values.element, draw });
  const pointed = (across, down) => laid && nearestPoint(seen(), laid.x, laid.y, across, down);
  const read = plotReader(sheet.area, {
    onPoint: (across, down) => point(pointed(across, down), false),
    onLeave: () => point(null, false),
    onClick: (across, down) => pick(pointed(across, down)),
    onWalk: (index) => walked() && point({ line: walked(), x: walked().x[index] }, true),
    onTurn: turn,
    onEnter: () => pick(reading),
  });
  sheet.picture.append(axes.element, marks.under, curves, marks.over, read.element);
  sheet.area.classList.toggle("ss-plot-picks", onPick !== null);
  let [given, lines, laid, reading] = [null, [], null, null];

  function show(next) {
    given = next;
    const looks = looksOf(next.lines.map((line) => line.name));
    const whole = (line) => line.x.every(Number.isInteger);
    lines = next.lines.map((line, index) => ({ ...ascending(line), look: looks[index], whole: whole(line) }));
    sheet.name({ title: next.title, x: next.x.label, y: next.y.label, spoken: spokenPlot(next) });
    values.show(() => valuesOf(next));
    redraw();
  }

  function redraw() {
    entries.show(lines.map(({ name, look, current }) => ({ name, look, current, shown: !hidden.has(name) })));
    sheet.redraw();
  }

  function seen() {
    return lines.filter((line) => !hidden.has(line.name) && line.x.length > 0);
  }

  function walked() {
    const shown = seen();
    const last = shown.find((line) => line.name === reading?.line.name);
    return last ?? shown.find((line) => line.current) ?? shown[0] ?? null;
  }

  function draw(size) {
    if (given === null) return;
    const shown = seen();
    laid = axes.lay({ ...size, x: acrossDomain(given, shown), y: downDomain(given, shown) });
    const held = shown.map((line) => heldUntil(line, laid.x.domain[1]));
    drawCurves(curves, held, laid);
    const along = held.flatMap((line) => pointsAlong(line, laid));
    marks.lay({ ...laid, points: given.points, limit: given.limit, lines: along, font: size.font });
    hold();
    const line = shown.find((one) => one.name === reading?.line.name);
    point(line === undefined ? null : { line, x: reading.x }, false);
  }

  function point(found, aloud) {
    reading = found;
    if (found === null || laid.x(found.x) === null) return read.quiet();
    if (aloud) hold();
    const told = toldAt(found.x);
    const rows = told.map(({ look, name, text }) => ({ sign: lineSample(look), name, text }));
    const dots = told.map(({ value, look }) => ({ y: laid.y(value), look })).filter((dot) => dot.y !== null);
    const heard = aloud ? spokenValues(given.y.label, told, found.line.name) : null;
    read.tell({ x: laid.x(found.x), box: laid.box, heading: saidOf(given.x, placeText(found)), rows, dots, aloud: heard });
  }

  function toldAt(x) {
    const all = seen().map((line) => ({ ...line, value: valueAt(line.x, line.y, x, line.step) }));
    const known = all.filter((line) => line.value !== null).sort((one, other) => other.value - one.value);
    return known.map((line) => ({ ...line, text: `${axisText(given.y, line.value)}${noteAt(line, x)}` }));
  }

  /** A point of a line as the table has it; between them, where the pointer is. */
  function placeText({ line, x }) {
    return line.x.includes(x) ? axisText(given.x, x) : digits(x);
  }

  function hold() {
    const line = walked();
    if (line === null) return;
    const start = reading?.x ?? given.points.find((each) => each.current)?.x ?? line.x[0];
    const index = Math.max(0, indexAt(line.x, start));
    const keys = `arrow keys walk along ${line.name}, up and down change the line`;
    const label = `${given.title}: ${keys}${onPick === null ? "" : ", Enter picks"}`;
    read.hold({ label, count: line.x.length, index, text: saidOf(given.x, axisText(given.x, line.x[index])) });
  }

  function turn(by) {
    const shown = seen();
    if (shown.length === 0) return;
    const line = shown[(shown.indexOf(walked()) + by + shown.length) % shown.length];
    const start = reading?.x ?? line.x[0];
    point({ line, x: line.x[Math.max(0, indexAt(line.x, start))] }, true);
  }

  function pick(found) {
    if (found !== null && onPick !== null) onPick(found.x, given.lines.find((line) => line.name === found.line.name));
  }

  function destroy() {
    read.destroy();
    sheet.destroy();
  }

  return { show, destroy };
}

function noteAt(line, at) {
  const text = line.notes?.[indexAt(line.x, at)];
  return text ? ` (${text})` : "";
}

function spokenValues(label, told, first) {
  const ordered = [...told].sort((one, other) => Number(other.name === first) - Number(one.name === first));
  return `${quantity(label).name}: ${ordered.map(({ name, text }) => `${name} ${text}`).join(", ") || "no values"}`;
}

function spokenPlot({ title, x, y, points, limit }) {
  const at = (each) => `${saidOf(x, axisText(x, each.x))}, ${saidOf(y, axisText(y, each.y))}`;
  const designs = points.map((each) => `${each.label || "this design"}: ${at(each)}`);
  return [`${title}. ${y.label} against ${x.label}`, ...designs, ...(limit === null ? [] : [limit.label])].join("; ");
}

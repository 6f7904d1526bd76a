// The four curves: what it would take to land earlier or later, on a slower or a faster processor.

import { accuracyText, powerText } from "./amounts.js";

/** What a plot shows of a view and the pinned designs {letter, view}; null where there is nothing to show. A line has
 *  the query of its method; `landing(x, line)` is the step L of what is picked, where picking is of use. */
export const TRADEOFFS = [
  {
    landing: (x) => x,
    of: (view, pins) => ({
      title: "Land later, and a slower processor will do",
      x: { label: "L, step by which the correction has landed", log: false },
      y: powerAxis("least speed", view),
      lines: linesOf(view, true, ({ staircase: { L, power } }) => ({ x: L, y: power })),
      points: pointsOf(view, pins, ({ design, current }) => ({ x: design.L, y: current.power })),
      limit: null,
    }),
  },
  {
    landing: null,
    of: (view, pins) => ({
      title: "Where it lands on a faster processor",
      x: powerAxis("speed", view),
      y: { label: "l, step in which it lands", log: false },
      lines: linesOf(view, true, ({ landing: { power, L } }) => ({ x: power, y: L })),
      points: pointsOf(view, pins, ({ current }) => ({ x: current.pace, y: current.achieved_l })),
      limit: null,
    }),
  },
  {
    landing: (x) => x,
    of: (view, pins) => (view.design.model === null ? null : {
      title: "What landing later costs in accuracy",
      x: { label: "step in which the correction lands", log: false },
      y: accuracyAxis(view),
      lines: linesOf(view, false, ({ accuracy }) => accuracy && { x: accuracy.L, y: accuracy.std }),
      points: pointsOf(view, pins, ({ current }) => ({ x: current.achieved_l, y: current.std })),
      limit: limitOf(view),
    }),
  },
  {
    landing: (x, { x: xs, L }) => L[Math.max(0, xs.findLastIndex((power) => power <= x))],
    of: (view, pins) => (view.design.model === null ? null : {
      title: "What a faster processor buys in accuracy",
      x: powerAxis("speed", view),
      y: accuracyAxis(view),
      lines: linesOf(view, true, ({ front }) => front && frontLine(front)),
      points: pointsOf(view, pins, ({ current }) => ({ x: current.pace, y: current.std })),
      limit: limitOf(view),
    }),
  },
];

/* Nothing is late to the standard filter: at L = 0 it would take half of the width. */
function linesOf(view, step, of) {
  return view.methods.flatMap((row) => {
    const current = row.method === view.design.method;
    const line = row.reason || (row.method === "standard" && !current) ? null : of(row);
    return line === null || line.x.length === 0 ? [] : [{ name: row.method, query: row.query, step, current, ...line }];
  });
}

/* By power; of landings that need the same, the most accurate. */
function frontLine({ L, power, std }) {
  const by = [...power.keys()].sort((one, other) => power[one] - power[other] || std[one] - std[other]);
  const kept = by.filter((at, index) => index === 0 || power[at] > power[by[index - 1]]);
  const [x, y, landings] = [power, std, L].map((column) => kept.map((at) => column[at]));
  return { x, y, L: landings, notes: landings.map((landing) => `L ${landing}`) };
}

function pointsOf(view, pins, of) {
  const pinned = pins.map((pin) => ({ ...of(pin.view), label: pin.letter, current: false }));
  const points = [...pinned, { ...of(view), label: "this design", current: true }];
  return points.filter(({ x, y }) => x !== null && y !== null);
}

function powerAxis(name, { power }) {
  return { label: `${name} (${power.unit})`, log: true, text: (speed) => powerText(speed, power) };
}

function accuracyAxis({ current }) {
  return { label: `standard deviation (${current.unit || "1"})`, log: false, text: accuracyText };
}

function limitOf({ design, current }) {
  return design.within === null ? null : { y: Number(design.within), label: `${design.within} ${current.unit}` };
}

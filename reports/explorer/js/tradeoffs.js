// The four curves: what it would take to land earlier or later, on a slower or a faster processor.

/** What a plot shows of a view and the pinned designs {letter, view}; null where there is nothing to show. A line has
 *  the query of its method, and the step L of each point. */
export const TRADEOFFS = [
  {
    picks: true,
    of: (view, pins) => ({
      title: "Land later, and a slower processor will do",
      x: { label: "L, step by which the correction has landed", log: false },
      y: powerAxis("least speed", view),
      lines: linesOf(view, true, ({ staircase: { L, power } }) => ({ x: L, y: power, L })),
      points: pointsOf(view, pins, ({ design, current }) => ({ x: design.L, y: current.power })),
      limit: null,
    }),
  },
  {
    picks: false,
    of: (view, pins) => ({
      title: "Where it lands on a faster processor",
      x: powerAxis("speed", view),
      y: { label: "l, step in which it lands", log: false },
      lines: linesOf(view, true, ({ landing: { power, L } }) => ({ x: power, y: L, L })),
      points: pointsOf(view, pins, ({ current }) => ({ x: current.pace, y: current.achieved_l })),
      limit: null,
    }),
  },
  {
    picks: true,
    of: (view, pins) => (view.design.model === null ? null : {
      title: "What landing later costs in accuracy",
      x: { label: "step in which the correction lands", log: false },
      y: accuracyAxis(view),
      lines: linesOf(view, false, ({ accuracy }) => accuracy && { x: accuracy.L, y: accuracy.std, L: accuracy.L }),
      points: pointsOf(view, pins, ({ current }) => ({ x: current.achieved_l, y: current.std })),
      limit: limitOf(view),
    }),
  },
  {
    picks: true,
    of: (view, pins) => (view.design.model === null ? null : {
      title: "What a faster processor buys in accuracy",
      x: powerAxis("least speed", view),
      y: accuracyAxis(view),
      lines: linesOf(view, true, ({ front }) => front && {
        x: front.power, y: front.std, L: front.L, notes: front.L.map((L) => `L ${L}`),
      }),
      points: pointsOf(view, pins, ({ current }) => ({ x: current.power, y: current.std_at_L })),
      limit: limitOf(view),
    }),
  },
];

function linesOf(view, step, of) {
  return view.methods.flatMap((row) => {
    const line = row.reason ? null : of(row);
    if (line === null || line.x.length === 0) return [];
    return [{ name: row.method, query: row.query, step, current: row.method === view.design.method, ...line }];
  });
}

function pointsOf(view, pins, of) {
  const pinned = pins.map((pin) => ({ ...of(pin.view), label: pin.letter, current: false }));
  const points = [...pinned, { ...of(view), label: "this design", current: true }];
  return points.filter(({ x, y }) => x !== null && y !== null);
}

function powerAxis(name, { power }) {
  return { label: `${name} (${power.unit})`, log: true };
}

function accuracyAxis({ current }) {
  return { label: `standard deviation (${current.unit || "1"})`, log: false };
}

function limitOf({ design, current }) {
  return design.within === null ? null : { y: Number(design.within), label: `${design.within} ${current.unit}` };
}

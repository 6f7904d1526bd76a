// What a job under the pointer or in focus says of itself, beside its work, and a ring around that.

import { html } from "./svg.js";
import { inMs, inSteps, jobFacts, times } from "./facts.js";
import { BAR_PX } from "./lanes.js";

const GAP_PX = 10;
const RING_PX = 3;

/** {show(line, job, place), hide()}: in `frame`, which is positioned. `place`: {x, toX, lane, width}, in pixels. */
export function jobTip(frame) {
  const ring = html("div", { class: "ss-gantt-ring", hidden: true });
  const tip = html("div", { class: "ss-gantt-tip", "aria-hidden": "true", hidden: true });
  frame.append(ring, tip);
  let shown = null;
  return {
    show(line, job, { x, toX, lane, width }) {
      if (shown?.line !== line || shown.job !== job) {
        tip.replaceChildren(...tipParts(line, jobFacts(line, job)));
        shown = { line, job };
      }
      ring.hidden = tip.hidden = false;
      ring.style.transform = `translate(${x - RING_PX}px, ${lane.head - RING_PX}px)`;
      ring.style.width = `${toX - x + 2 * RING_PX}px`;
      ring.style.height = `${BAR_PX + 2 * RING_PX}px`;
      const left = Math.min(Math.max((x + toX) / 2 - tip.offsetWidth / 2, 0), Math.max(width - tip.offsetWidth, 0));
      tip.style.transform = `translate(${left}px, ${tipTop(frame, tip, lane)}px)`;
    },
    hide() {
      ring.hidden = tip.hidden = true;
    },
  };
}

/** Below the row; above it, where only there the window has room. */
function tipTop(frame, tip, lane) {
  const { top } = frame.getBoundingClientRect();
  const [below, above] = [lane.foot + GAP_PX, lane.head - GAP_PX - tip.offsetHeight];
  return top + below + tip.offsetHeight > innerHeight && top + above > 0 ? above : below;
}

function tipParts(line, facts) {
  const known = facts.work.every((work) => facts.kind.endsWith(work));
  const work = known ? null : html("p", { class: "ss-gantt-work" }, facts.work.join(", "));
  const head = html("p", { class: "ss-gantt-job" }, `${facts.kind} of step ${facts.step}`);
  const sign = facts.missed ? "✗ " : "";
  const verdict = html("p", { class: facts.missed && "ss-gantt-missed" }, sign + facts.verdict);
  return [head, work, verdict, timesTable(line, facts)].filter(Boolean);
}

function timesTable(line, facts) {
  const ms = line.periodMs !== null;
  const instants = ["release", "start", "finish", "deadline"].map((name) => [name, facts[name]]);
  const rows = [...instants, ["response time", facts.response]].map(([name, steps]) =>
    html("tr", {}, html("th", {}, name), html("td", {}, inSteps(steps)), ms ? html("td", {}, inMs(line, steps)) : null),
  );
  const head = html("tr", {}, html("td"), html("th", {}, "steps"), ms ? html("th", {}, "ms") : null);
  const often = html("td", { colspan: ms ? 2 : 1 }, facts.preemptions ? times(facts.preemptions) : "never");
  return html("table", {}, head, ...rows, html("tr", {}, html("th", {}, "preempted"), often));
}

// The jobs of a schedule as a table: what the chart says of each, for everyone. Of many, some at a time.

import { html } from "./svg.js";
import { grouped, inMs, inSteps, jobFacts, missesSentence, times } from "./facts.js";
import { table } from "./table.js";
import { timeline } from "./timeline.js";

const PAGE = 100;
const TIMES = {
  release: "release",
  start: "start",
  finish: "finish",
  response: "response time",
  deadline: "deadline",
  spare: "to spare",
};

const opened = new WeakMap();

/** A table of a schedule's jobs in `host`; shown again there, it keeps its place. */
export function jobsTable(host, schedule) {
  if (!opened.has(host)) opened.set(host, new Jobs(host));
  opened.get(host).show(schedule);
}

class Jobs {
  page = 0;

  constructor(host) {
    const turn = (text, label, by) => {
      const button = html("button", { type: "button", "aria-label": label, title: label }, text);
      button.addEventListener("click", () => this.turn(by));
      return button;
    };
    this.back = [turn("«", "first jobs", -Infinity), turn("‹", "jobs before", -1)];
    this.on = [turn("›", "further jobs", 1), turn("»", "last jobs", Infinity)];
    this.range = html("span", { role: "status" });
    this.turning = html("span", { class: "ss-jobs-turning" }, ...this.back, this.range, ...this.on);
    this.missed = html("input", { type: "checkbox" });
    this.missed.addEventListener("change", () => this.draw());
    this.choice = html("label", {}, this.missed, " only missed deadlines");
    this.finding = html("p");
    this.rows = html("div");
    const tools = html("div", { class: "ss-jobs-tools" }, this.turning, this.choice);
    host.replaceChildren(html("div", { class: "ss-jobs" }, this.finding, tools, this.rows));
  }

  show(schedule) {
    this.line = timeline(schedule);
    this.finding.textContent = missesSentence(schedule);
    this.choice.hidden = !this.line.misses.length;
    if (this.choice.hidden) this.missed.checked = false;
    this.draw();
  }

  turn(by) {
    this.page += by;
    this.draw();
  }

  draw() {
    const { line, missed } = this;
    const jobs = missed.checked ? line.misses : [...line.schedule.jobs.row.keys()];
    const last = Math.max(Math.ceil(jobs.length / PAGE) - 1, 0);
    this.page = Math.min(Math.max(this.page, 0), last);
    const from = this.page * PAGE;
    const shown = jobs.slice(from, from + PAGE);
    this.turning.hidden = last === 0;
    this.range.textContent = `jobs ${grouped(from + 1)} to ${grouped(from + shown.length)} of ${grouped(jobs.length)}`;
    for (const button of this.back) button.setAttribute("aria-disabled", this.page === 0);
    for (const button of this.on) button.setAttribute("aria-disabled", this.page === last);
    const caption = `Jobs, with times in ${line.periodMs === null ? "steps" : "steps (ms)"}`;
    table(this.rows, { caption, columns: jobColumns(line), rows: shown.map((job) => jobFacts(line, job)) });
  }
}

function jobColumns(line) {
  const instant = ([key, label]) => ({ key, label, numeric: true, text: (job) => instantText(line, job[key]) });
  return [
    { key: "job", label: "job", text: ({ kind, step }) => `${kind} of step ${grouped(step)}` },
    { key: "missed", label: "verdict", text: shortVerdict, holds: meetsDeadline },
    { key: "row", label: "row" },
    ...Object.entries(TIMES).map(instant),
    { key: "preemptions", label: "preempted", text: ({ preemptions }) => (preemptions ? times(preemptions) : "never") },
  ];
}

/** Whether the deadline is met; null: not known yet. */
function meetsDeadline({ missed, finish }) {
  return missed || finish !== null ? !missed : null;
}

function shortVerdict({ missed, start, finish }) {
  if (!missed) return finish === null ? "not yet due" : "met";
  if (finish !== null) return "missed";
  return start === null ? "missed, never runs" : "missed, never finishes";
}

function instantText(line, steps) {
  return steps === null || line.periodMs === null ? inSteps(steps) : `${inSteps(steps)} (${inMs(line, steps)})`;
}

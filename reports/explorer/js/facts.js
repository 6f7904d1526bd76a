// What is said of one job and of a whole schedule, in words: for the tip, the table, and who cannot see the chart.

import { tickText } from "./scales.js";
import { digits } from "./svg.js";
import { isTask, taskName } from "./tasks.js";

const KINDS = {
  hr: "high-rate job",
  hr_update: "high-rate update",
  lr_propagate: "low-rate propagate",
  lr_update: "low-rate update",
  lr_gain: "covariance and gain",
  lr_step: "robust step",
};
const PLACES = 4;
const LEAST_PERCENT = 0.001;

/** The kind of a job in words. */
export function kindWords(kind) {
  if (isTask(kind)) return `task ${taskName(kind)}`;
  return KINDS[kind] ?? kind.replaceAll("_", " ");
}

/** A job's {kind, row, step, work, release, start, finish, response, deadline, spare, preemptions, missed, verdict}:
 *  times in steps, null where there is none; spare: from finish to deadline. */
export function jobFacts(line, job) {
  const { jobs, bars, styles, rows } = line.schedule;
  const [release, start, finish, deadline] = ["release", "start", "finish", "deadline"].map((name) => jobs[name][job]);
  const labels = new Set(line.pieces[job].map((piece) => bars.style[piece]));
  const row = rows[jobs.row[job]];
  return {
    kind: kindWords(jobs.kind[job]),
    row: line.rows[jobs.row[job]].cpu ? `${row.name}, CPU ${row.cpu + 1}` : row.name,
    step: jobs.step[job],
    work: [...labels].map((style) => styles[style].meaning).filter((work) => work !== "context switch"),
    release,
    start,
    finish,
    response: finish === null ? null : finish - release,
    deadline,
    spare: finish === null ? null : deadline - finish,
    preemptions: jobs.preemptions[job],
    missed: jobs.missed[job],
    verdict: verdictOf(line, { missed: jobs.missed[job], start, finish, deadline }),
  };
}

/** By how much a job met its deadline or missed it. */
function verdictOf(line, { missed, start, finish, deadline }) {
  if (!missed && finish === null) return "is not finished, and not yet due";
  if (finish === deadline) return missed ? "misses its deadline, by less than is shown" : "meets its deadline, with nothing to spare";
  if (!missed) return `meets its deadline, ${bothUnits(line, deadline - finish)} to spare`;
  if (finish !== null) return `misses its deadline by ${bothUnits(line, finish - deadline)}`;
  return start === null ? "misses its deadline: it never gets the processor" : "misses its deadline: it never finishes";
}

/** "2.5 steps (6.25 ms)". */
function bothUnits(line, steps) {
  if (steps === null) return "never";
  const ms = line.periodMs === null ? "" : ` (${inMs(line, steps)} ms)`;
  return `${inSteps(steps)} ${Math.abs(steps - 1) < 1e-9 ? "step" : "steps"}${ms}`;
}

export function inSteps(steps, places = PLACES) {
  return steps === null ? "never" : rounded(steps, places);
}

export function inMs(line, steps) {
  return inSteps(steps === null ? null : steps * line.periodMs);
}

/** To so many places, or three digits, with commas. */
function rounded(value, places) {
  const before = Math.ceil(Math.log10(Math.abs(value) || 1));
  return tickText(Number(value.toPrecision(Math.min(Math.max(3, before + places), 15))));
}

/** A job in one sentence, to be read out. */
export function jobSentence(line, job) {
  const facts = jobFacts(line, job);
  const said = (words, name) => (facts[name] === null ? [] : [`${words} ${bothUnits(line, facts[name])}`]);
  const course = [
    ...said("released at", "release"),
    ...said("starts at", "start"),
    ...said("finishes at", "finish"),
    ...said("response time", "response"),
    ...said("deadline", "deadline"),
    ...(facts.preemptions ? [`preempted ${times(facts.preemptions)}`] : []),
  ];
  return `${facts.kind} of step ${facts.step}, row ${facts.row}: ${facts.verdict}; ${course.join(", ")}`;
}

/** A whole number with commas. */
export function grouped(number) {
  return number.toLocaleString("en");
}

export function times(count) {
  return count === 1 ? "once" : count === 2 ? "twice" : `${grouped(count)} times`;
}

/** How busy the processor is: in whole percents, below ten of them in two digits, so that little is not nothing. */
export function busyShare({ busy }) {
  const percent = 100 * busy;
  const few = percent > 0 && percent < LEAST_PERCENT ? `under ${LEAST_PERCENT}` : digits(percent, 2);
  return `${percent < 9.95 ? few : Math.round(percent)}\u00a0%\u00a0busy`;
}

/** How many jobs miss their deadline. */
export function missesSentence({ jobs }) {
  const missed = jobs.missed.filter(Boolean).length;
  if (!jobs.missed.length) return "nothing runs";
  if (!missed) return "no deadline missed";
  const silent = jobs.missed.filter((miss, job) => miss && jobs.start[job] === null).length;
  const waiting = silent ? `, ${grouped(silent)} never got the processor` : "";
  const verb = missed === 1 ? "misses its" : "miss their";
  return `${grouped(missed)} of ${grouped(jobs.missed.length)} jobs ${verb} deadline${waiting}`;
}

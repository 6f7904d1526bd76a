// A schedule made ready for drawing: by row, in order of time, to be found by halving.

import { wholeStretch } from "./stretch.js";
import { isTask } from "./tasks.js";

/** {steps, whole, periodMs, styles, marks, rows, pieces, misses, schedule}; whole: the steps there are, from the
 *  schedule's `origin`, where it has one, to `steps`. Of each row: its bars and work, whether there are callouts above
 *  it, when a job waits, releases and deadlines; `pieces`: of each job, as indices of bars; `misses`: the jobs that
 *  miss, by deadline. */
export function timeline(schedule) {
  const { jobs, bars } = schedule;
  const barsOf = indicesBy(bars.row, schedule.rows.length, (one, other) => bars.start[one] - bars.start[other]);
  const jobsOf = indicesBy(jobs.row, schedule.rows.length, (one, other) => jobs.release[one] - jobs.release[other]);
  const pieces = piecesByJob(bars, jobs.row.length);
  const several = new Set(schedule.rows.map((row) => row.cpu).filter((cpu) => cpu !== null)).size > 1;
  const rows = schedule.rows.map((row, index) => ({
    name: row.name,
    cpu: several && row.cpu !== null ? `CPU ${row.cpu + 1}` : "",
    ...barColumns(bars, barsOf[index], jobs.deadline),
    jobs: jobsOf[index],
    released: Float64Array.from(jobsOf[index], (job) => jobs.release[job]),
    waits: united(jobsOf[index].flatMap((job) => waitsOf(schedule, job, pieces[job]))),
    arrows: arrowsOf(jobs, jobsOf[index]),
    works: worksOf(schedule, jobsOf[index], pieces),
    calls: jobsOf[index].length ? jobsOf[index].some((job) => !isTask(jobs.kind[job])) : row.name !== "idle",
  }));
  const missed = [...jobs.missed.keys()].filter((job) => jobs.missed[job]);
  const misses = missed.sort((one, other) => jobs.deadline[one] - jobs.deadline[other]);
  const { steps, period_ms: periodMs, styles, marks, origin = 0 } = schedule;
  return { steps, whole: wholeStretch(origin, steps), periodMs, styles, marks, rows, pieces, misses, schedule };
}

/** The first index in ascending `values` of one that is greater than `value`. */
export function after(values, value) {
  let low = 0;
  let high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] > value) high = middle;
    else low = middle + 1;
  }
  return low;
}

/** When a job was released and did not run: before its first piece, and between pieces; [[start, end]]. */
function waitsOf(schedule, job, pieces) {
  const { bars, jobs } = schedule;
  const waits = [];
  let at = jobs.release[job];
  for (const piece of pieces) {
    if (bars.start[piece] > at) waits.push([at, bars.start[piece]]);
    at = Math.max(at, bars.end[piece]);
  }
  const end = jobs.finish[job] ?? schedule.steps;
  if (end > at) waits.push([at, end]);
  return waits;
}

/** The bars of each job, in order of time. */
function piecesByJob(bars, count) {
  return indicesBy(bars.job, count, (one, other) => bars.start[one] - bars.start[other]);
}

/** Indices by the value of `column` at them, each group in order. */
function indicesBy(column, count, order) {
  const groups = Array.from({ length: count }, () => []);
  column.forEach((group, index) => {
    if (group !== null) groups[group]?.push(index);
  });
  for (const group of groups) group.sort(order);
  return groups;
}

/** Of a row's bars: start, end, style, job, and from when on it is late (Infinity: never). */
function barColumns(bars, indices, deadlines) {
  return {
    start: Float64Array.from(indices, (index) => bars.start[index]),
    end: Float64Array.from(indices, (index) => bars.end[index]),
    style: Uint8Array.from(indices, (index) => bars.style[index]),
    job: Int32Array.from(indices, (index) => bars.job[index]),
    late: Float64Array.from(indices, (index) => {
      const deadline = deadlines[bars.job[index]];
      return bars.end[index] > deadline ? Math.max(deadline, bars.start[index]) : Infinity;
    }),
  };
}

/** By style, the work of the row's jobs in it: {start, end, pieces: [[start, end]]}; null for what is not called out,
 *  which are context switches and a user's tasks, whose row is their label. */
function worksOf({ styles, bars }, indices, pieces) {
  const called = ({ label }) => label !== "switch" && !isTask(label);
  const works = styles.map((style) => (called(style) ? { start: [], end: [], pieces: [] } : null));
  for (const job of indices) {
    for (const piece of pieces[job]) {
      const work = works[bars.style[piece]];
      if (!work) continue;
      const span = [bars.start[piece], bars.end[piece]];
      if (work.job === job) {
        work.pieces[work.pieces.length - 1].push(span);
        work.end[work.end.length - 1] = span[1];
      } else {
        work.job = job;
        work.pieces.push([span]);
        work.start.push(span[0]);
        work.end.push(span[1]);
      }
    }
  }
  return works.map((work) => (work?.start.length ? work : null));
}

/** Intervals that overlap or touch made one; {start, end}. */
function united(intervals) {
  const start = [];
  const end = [];
  for (const [from, until] of intervals.sort((one, other) => one[0] - other[0])) {
    if (end.length && from <= end[end.length - 1]) end[end.length - 1] = Math.max(end[end.length - 1], until);
    else {
      start.push(from);
      end.push(until);
    }
  }
  return { start, end };
}

/** Instants of releases, of deadlines that are met, with the job's number in its kind, and of those that are not. */
function arrowsOf(jobs, indices) {
  const seen = new Map();
  const releases = new Map();
  const deadlines = new Map();
  const missed = new Set();
  for (const job of indices) {
    const number = seen.get(jobs.kind[job]) ?? 0;
    seen.set(jobs.kind[job], number + 1);
    if (!releases.has(jobs.release[job])) releases.set(jobs.release[job], number);
    if (jobs.missed[job]) missed.add(jobs.deadline[job]);
    else if (!deadlines.has(jobs.deadline[job])) deadlines.set(jobs.deadline[job], number);
  }
  return {
    release: instants(releases),
    deadline: instants(deadlines),
    missed: Float64Array.from(missed).sort(),
  };
}

function instants(numbers) {
  const sorted = [...numbers].sort((one, other) => one[0] - other[0]);
  return { at: Float64Array.from(sorted, (entry) => entry[0]), number: Int32Array.from(sorted, (entry) => entry[1]) };
}

// Finding jobs: under a point, and from one to the next.

import { after } from "./timeline.js";
import { shownOf } from "./bars.js";
import { laneAt } from "./lanes.js";

const REACH_PX = 4;
const MOST_PENDING = 200;

/** The job whose work is at, or near, a point; else one that waits there; else null. */
export function jobAt(line, layout, scale, { x, y }) {
  const lane = laneAt(layout, y);
  if (!lane || x < layout.left - REACH_PX || x > layout.right + REACH_PX) return null;
  const at = scale.invert(x);
  const reach = scale.invert(x + REACH_PX) - at;
  const { row } = lane;
  let nearest = null;
  let farthest = Infinity;
  const [from, until] = shownOf(row, at - reach, at + reach);
  for (let bar = from; bar < until; bar += 1) {
    const far = Math.max(row.start[bar] - at, at - row.end[bar], 0) - (row.late[bar] < Infinity ? reach : 0);
    if (far < farthest) [nearest, farthest] = [row.job[bar], far];
  }
  return nearest ?? pendingAt(line, row, at);
}

function pendingAt(line, row, at) {
  const { jobs } = line.schedule;
  const last = after(row.released, at) - 1;
  for (let number = last; number >= Math.max(0, last - MOST_PENDING); number -= 1) {
    const job = row.jobs[number];
    if ((jobs.finish[job] ?? line.steps) >= at) return job;
  }
  return null;
}

/** From when until when a job is drawn: [start, end] in steps. */
export function spanOf(line, job) {
  const { jobs, bars } = line.schedule;
  const pieces = line.pieces[job];
  const start = pieces.length ? Math.min(jobs.release[job], bars.start[pieces[0]]) : jobs.release[job];
  return [start, Math.max(jobs.finish[job] ?? line.steps, start)];
}

/** The job so many places further in its row, within its ends; from none, the first that is in `stretch`. */
export function jobBeside(line, job, by, stretch) {
  if (job === null) return firstShown(line, stretch);
  const { jobs } = rowOf(line, job);
  return jobs[Math.min(Math.max(jobs.indexOf(job) + by, 0), jobs.length - 1)];
}

/** The job of the next row above (by = -1) or below that has any, released nearest to this one. */
export function jobInNextRow(line, job, by, stretch) {
  if (job === null) return firstShown(line, stretch);
  const release = line.schedule.jobs.release[job];
  let index = line.schedule.jobs.row[job] + by;
  while (line.rows[index] && !line.rows[index].jobs.length) index += by;
  const row = line.rows[index];
  if (!row) return job;
  const next = after(row.released, release);
  const nearer = next > 0 && !(row.released[next] - release < release - row.released[next - 1]) ? next - 1 : next;
  return row.jobs[nearer];
}

/** The first or the last job of the row. */
export function jobAtEnd(line, job, last, stretch) {
  const { jobs } = rowOf(line, job ?? firstShown(line, stretch));
  return jobs[last ? jobs.length - 1 : 0];
}

/** The next job, by deadline, that misses it, after this one; from the last, the first again; null if none does. */
export function nextMiss(line, job) {
  const { misses } = line;
  if (!misses.length) return null;
  return misses[(misses.indexOf(job) + 1) % misses.length];
}

/** The job that a new schedule has for one of another: of the same kind and step; null if none. */
export function sameJob(line, kind, step) {
  const { jobs } = line.schedule;
  const found = jobs.step.findIndex((other, job) => other === step && jobs.kind[job] === kind);
  return found < 0 ? null : found;
}

function firstShown(line, stretch) {
  const row = line.rows.find(({ jobs }) => jobs.length);
  if (!row) return null;
  return row.jobs[Math.min(after(row.released, stretch.first - 1e-9), row.jobs.length - 1)];
}

function rowOf(line, job) {
  return line.rows[line.schedule.jobs.row[job]];
}

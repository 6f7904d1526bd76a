// A scenario's distributions as histograms.

import { digits } from "./svg.js";

const MOST_BARS = 120;
const FEWEST_BARS = 7;
const SHARE_OF = { jobs: "share of the finished", landed: "share of the landed", steps: "share of the steps" };

/** The response times of one kind of job. */
export function jobHistogram({ unit }, job) {
  const exact = job.exact === null ? [] : [{ name: "takes longer, exactly", ...job.exact }];
  const due = job.deadline;
  return {
    title: `${job.kind}: response times`,
    x: { label: `response time (${unit})` },
    y: { label: SHARE_OF.jobs, log: true },
    edges: job.histogram.edges,
    bars: shares(job.histogram.counts),
    tails: [{ name: "took longer, in this run", ...job.longer }, ...exact],
    points: null,
    deadline: due === null ? null : { x: due, label: `deadline ${digits(due)} ${unit}` },
    marks: quantileMarks(job.response, unit),
    unresolved: { y: job.unresolved, label: `not resolved by ${job.finished.toLocaleString("en")} jobs` },
  };
}

/** In which steps a sensor's corrections landed. */
export function landingHistogram(sensor) {
  const { edges, counts, width } = landingBins(sensor);
  const exact = sensor.exact === null || width > 1 ? null : { name: "exactly", x: sensor.L, y: sensor.exact };
  return {
    title: `${sensor.name}: the step in which corrections land`,
    x: { label: "l − k, high-rate steps (steps)" },
    y: { label: SHARE_OF.landed, log: true },
    edges,
    bars: shares(counts),
    tails: [],
    points: exact,
    deadline: { x: sensor.land_by + 0.5, label: `land by k + ${sensor.land_by}` },
    marks: [],
    unresolved: null,
  };
}

/** Bins of whole steps, their edges halfway between them. */
function landingBins({ L, counts }) {
  const first = Math.min(...L);
  const last = Math.max(...L, first + FEWEST_BARS - 1);
  const width = Math.ceil((last - first + 1) / MOST_BARS);
  const bins = Math.ceil((last - first + 1) / width);
  const found = { width, edges: [], counts: Array.from({ length: bins }, () => 0) };
  for (let bin = 0; bin <= bins; bin += 1) found.edges.push(first - 0.5 + bin * width);
  L.forEach((step, index) => {
    found.counts[Math.floor((step - first) / width)] += counts[index];
  });
  return found;
}

/** The standard deviation of the output, over the steps. */
export function outputHistogram({ output, model }) {
  return spreadHistogram(output, `${output.name}: accuracy by the model ${model}`, `standard deviation${inUnit(output)}`);
}

/** How old a sensor's newest measurement in the output is, over the steps. */
export function ageHistogram(sensor, age) {
  return spreadHistogram(age, `${sensor}: age of its information in the output`, `age${inUnit(age)}`);
}

function spreadHistogram(spread, title, label) {
  const marks = [["median", "median"], ["p95", "95 % within"]].map(([key, words]) => ({ x: spread[key], label: `${words} ${digits(spread[key], 3)}` }));
  return {
    title,
    x: { label },
    y: { label: SHARE_OF.steps, log: false },
    edges: spread.histogram.edges,
    bars: shares(spread.histogram.counts),
    tails: [],
    points: null,
    deadline: null,
    marks,
    unresolved: null,
  };
}

function inUnit({ unit }) {
  return unit ? ` (${unit})` : "";
}

function shares(counts) {
  const total = counts.reduce((sum, count) => sum + count, 0);
  return counts.map((count) => count / Math.max(total, 1));
}

function quantileMarks(response, unit) {
  const known = [["median", "median"], ["p99", "99 % within"]].filter(([key]) => response?.[key] != null);
  return known.map(([key, words]) => ({ x: response[key], label: `${words} ${digits(response[key], 3)} ${unit}` }));
}

// What the tables of a scenario's jobs and sensors say.

import { digits } from "./svg.js";

const count = (value) => value.toLocaleString("en");
const share = (value) => (value === null ? "–" : `${digits(100 * value, 3)} %`);

/** Of each kind of job; a column with nothing in it is left out. */
export function runJobColumns(view) {
  const time = (name, label) => ({ label, numeric: true, text: ({ response }) => digits(response?.[name] ?? null) });
  const columns = [
    { label: "job", text: ({ kind }) => kind },
    { label: "missed", numeric: true, holds: missesNone, text: ({ misses, decided }) => `${count(misses)} of ${count(decided)}` },
    { label: "P(miss)", numeric: true, text: ({ probability }) => probability },
    { label: "95 % interval", numeric: true, text: ({ interval }) => interval },
    { label: "exactly", numeric: true, text: ({ exact_miss: exact }) => exact },
    { label: "deadline", numeric: true, text: ({ deadline }) => (deadline === null ? "" : digits(deadline)) },
    time("median", "median"),
    time("p99", "99 % within"),
    time("maximum", "longest"),
    time("p95", "95 % within"),
    { label: "released", numeric: true, text: ({ released }) => count(released) },
    { label: "finished", numeric: true, text: ({ finished, released }) => (finished === released ? "all" : count(finished)) },
  ];
  return columns.filter(({ text }) => view.jobs.some((job) => text(job) !== ""));
}

function missesNone({ misses, decided }) {
  return decided === 0 ? null : misses === 0;
}

/** Of each sensor; a column of nothing is left out. */
export function sensorColumns(view) {
  const L = (name, label) => ({ label, numeric: true, text: ({ quantiles }) => digits(quantiles?.[name] ?? null) });
  const some = (key, label) => ({ key, label, numeric: true, text: (sensor) => count(sensor[key]) });
  const columns = [
    { label: "sensor", text: ({ name }) => name },
    { label: "rate and delay", text: ({ times }) => times },
    { label: "landed", numeric: true, text: ({ landed, taken }) => `${count(landed)} of ${count(taken)}` },
    { label: "landed late", numeric: true, holds: ({ late }) => late === 0, text: ({ late }) => count(late) },
    { label: "land by", numeric: true, text: ({ land_by: step, land_by_ms: ms }) => (ms === null ? String(step) : `${step} (${digits(ms)} ms)`) },
    L("median", "median"),
    L("p95", "95 % within"),
    L("maximum", "latest"),
    { label: "most often", numeric: true, text: ({ most_often: most }) => (most === null ? "–" : `${most[0]} (${share(most[1])})`) },
    some("dropped", "lost"),
    some("on_the_way", "on the way"),
    some("not_landed", "not landed"),
  ];
  return columns.filter(({ key }) => key === undefined || view.sensors.some((sensor) => sensor[key] > 0));
}

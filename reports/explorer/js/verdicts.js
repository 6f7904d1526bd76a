// The methods and the parts side by side, and why some do not.

import { accuracyText, percentText, powerText } from "./amounts.js";
import { digits, html } from "./svg.js";
import { table } from "./table.js";

const MOST_LETTERS = 50;

/** The table of methods in `host`: with an accuracy that is needed, at the latest landing that keeps it. */
export function methodsTable({ host, least, why }, view, onTake) {
  const asked = view.design.within !== null;
  const can = view.methods.filter(({ reason }) => !reason);
  const rows = asked ? [...can].sort(keepingFirst) : can;
  const columns = asked ? keepingColumns(view) : methodColumns(view);
  const pick = asked ? "Pick a method: it is shown with that landing, on that part" : "Pick a method to see it";
  table(host, {
    caption: `${pick}. Least speed: ${view.power.unit}`,
    columns: [{ key: "method", label: "method", text: methodName }, ...columns],
    rows,
    onPick: (row) => onTake(asked && keeps(row) ? row.within.query : row.query),
    current: rows.findIndex(({ method }) => method === view.design.method),
  });
  const [best] = rows;
  least.hidden = !asked || !keeps(best);
  least.textContent = least.hidden ? "" : leastWords(best, view.period_ms);
  reasons(why, view.methods.map(({ method, reason, within }) => [method, reason || within?.reason]));
}

/** The table of parts in `host`. */
export function partsTable({ host, why }, view, onTake) {
  const order = "Those that do come first, by price; without one, by how little they have to spare";
  table(host, {
    caption: `Pick a part to see ${view.design.method} on it. ${order}`,
    columns: [
      { key: "title", label: "part", text: ({ title }) => briefTitle(title) },
      verdict("does it"),
      { key: "needed", label: "of its speed", numeric: true, text: ({ needed }) => percentText(needed && needed.value) },
      { key: "load", label: "load", numeric: true, text: ({ load }) => percentText(load && load.value) },
      { key: "landed", label: "lands at", numeric: true, text: ({ landed, landed_ms: ms }) => stepText(landed, ms) },
      ...accuracyColumn(view, ({ std }) => std),
    ],
    rows: view.parts,
    onPick: (row) => onTake(row.query),
    current: view.parts.findIndex(({ name }) => name === view.design.processor),
  });
  reasons(why, view.parts.map(({ title, reason }) => [briefTitle(title), reason]));
}

function keepingColumns(view) {
  const step = (L) => stepText(L, inTime(L, view.period_ms));
  return [
    { key: "part", label: "part", text: ({ within }) => within?.part ?? "–" },
    { key: "land", label: "land by step", numeric: true, text: ({ within }) => step(within?.L) },
    { key: "power", label: "least speed", numeric: true, text: ({ within }) => powerText(within?.power, view.power) },
    { key: "landed", label: "lands there at", numeric: true, text: ({ within }) => step(within?.landed) },
    ...accuracyColumn(view, ({ within }) => within?.landed_std ?? within?.std),
  ];
}

function methodColumns(view) {
  return [
    { key: "L", label: "land by step", numeric: true, text: ({ L }) => stepText(L, inTime(L, view.period_ms)) },
    { key: "power", label: "least speed", numeric: true, text: ({ power }) => powerText(power, view.power) },
    { key: "binding", label: "fixed by", text: ({ binding }) => binding ?? "–" },
    ...(view.methods.some(({ fits }) => typeof fits === "boolean") ? [verdict("fits")] : []),
    { key: "landed", label: "lands at", numeric: true, text: (row) => stepText(row.achieved_l, row.landed_ms) },
    ...accuracyColumn(view, ({ std }) => std),
  ];
}

function verdict(label) {
  const words = new Map([[true, "yes"], [false, "no"]]);
  return { key: "fits", label, holds: ({ fits }) => fits, text: ({ fits }) => words.get(fits) ?? "" };
}

function accuracyColumn({ design: { model }, current: { unit } }, std) {
  const label = unit ? `accuracy, ${unit}` : "accuracy";
  return model === null ? [] : [{ key: "std", label, numeric: true, text: (row) => accuracyText(std(row)) }];
}

function keeps({ within }) {
  return within !== null && !within.reason;
}

/* Those that keep the accuracy by what they need; then what cannot, and the reference, which nothing reaches. */
function keepingFirst(one, other) {
  const rank = (row) => (row.method === "standard" ? 2 : keeps(row) ? 0 : 1);
  return rank(one) - rank(other) || (rank(one) === 0 ? one.within.power - other.within.power : 0);
}

function methodName({ method }) {
  return method === "standard" ? "standard (no delay)" : method;
}

function leastWords({ method, within: { L, part } }, period) {
  return `Needs least: ${method}${part ? ` on ${part}` : ""}, landing by step ${stepText(L, inTime(L, period))}.`;
}

/* Why some do not, those with one reason together. */
function reasons(list, pairs) {
  const by = new Map();
  for (const [name, reason] of pairs) if (reason) by.set(reason, [...(by.get(reason) ?? []), name]);
  const item = ([reason, names]) => html("li", {}, html("b", {}, names.join(", ")), `: ${reason}`);
  list.replaceChildren(...[...by].map(item));
  list.hidden = by.size === 0;
}

/* A part's title without what is special about it: "Arm Cortex-M4F at 168 MHz, e.g. STM32F407". */
function briefTitle(title) {
  const [name, example = ""] = title.split(", ");
  const both = `${name}, ${example}`;
  return example.startsWith("e.g.") && both.length <= MOST_LETTERS ? both : name;
}

function stepText(L, ms) {
  if (L === null || L === undefined) return "–";
  return ms === null || ms === undefined ? String(L) : `${L} (${digits(ms)} ms)`;
}

function inTime(L, period) {
  return L === null || L === undefined || period === null ? null : L * period;
}

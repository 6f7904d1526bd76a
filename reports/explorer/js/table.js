// A table in a region that scrolls: rows to pick, a current row, verdicts with sign and word.

import { html } from "./svg.js";

const HOLDING = { sign: "✓", class: "ss-holds" };
const FAILING = { sign: "✗", class: "ss-fails" };
const UNKNOWN = { sign: "–", class: "ss-unknown" };

/** A table in `host`, in place of the one that was there: it keeps where it was scrolled to, and the row whose button
 *  had the focus. columns: [{key, label, numeric, text(row), holds(row)}], the first one names the row. text is the
 *  row's value at `key` where it is left out; holds, for a verdict, is true, false or null, a sign before the text.
 *  `onPick(row, index)` makes a button of each row's name; current: the index of a row, or −1. */
export function table(host, { caption, columns, rows, onPick = null, current = -1 }) {
  let region = host.querySelector(":scope > .ss-table-region");
  if (region === null) {
    region = html("div", { class: "ss-table-region", role: "group", tabindex: 0 });
    host.replaceChildren(region);
  }
  const focused = [...region.querySelectorAll(".ss-table-pick")].findIndex((button) => button.matches(":focus"));
  region.setAttribute("aria-label", caption);
  const heads = columns.map((column) => html("th", { scope: "col", class: cellClass(column) }, column.label));
  const picked = (row, index) => (onPick === null ? null : () => onPick(row, index));
  const body = rows.map((row, index) => tableRow(columns, row, picked(row, index), index === current));
  const head = html("thead", {}, html("tr", {}, ...heads));
  const above = html("caption", {}, html("span", {}, caption));
  region.replaceChildren(html("table", { class: "ss-table" }, above, head, html("tbody", {}, ...body)));
  region.querySelectorAll(".ss-table-pick")[focused]?.focus({ preventScroll: true });
}

function tableRow([first, ...others], row, pick, current) {
  const named = { class: pick === null ? "ss-table-name" : "ss-table-name ss-table-pick" };
  const name = pick === null ? html("span", named) : html("button", { type: "button", ...named });
  if (pick !== null) name.addEventListener("click", pick);
  if (current) name.setAttribute("aria-current", "true");
  name.append(cellText(first, row));
  const header = html("th", { scope: "row", class: cellClass(first) }, name);
  const cells = others.map((column) => html("td", { class: cellClass(column) }, tableCell(column, row)));
  return html("tr", { class: current ? "ss-table-now" : null }, header, ...cells);
}

function tableCell(column, row) {
  const text = cellText(column, row);
  if (column.holds === undefined) return column.numeric ? text : html("span", { class: "ss-table-text" }, text);
  const holds = column.holds(row);
  const verdict = holds === true ? HOLDING : holds === false ? FAILING : UNKNOWN;
  const sign = html("span", { "aria-hidden": "true" }, `${verdict.sign} `);
  return html("span", { class: verdict.class }, sign, text);
}

function cellText(column, row) {
  return String((column.text === undefined ? row[column.key] : column.text(row)) ?? "–");
}

function cellClass({ numeric }) {
  return numeric ? "ss-table-number" : null;
}

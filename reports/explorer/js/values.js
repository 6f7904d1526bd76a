// The values of a plot as a table, behind a `details`.

import { html } from "./svg.js";
import { ascending, valueAt } from "./paths.js";
import { axisText } from "./sheet.js";
import { table } from "./table.js";

const MOST_VALUE_ROWS = 60;

/** A closed `details` in an element of its own. `show(make)` makes the table of what `make()` gives, as `table` takes
 *  it, as soon as it is open. */
export function valuesTable() {
  const place = html("div");
  const element = html("details", { class: "ss-plot-values" }, html("summary", {}, "Values as a table"), place);
  let given = null;
  const draw = () => element.open && given !== null && table(place, given());
  element.addEventListener("toggle", draw);

  function show(make) {
    given = make;
    draw();
  }

  return { element, show };
}

/** The table of a plot of lines: a row for each x at which a line has another value than in the row before; of long
 *  lines every so manieth; and always those of designs. */
export function valuesOf({ title, x, y, lines: given, points }) {
  const lines = given.map(ascending);
  const every = [...new Set(lines.flatMap((line) => line.x))].sort((one, other) => one - other);
  const all = every.map((at) => [at, ...lines.map((line) => axisText(y, valueAt(line.x, line.y, at, line.step)))]);
  const designs = new Set(points.map((point) => point.x));
  const needed = (row, index, rows) => index === 0 || index === rows.length - 1 || designs.has(row[0]);
  const differs = (row, index) => row.some((text, at) => at > 0 && text !== all[index - 1][at]);
  const changed = all.filter((row, index) => needed(row, index, all) || differs(row, index));
  const step = Math.ceil(changed.length / MOST_VALUE_ROWS);
  const rows = changed.filter((row, index) => index % step === 0 || needed(row, index, changed));
  const current = points.find((point) => point.current)?.x;
  const thinned = rows.length < all.length ? `; ${rows.length} of ${all.length.toLocaleString("en")} rows` : "";
  const columns = lines.map((line, index) => ({ label: line.name, numeric: true, text: (row) => row[index + 1] }));
  return {
    caption: `${title}: ${y.label}${thinned}`,
    columns: [{ label: x.label, numeric: true, text: (row) => axisText(x, row[0]) }, ...columns],
    rows,
    current: rows.findIndex((row) => row[0] === current),
  };
}

import { ganttChart } from "./gantt.js";
import { themed } from "./ground.js";
import { readout } from "./readout.js";
import { html } from "./svg.js";

// The figures of a report, and schedules in a notebook: Gantt charts to move about in, curves that tell their values.
// Printed, a figure is its picture. Keys that are pressed in one are no shortcuts of a notebook.

for (const figure of document.querySelectorAll("figure[data-alive]")) enliven(figure);

function enliven(figure) {
  figure.removeAttribute("data-alive");
  themed(figure);
  figure.addEventListener("keydown", (event) => event.stopPropagation());
  const shown = JSON.parse(figure.querySelector('script[type="application/json"]').textContent);
  const still = figure.querySelector("a:has(img), img, table");
  const picture = html("div", { class: "ss-picture" });
  still.replaceWith(picture);
  picture.append(still);
  if (shown.plots) readout(picture, shown);
  else withCharts(figure, shown, still.localName !== "table");
}

/** Charts above what stands still; instead of a picture, which a button brings back. */
function withCharts(figure, { panels, still = false }, isPicture) {
  const charts = html("div", { class: "ss-chart" });
  figure.prepend(charts);
  for (const panel of panels) charts.append(chartOf(panel));
  if (!isPicture) return;
  const button = html("button", { type: "button", class: "ss-switch" });
  const show = (what) => {
    figure.dataset.shown = what;
    button.textContent = what === "chart" ? "Show the printed figure" : "Show the chart to move about in";
  };
  button.addEventListener("click", () => show(figure.dataset.shown === "chart" ? "picture" : "chart"));
  figure.querySelector(".ss-picture").after(button);
  show(still ? "picture" : "chart");
}

function chartOf({ title, notes, schedule }) {
  const host = html("div");
  const said = notes.length ? html("span", {}, ` ${notes.join(", ")}`) : null;
  const head = title ? html("p", { class: "ss-alive-title" }, html("b", {}, title), said) : null;
  ganttChart(host).show(schedule);
  return html("div", { class: "ss-alive-panel" }, head, host);
}

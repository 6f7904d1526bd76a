import { fullSize } from "./fullsize.js";
import { ganttChart } from "./gantt.js";
import { themed } from "./ground.js";
import { readout } from "./readout.js";
import { slider } from "./slider.js";
import { html } from "./svg.js";

// The figures of a report, and schedules in a notebook: Gantt charts to move about in, curves that tell their values.
// Printed, a figure is its picture. Keys that are pressed in one are no shortcuts of a notebook.

for (const figure of document.querySelectorAll("figure[data-alive]")) enliven(figure);
for (const scroll of document.querySelectorAll(".ss-scroll:not(.ss-narrow)")) fullSize(scroll);

function enliven(figure) {
  figure.removeAttribute("data-alive");
  if (!figure.closest(".ss-ground")) themed(figure);
  figure.addEventListener("keydown", (event) => event.stopPropagation());
  const shown = JSON.parse(figure.querySelector('script[type="application/json"]').textContent);
  const [picture, narrow] = figure.querySelectorAll(".ss-picture");
  if (shown.plots) readout(picture, shown);
  if (shown.narrow) readout(narrow, shown.narrow);
  if (shown.panels || shown.frames) withCharts(figure, shown, picture);
}

/** Charts above what stands still; instead of the picture, if it is one, which a button brings back. Of several states,
 *  `frames`, the picture is the one `at`, and a slider shows the others. */
function withCharts(figure, { panels, frames = [{ panels }], at = 0, name, still = false }, picture) {
  const host = html("div", { class: "ss-chart" });
  figure.prepend(host);
  const charts = frames[at].panels.map(() => chartIn(host));
  const show = (frame) => frame.panels.forEach((panel, index) => charts[index](panel));
  show(frames[at]);
  if (frames.length > 1) host.prepend(slider({ name, frames, at }, show));
  if (!picture) return;
  const button = html("button", { type: "button", class: "ss-switch" });
  const choose = (what) => {
    figure.dataset.shown = what;
    button.textContent = what === "chart" ? "Show the printed figure" : "Show the chart to move about in";
  };
  button.addEventListener("click", () => choose(figure.dataset.shown === "chart" ? "picture" : "chart"));
  figure.querySelector(".ss-scroll").after(button);
  choose(still ? "picture" : "chart");
}

/** An empty chart: what shows a panel in it. */
function chartIn(host) {
  const [head, drawn] = [html("p", { class: "ss-alive-title" }), html("div")];
  host.append(html("div", { class: "ss-alive-panel" }, head, drawn));
  const chart = ganttChart(drawn);
  return ({ title, notes, schedule }) => {
    head.hidden = !title;
    head.replaceChildren(html("b", {}, title), html("span", {}, ` ${notes.join(", ")}`));
    chart.show(schedule);
  };
}

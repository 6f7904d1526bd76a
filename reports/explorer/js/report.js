import { ganttChart } from "./gantt.js";
import { themed } from "./ground.js";
import { readout } from "./readout.js";
import { slider } from "./slider.js";
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
  if (shown.panels || shown.frames) withCharts(figure, shown, still.localName !== "table");
}

/** Charts above what stands still; instead of a picture, which a button brings back. Of several states, `frames`, the
 *  picture is the one `at`, and a slider shows the others. */
function withCharts(figure, { panels, frames = [{ panels }], at = 0, name, still = false }, isPicture) {
  const host = html("div", { class: "ss-chart" });
  figure.prepend(host);
  const charts = frames[at].panels.map(() => chartIn(host));
  const show = (frame) => frame.panels.forEach((panel, index) => charts[index](panel));
  show(frames[at]);
  if (frames.length > 1) host.prepend(slider({ name, frames, at }, show));
  if (!isPicture) return;
  const button = html("button", { type: "button", class: "ss-switch" });
  const choose = (what) => {
    figure.dataset.shown = what;
    button.textContent = what === "chart" ? "Show the printed figure" : "Show the chart to move about in";
  };
  button.addEventListener("click", () => choose(figure.dataset.shown === "chart" ? "picture" : "chart"));
  figure.querySelector(".ss-picture").after(button);
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

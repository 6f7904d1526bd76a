// The Gantt chart of a schedule, to be zoomed, panned and asked about its jobs by mouse, touch or keys.

import { html } from "./svg.js";
import { coloursOf } from "./colours.js";
import { busyShare, grouped, inSteps, jobSentence, missesSentence } from "./facts.js";
import { listen } from "./gestures.js";
import { ganttLegend, showLegend } from "./legend.js";
import { drawGantt } from "./picture.js";
import { movedStretch, sameStretch, stretchWith, zoomedStretch } from "./stretch.js";
import { themeOf, watchTheme } from "./theme.js";
import { timeline } from "./timeline.js";
import { jobTip } from "./tip.js";
import { jobAt, jobAtEnd, jobBeside, jobInNextRow, nextMiss, sameJob, spanOf } from "./walk.js";

const KEYS = "Arrow keys walk the jobs; with Shift they move the chart. + and − zoom, 0 shows all, Escape closes.";
const BUTTON_ZOOM = 2;
const KEY_PAN = 0.2;
const PRINT_RATIO = 3;

/** A chart in `host`, empty until it is shown a schedule: {show(schedule), destroy()}. `show`: a view's schedule; with
 *  `first` and `last`, a part of it to begin with. Of one with the same steps, the stretch that is shown stays. */
export function ganttChart(host) {
  const chart = new Gantt(host);
  return { show: (schedule) => chart.show(schedule), destroy: () => chart.destroy() };
}

class Gantt {
  line = null;
  stretch = null;
  job = null;
  hovered = null;
  drawn = null;
  waiting = 0;

  constructor(host) {
    this.parts = ganttParts((name) => this.press(name));
    this.tip = jobTip(this.parts.frame);
    host.append(this.parts.root);
    const { frame, canvas, root } = this.parts;
    this.stops = [
      listen(frame, canvas, this.asked()),
      watchTheme(() => this.drawSoon(), (printing) => this.print(printing)),
    ];
    this.sizes = new ResizeObserver(() => frame.clientWidth !== this.width && this.drawSoon());
    this.sizes.observe(frame);
    root.addEventListener("focusout", ({ relatedTarget }) => {
      if (!root.contains(relatedTarget) && !root.contains(document.activeElement)) this.pick(null);
    });
  }

  show(schedule) {
    const before = this.line;
    this.line = timeline(schedule);
    this.parts.root.hidden = false;
    const { whole } = this.line;
    if (!sameStretch(before?.whole, whole)) {
      this.stretch = { first: schedule.first ?? whole.first, end: schedule.last ?? whole.end };
    }
    const of = before?.schedule.jobs;
    this.job = this.job === null ? null : sameJob(this.line, of.kind[this.job], of.step[this.job]);
    this.hovered = null;
    this.say();
    if (before === null) this.draw();
    else this.drawSoon();
  }

  destroy() {
    cancelAnimationFrame(this.waiting);
    this.sizes.disconnect();
    for (const stop of this.stops) stop();
    this.parts.root.remove();
  }

  /** What pointers and keys ask for. */
  asked() {
    return {
      zoom: (factor, x) => this.zoom(factor, x),
      pan: (px) => this.pan(px),
      whole: () => this.to(this.line.whole),
      hover: (point) => this.hover(point && this.jobAt(point)),
      pick: (point) => this.pick(this.jobAt(point)),
      key: (key) => this.key(key),
    };
  }

  /** None where what is shown is not drawn yet. */
  jobAt(point) {
    const { line, drawn } = this;
    return drawn?.line === line ? jobAt(line, drawn.layout, drawn.scale, point) : null;
  }

  press(name) {
    const { line, job, stretch } = this;
    if (name === "out") this.zoom(BUTTON_ZOOM, null);
    if (name === "in") this.zoom(1 / BUTTON_ZOOM, null);
    if (name === "whole") this.to(line.whole);
    if (name === "previous") this.walk(jobBeside(line, job, -1, stretch));
    if (name === "next") this.walk(jobBeside(line, job, 1, stretch));
    if (name === "miss") this.walk(nextMiss(line, job));
  }

  key(key) {
    const { line, job, stretch } = this;
    const length = stretch.end - stretch.first;
    const walks = {
      ArrowLeft: () => jobBeside(line, job, -1, stretch),
      ArrowRight: () => jobBeside(line, job, 1, stretch),
      ArrowUp: () => jobInNextRow(line, job, -1, stretch),
      ArrowDown: () => jobInNextRow(line, job, 1, stretch),
      Home: () => jobAtEnd(line, job, false, stretch),
      End: () => jobAtEnd(line, job, true, stretch),
    };
    if (key in walks) return line.schedule.jobs.row.length > 0 && this.walk(walks[key]());
    if (key === "ShiftArrowLeft") return this.to(movedStretch(stretch, -KEY_PAN * length, line.whole));
    if (key === "ShiftArrowRight") return this.to(movedStretch(stretch, KEY_PAN * length, line.whole));
    if (key === "Escape" && job !== null) return this.pick(null);
    return false;
  }

  /** Around x in pixels; null: around the job in focus, or the middle. */
  zoom(factor, x) {
    const { first, end } = this.stretch;
    const around = this.job === null ? null : spanOf(this.line, this.job)[0];
    const middle = around === null || around < first || around > end ? (first + end) / 2 : around;
    const at = x === null ? middle : this.drawn.scale.invert(x);
    return this.to(zoomedStretch(this.stretch, factor, at, this.line.whole));
  }

  pan(px) {
    const { scale } = this.drawn;
    return this.to(movedStretch(this.stretch, scale.invert(px) - scale.invert(0), this.line.whole));
  }

  /** Shows another stretch; whether it is another. */
  to(stretch) {
    if (sameStretch(this.stretch, stretch)) return false;
    this.stretch = stretch;
    this.drawSoon();
    return true;
  }

  hover(job) {
    if (job === this.hovered) return;
    this.hovered = job;
    this.parts.canvas.classList.toggle("ss-gantt-over", job !== null);
    this.tell();
  }

  /** Puts a job in focus, and says it; null: none. */
  pick(job) {
    this.job = job;
    this.parts.live.textContent = job === null ? "" : jobSentence(this.line, job);
    this.tell();
    return true;
  }

  walk(job) {
    if (job === null) return false;
    this.hovered = null;
    this.stretch = stretchWith(this.stretch, ...spanOf(this.line, job), this.line.whole);
    this.pick(job);
    this.drawSoon();
    return true;
  }

  drawSoon() {
    cancelAnimationFrame(this.waiting);
    this.waiting = requestAnimationFrame(() => this.draw());
  }

  draw(ratio = devicePixelRatio) {
    const { root, frame, canvas, legend, range, tools } = this.parts;
    this.width = frame.clientWidth;
    if (!this.line || !this.width) return;
    const look = `${themeOf(root)} ${this.line.styles.map(({ label }) => label)}`;
    if (look !== this.look) this.colours = coloursOf(root, this.line.styles);
    this.look = look;
    this.drawn = drawGantt(canvas, this.line, this.stretch, this.width, this.colours, ratio);
    showLegend(legend, ganttLegend({ line: this.line, colours: this.colours }, this.drawn.every), look);
    const whole = sameStretch(this.stretch, this.line.whole);
    range.textContent = stretchWords(this.stretch, this.line.whole);
    canvas.classList.toggle("ss-gantt-part", !whole);
    for (const name of ["out", "whole"]) tools[name].setAttribute("aria-disabled", whole);
    this.tell();
  }

  /** Shows what a job says, beside it. */
  tell() {
    const job = this.hovered ?? this.job;
    if (job === null || this.drawn?.line !== this.line) return this.tip.hide();
    const { layout, scale } = this.drawn;
    const [start, end] = spanOf(this.line, job);
    const { first, end: last } = this.stretch;
    if (end < first || start > last) return this.tip.hide();
    const lane = layout.lanes[this.line.schedule.jobs.row[job]];
    const [x, toX] = [scale(Math.max(start, first)), scale(Math.min(end, last))];
    return this.tip.show(this.line, job, { x, toX, lane, width: layout.width });
  }

  /** The finding, in text and as the chart's name. */
  say() {
    const { finding, frame, tools } = this.parts;
    const { schedule, misses } = this.line;
    const said = missesSentence(schedule);
    const notes = [busyShare(schedule), schedule.cut].filter(Boolean);
    const whole = stretchWords(this.line.whole, this.line.whole);
    const verdict = misses.length ? html("strong", { class: "ss-gantt-missed" }, `✗ ${said}`) : said;
    finding.replaceChildren(verdict, ...notes.map((text) => ` · ${text}`));
    frame.setAttribute("aria-label", `Gantt chart of ${whole}: ${[said, ...notes].join("; ")}`);
    tools.miss.hidden = !misses.length;
    tools.previous.hidden = tools.next.hidden = !schedule.jobs.row.length;
  }

  print(printing) {
    this.parts.root.classList.toggle("ss-printing", printing);
    this.draw(printing ? PRINT_RATIO : devicePixelRatio);
  }
}

function ganttParts(press) {
  const button = (name, text, label) => {
    const made = html("button", { type: "button", "aria-label": label, title: label }, text);
    made.addEventListener("click", () => press(name));
    return [name, made];
  };
  const tools = Object.fromEntries([
    button("out", "−", "zoom out"),
    button("in", "+", "zoom in"),
    button("whole", "whole", "show all steps"),
    button("previous", "‹ job", "previous job"),
    button("next", "job ›", "next job"),
    button("miss", "next miss", "next missed deadline"),
  ]);
  const finding = html("p", { class: "ss-gantt-finding" });
  const range = html("span", { class: "ss-gantt-range" });
  const group = { class: "ss-gantt-tools", role: "group", "aria-label": "Gantt chart" };
  const head = html("div", { class: "ss-gantt-head" }, finding, html("div", group, range, ...Object.values(tools)));
  const canvas = html("canvas", { "aria-hidden": "true" });
  const application = { class: "ss-gantt-frame", tabindex: 0, role: "application", "aria-description": KEYS };
  const frame = html("div", application, canvas);
  const keys = html("p", { class: "ss-gantt-keys", "aria-hidden": "true" }, KEYS);
  const live = html("p", { class: "ss-gantt-live", "aria-live": "polite" });
  const legend = html("ul", { class: "ss-gantt-legend", "aria-label": "Legend" });
  const root = html("div", { class: "ss-gantt", hidden: true }, head, frame, keys, live, legend);
  return { root, finding, range, tools, frame, canvas, live, legend };
}

/** "steps 18 to 31 of 80", "80 steps". */
function stretchWords({ first, end }, whole) {
  const shown = end - first;
  const places = Math.max(0, 2 - Math.floor(Math.log10(shown)));
  const part = `steps ${inSteps(first, places)} to ${inSteps(end, places)}`;
  if (shown < whole.end - whole.first) return whole.first ? part : `${part} of ${grouped(whole.end)}`;
  return whole.first ? part : `${grouped(whole.end)} ${whole.end === 1 ? "step" : "steps"}`;
}

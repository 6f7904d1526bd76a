// The whole explorer in one element: a form, the answer, and what shows why.

import { changedQuery, asSteps, asTimes, modeOf, queryOf, textOf } from "./address.js";
import { answerBox, unanswered } from "./answer.js";
import { asker } from "./ask.js";
import { controls } from "./controls.js";
import { viewInPageWords } from "./fields.js";
import { pictures } from "./pictures.js";
import { pinboard } from "./pins.js";
import { saving } from "./save.js";
import { html } from "./svg.js";

const SAID_BESIDE = "That cannot be; why is said beside what was changed.";
const SHOWN_BEFORE = "Shown is another design.";

/**
 * The explorer of the design that `query` says, a text. `ask(query, signal)` promises its view; what it rejects with is
 * shown, and asked again where it is `gone`. `onQuery(query, {settled, key})` hears of each change: of which control,
 * and whether it is still being dragged; `onPins(text)` of the pinned designs, which `pins` gives.
 * `files(kind, query, pins)`, with kind schedule.svg, methods.csv, parts.csv, jobs.csv or link, gives an address or
 * null.
 */
export function explorer(host, { ask, query = "", pins = "", onQuery = unheard, onPins = unheard, files = noFile }) {
  const id = `ss-${Math.random().toString(36).slice(2, 10)}`;
  const root = html("div", { class: "ss-explorer ss-ground" });
  const top = html("section", { class: "ss-answer", "aria-label": "Answer" });
  const side = html("div", { class: "ss-side" });
  const results = html("div", { class: "ss-results", tabindex: "-1" });
  const beside = html("div", { class: "ss-beside" });
  root.append(skip(results), html("div", { class: "ss-frame" }, top, side, beside, results));
  host.append(root);

  let asked = queryOf(query);
  let mode = modeOf(asked);
  let view = null;
  let changes = [];
  let [wanted, awaited, turning] = [query, true, null];
  let frame = null;
  let force = true;
  let refusal = null;

  const box = answerBox(top, beside, id, { onPin: () => board.add(view), onStop: stop, onBack: back });
  const form = controls(side, id, { onChange: change, onMode: (next) => turn(next) });
  const drawn = pictures(results, id, { onTake: take });
  const board = pinboard(drawn.pinned, id, { ask: (text) => asking.aside(text), onTake: take, onPins: pinned });
  const save = saving(results, id, files);
  const asking = asker(ask, {
    answered(answered, text) {
      const first = view === null;
      view = viewInPageWords(answered);
      awaited = text !== wanted;
      if (asked.size === 0) adopt(view.query);
      if (text !== "") refusal = null;
      if (turning !== null) turn(turning);
      frame ??= requestAnimationFrame(draw);
      if (first) board.show(pins);
    },
    refused(text) {
      refusal = text;
      awaited = false;
      if (view === null) want("");
      else refuse();
    },
    ...unanswered(box, stale),
  });
  want(query);

  function stop() {
    awaited = false;
    asking.stop();
  }

  function want(text) {
    [wanted, awaited] = [text, true];
    asking.want(text);
  }

  function draw() {
    frame = null;
    if (mode === "times" && !asked.has("hr_hz")) mode = "steps";
    box.show(view);
    form.set({ query: asked, view, mode }, force);
    form.refuse("");
    force = false;
    drawn.show(view, board.points(view));
    board.compare(view);
    save.show(view, board.text());
    stale(false);
    if (refusal !== null) refuse();
    root.dataset.shown = view.query;
  }

  function refuse() {
    turning = null;
    form.set({ query: asked, view, mode });
    if (form.refuse(refusal, changes)) {
      box.refused(`${SAID_BESIDE} ${SHOWN_BEFORE}`, true);
      stale(true);
    } else {
      box.refused(`${refusal}. ${SHOWN_BEFORE}`, false);
      adopt(view.query);
      form.set({ query: asked, view, mode }, true);
    }
  }

  function adopt(text) {
    asked = queryOf(text);
    mode = modeOf(asked);
  }

  function stale(is) {
    root.classList.toggle("ss-stale", is);
  }

  function change(next, { key, settled }) {
    asked = changedQuery(asked, next);
    changes = Object.keys(next);
    onQuery(textOf(asked), { key, settled });
    want(textOf(asked));
  }

  function take(text) {
    asked = queryOf(text);
    changes = [];
    force = true;
    onQuery(text, { key: null, settled: true });
    want(text);
  }

  /** As soon as it is known what the design comes to that was asked for last. */
  function turn(next) {
    turning = awaited ? next : null;
    if (turning !== null) return;
    mode = next;
    const turned = next === "steps" ? asSteps(asked, view.design) : asTimes(asked, view.design);
    force = true;
    const keys = [...new Set([...asked.keys(), ...turned.keys()])];
    change(Object.fromEntries(keys.map((key) => [key, turned.get(key) ?? null])), { key: "mode", settled: true });
  }

  function pinned(text) {
    onPins(text);
    frame ??= requestAnimationFrame(draw);
  }

  function back() {
    if (view !== null) take(view.query);
  }

  return {
    /** Shows another design and other pins, as a link gives them, and tells nobody. */
    show(text, pinned) {
      adopt(text);
      changes = [];
      force = true;
      if (pinned !== undefined) board.show(pinned);
      want(text);
    },
    destroy() {
      cancelAnimationFrame(frame);
      asking.destroy();
      box.destroy();
      drawn.destroy();
      root.remove();
    },
  };
}

/* No link within the page: its fragment would take the place of the pinned designs. */
function skip(results) {
  const link = html("button", { type: "button", class: "ss-skip" }, "Skip to the designs");
  link.addEventListener("click", () => {
    results.focus();
    results.scrollIntoView();
  });
  return link;
}

function unheard() {}

function noFile() {
  return null;
}

// Designs put aside to compare: a letter each, a column of what they come to, and a mark in the plots.

import { inPageWords } from "./fields.js";
import { html, digits } from "./svg.js";
import { accuracyText, percentText, powerText } from "./amounts.js";

const MOST = 8;
const LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/**
 * The pinned designs in `host`. `ask(query)` promises the view of one that came with a link; `onTake(query)`
 * hears which is to be shown, `onPins(text)` what a link's fragment is to say, whenever that changes.
 */
export function pinboard(host, id, { ask, onTake, onPins }) {
  let pins = [];
  let now = null;
  const said = html("p", { class: "ss-help", role: "status" });
  const heading = html("h2", { id: `${id}-pinned` }, "Pinned designs");
  const scroll = html("div", { class: "ss-scroll", tabindex: "0", role: "group", "aria-labelledby": `${id}-pinned` });
  const section = html("section", { class: "ss-section", "aria-labelledby": `${id}-pinned` }, heading, said, scroll);
  section.hidden = true;
  host.append(section);

  const text = () => new URLSearchParams(pins.map(({ letter, query }) => [letter, query])).toString();
  const tell = () => {
    draw();
    onPins(text());
  };

  async function fill() {
    for (const pin of pins) {
      if (pin.view || pin.refused) continue;
      try {
        pin.view = await ask(pin.query);
      } catch (error) {
        pin.refused = inPageWords(error.message);
      }
      onPins(text());
    }
  }

  function remove(letter) {
    pins = pins.filter((pin) => pin.letter !== letter);
    said.textContent = `${letter} is no longer pinned.`;
    tell();
    (scroll.querySelector("button") ?? host.closest(".ss-explorer")?.querySelector(".ss-pin"))?.focus();
  }

  function draw() {
    section.hidden = pins.length === 0;
    if (pins.length === 0 || now === null) return scroll.replaceChildren();
    const held = scroll.querySelector(":focus")?.dataset.key;
    const head = html("tr", {}, html("td", {}), html("th", { scope: "col" }, "now"), ...pins.map(heads));
    const text = (cell, { view, refused }) => (view ? cell(view) : refused ? "–" : "…");
    const cells = (cell) => [{ view: now }, ...pins].map((pin) => html("td", {}, text(cell, pin)));
    const rows = ROWS.map(([label, cell]) => html("tr", {}, html("th", { scope: "row" }, label), ...cells(cell)));
    const refused = pins.filter((pin) => pin.refused).map((pin) => `${pin.letter}: ${pin.refused}`);
    scroll.replaceChildren(
      html("table", { class: "ss-compared" }, html("thead", {}, head), html("tbody", {}, ...rows)),
      ...refused.map((why) => html("p", { class: "ss-refusal" }, why)),
    );
    if (held) scroll.querySelector(`[data-key="${held}"]`)?.focus();
  }

  function heads({ letter, query }) {
    const button = (word, onClick) => {
      const named = { "data-key": `${word} ${letter}`, "aria-label": `${word} design ${letter}` };
      const element = html("button", { type: "button", class: "ss-button", ...named }, word);
      element.addEventListener("click", onClick);
      return element;
    };
    const [take, drop] = [button("Show", () => onTake(query)), button("Remove", () => remove(letter))];
    return html("th", { scope: "col" }, html("span", { class: "ss-letter" }, letter), " ", take, " ", drop);
  }

  return {
    text,
    /** Pins the design of a view. */
    add(view) {
      const same = pins.find((pin) => pin.view?.query === view.query);
      const letter = [...LETTERS].find((each) => !pins.some((pin) => pin.letter === each));
      if (same) said.textContent = `This design is pinned already, as ${same.letter}.`;
      else if (pins.length === MOST) said.textContent = `${MOST} designs are pinned: remove one first.`;
      else {
        pins = [...pins, { letter, query: view.query, view }].sort((a, b) => (a.letter < b.letter ? -1 : 1));
        said.textContent = `Pinned as ${letter}. The link in the address bar has it too.`;
        tell();
      }
    },
    /** Pins what the fragment of a link says, and asks for what is not known of it. */
    show(fragment) {
      const known = new Map(pins.map((pin) => [`${pin.letter}${pin.query}`, pin]));
      const given = [...new Map(new URLSearchParams(fragment))].filter(([letter]) => [...LETTERS].includes(letter));
      pins = given.slice(0, MOST).map(([letter, query]) => known.get(letter + query) ?? { letter, query });
      draw();
      fill();
    },
    /** Sets the design of a view beside them. */
    compare(view) {
      now = view;
      draw();
    },
    /** What to mark in plots that are in the units of a view: {letter, design, current} of each pin. */
    points({ power, period_ms }) {
      const alike = (view) => view && view.power.unit === power.unit && view.period_ms === period_ms;
      return pins.filter((pin) => alike(pin.view)).map(({ letter, view }) => ({ letter, view }));
    },
  };
}

const ROWS = [
  ["method", ({ design }) => design.method],
  ["N, M, L", ({ design }) => [design.N, design.M ?? "–", design.L ?? "–"].join(", ")],
  ["least speed", ({ current, power }) => `${powerText(current.power, power)} ${power.short === "speed" ? "" : power.short}`],
  ["lands at", ({ current }) => landing(current)],
  ["accuracy", ({ current }) => (current.std === null ? "–" : `${accuracyText(current.std)} ${current.unit ?? ""}`)],
  ["part", ({ design, parts }) => design.processor ?? wouldDo(parts)],
  ["load", ({ design, current }) => loadText(current, design.processor ?? design.speed)],
];

/* Of a design that is on no part. */
function wouldDo(parts) {
  const part = parts.find(({ fits, reason }) => fits && !reason);
  return part ? `${part.name} would do` : "–";
}

function loadText({ load }, given) {
  if (!load) return "–";
  return `${percentText(load.value)}${given === null ? " at the least speed" : ""}`;
}

function landing({ achieved_l: steps, landed_ms: after }) {
  if (steps === null) return "never";
  return after === null ? `step ${steps}` : `step ${steps}, ${digits(after)} ms`;
}

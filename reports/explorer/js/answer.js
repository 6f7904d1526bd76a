// The sentence that answers, what to be warned of, and how far it is when it takes long.

import { html } from "./svg.js";

const SETTLED_MS = 600;
const STATE_SIGNS = { holds: "✓", misses: "✗", inaccurate: "✗", unknown: "?" };

/** The answer in `box`, warnings and notes in `beside`. `onStop`, `onBack` and, where designs can be pinned, `onPin`
 *  hear of its buttons. Each of its methods shows a state. */
export function answerBox(box, beside, id, { onStop, onBack, onPin = null }) {
  const sign = html("span", { class: "ss-sign", "aria-hidden": "true" });
  const words = html("span", {}, "One moment …");
  const live = { role: "status", "aria-live": "polite", "aria-atomic": "true" };
  const sentence = html("p", { class: "ss-sentence", ...live }, sign, words);
  const telling = html("p", { class: "ss-telling", "aria-live": "polite" });
  const seconds = html("span", { "aria-hidden": "true" });
  const pin = button("Pin this design", onPin);
  pin.classList.add("ss-pin");
  const stop = button("Stop", onStop);
  const back = button("Back to the last design", onBack);
  const line = html("div", { class: "ss-line" }, telling, seconds, stop, back);
  const warnings = html("ul", { class: "ss-warnings", "aria-label": "Warnings" });
  const notes = html("ul", { id: `${id}-notes` });
  const noted = html("details", { class: "ss-notes" }, html("summary", {}, "How this was computed"), notes);
  box.append(sentence, line);
  beside.append(warnings, noted, pin);
  let settling = null;

  const tell = (text, { stopping = false, backing = false } = {}) => {
    if (telling.textContent !== text) telling.textContent = text;
    seconds.textContent = "";
    stop.hidden = !stopping;
    back.hidden = !backing;
    line.hidden = text === "";
  };
  const listed = (list, texts) => {
    list.replaceChildren(...texts.map((text) => html("li", {}, text)));
    list.hidden = texts.length === 0;
  };
  const settle = () => {
    sentence.setAttribute("aria-busy", "true");
    clearTimeout(settling);
    settling = setTimeout(() => sentence.removeAttribute("aria-busy"), SETTLED_MS);
  };
  tell("");
  pin.disabled = true;
  pin.hidden = onPin === null;

  return {
    /** The answer of a view. It is read out when no other has followed for a while. */
    show({ answer, warnings: warned, notes: said }) {
      if (words.textContent !== answer.sentence) {
        settle();
        words.replaceChildren(...verdictFirst(answer.sentence));
      }
      sign.textContent = STATE_SIGNS[answer.state] ?? "";
      box.dataset.state = answer.state;
      pin.disabled = false;
      listed(warnings, warned);
      listed(notes, said);
      noted.hidden = said.length === 0;
      tell("");
    },
    waiting(count) {
      tell("Still computing", { stopping: true });
      seconds.textContent = `(${count} s)`;
    },
    stopped: () => tell("Stopped. Shown is the design before.", { backing: true }),
    gone: (text) => tell(text),
    refused: (text, backing) => tell(text, { backing }),
    destroy: () => clearTimeout(settling),
  };
}

/** What an `asker` tells while there is no answer, said in the box; `stale(true)` hears that the picture is of another
 *  design. */
export function unanswered(box, stale) {
  return {
    waiting: box.waiting,
    gone(text) {
      box.gone(text);
      stale(true);
    },
    stopped() {
      box.stopped();
      stale(true);
    },
  };
}

/* What stands before a colon is the verdict. */
function verdictFirst(sentence) {
  const at = sentence.indexOf(": ");
  return at < 0 ? [html("strong", {}, sentence)] : [html("strong", {}, sentence.slice(0, at)), sentence.slice(at)];
}

function button(text, onClick) {
  const element = html("button", { type: "button", class: "ss-button" }, text);
  element.addEventListener("click", () => onClick());
  return element;
}

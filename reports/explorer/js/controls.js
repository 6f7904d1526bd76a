// The form: all controls, filled from a query and the view of it.

import { choiceField, numberField, radioField } from "./field.js";
import { fieldRefused, GROUPS, inPageWords } from "./fields.js";
import { html } from "./svg.js";

const MODES = [{ value: "times", words: "Hz and ms" }, { value: "steps", words: "steps" }];

/**
 * The form in `host`; its elements' ids begin with `id`. `onChange(changes, {key, settled})` hears what a control
 * writes into the query, `onMode(mode)` in what the design is to be given.
 */
export function controls(host, id, { onChange, onMode }) {
  let context = null;
  const made = [];
  const mode = radioField({ id: `${id}-mode`, label: "Given in", options: MODES }, onMode);

  const control = (field) => {
    const told = { id: `${id}-${made.length}-${field.key}`, label: field.label, help: "", empty: field.empty };
    const write = (settled, ...value) => onChange(field.write(...value, context), { key: field.key, settled });
    const part = field.options
      ? choiceField(told, (value) => write(true, value))
      : numberField(told, (text, stop, settled) => write(settled, text, stop));
    made.push({ field, part });
    return part.element;
  };
  const group = ({ legend, fields, folded, mode: given }) => {
    const parts = fields.map(control);
    if (folded) return html("details", { class: "ss-group" }, html("summary", {}, legend), ...parts);
    return html("fieldset", { class: "ss-group" }, html("legend", {}, legend), given ? mode.element : null, ...parts);
  };
  const form = html("form", { class: "ss-controls", "aria-label": "Design", novalidate: true }, ...GROUPS.map(group));
  form.addEventListener("submit", (event) => event.preventDefault());
  host.append(form);

  return {
    /** Fills all from {query, view, mode}; what is being typed stays unless it is forced. */
    set(next, force = false) {
      context = next;
      mode.set(context.mode);
      for (const { field, part } of made) {
        const shown = field.shown?.(context) ?? true;
        part.element.hidden = !shown;
        if (!shown) continue;
        part.help(typeof field.help === "string" ? field.help : field.help(context));
        if (field.options) {
          const options = field.options(context);
          const none = options[0]?.value === "" ? "" : String(context.view.design[field.key]);
          part.set(context.query.get(field.key) ?? none, options);
        } else part.set(field.value(context), field.unit(context), field.stops(context), force);
      }
    },
    /** Shows a refusal at the control it is about, of those changed last; says whether there is one. No text: none. */
    refuse(text, changes = []) {
      const seen = made.filter(({ part }) => !part.element.hidden);
      const about = text ? fieldRefused(text, changes, seen.map(({ field }) => field)) : null;
      for (const { field, part } of made) part.refuse(field === about ? inPageWords(text) : "");
      const folded = seen.find(({ field }) => field === about)?.part.element.closest("details");
      if (folded) folded.open = true;
      return about !== null;
    },
  };
}

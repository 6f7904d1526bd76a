import { explorer } from "./explorer.js";
import { themed } from "./ground.js";
import { html } from "./svg.js";

// The explorer in a cell of a notebook: Python answers, by the traits of reports/explorer/widget.py. Keys that are
// pressed in it are no shortcuts of the notebook.

const SILENT_MS = 20000;
const SILENT = "Python does not answer. If another cell is running, wait for it; else run the cell anew.";

function render({ model, el }) {
  const host = html("div", { class: "ss-ground ss-cell" });
  el.append(host);
  host.addEventListener("keydown", (event) => event.stopPropagation());
  const unthemed = themed(host);
  let waiting = null;

  const ask = (query, signal) => new Promise((resolve, reject) => {
    waiting?.end();
    const tell = () => (model.get("error") ? reject(new Error(model.get("error"))) : resolve(model.get("view")));
    if (query === "") return resolve(model.get("view"));
    if (model.get("answered") === query) return tell();
    const timer = setTimeout(() => reject(new Error(SILENT)), SILENT_MS);
    waiting = { query, tell, end: () => clearTimeout(timer) };
    signal?.addEventListener("abort", waiting.end);
    model.set("query", query);
    model.save_changes();
    return undefined;
  });
  const shown = explorer(host, { ask, query: model.get("query") });
  const answered = () => {
    if (waiting?.query !== model.get("answered")) return;
    waiting.end();
    waiting.tell();
    waiting = null;
  };
  const changed = () => {
    if (model.get("query") !== waiting?.query) shown.show(model.get("query"));
  };
  model.on("change:answered", answered);
  model.on("change:query", changed);
  return () => {
    model.off("change:answered", answered);
    model.off("change:query", changed);
    unthemed();
    shown.destroy();
  };
}

export default { render };

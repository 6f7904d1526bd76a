// What to take along: the chart, the tables, the command, the Python, and the link.

import { html } from "./svg.js";

const FILES = [
  ["schedule.svg", "Chart (SVG)"],
  ["methods.csv", "Methods (CSV)"],
  ["parts.csv", "Parts (CSV)"],
  ["jobs.csv", "Jobs (CSV)"],
];
const COPIED_MS = 2000;

/** The section in `host`; `files(kind, query, pins)` gives addresses, or null for what there is not. */
export function saving(host, id, files) {
  const downloads = html("p", { class: "ss-downloads" });
  const [shell, python] = [copied("Command", `${id}-shell`), copied("Python", `${id}-python`)];
  const link = copied("Link", `${id}-link`);
  host.append(html("section", { class: "ss-section ss-save", "aria-labelledby": `${id}-save` },
    html("h2", { id: `${id}-save` }, "Save"), downloads, link.element, shell.element, python.element));

  return {
    show({ query, commands }, pins) {
      const offered = FILES.map(([kind, words]) => [files(kind, query, pins), words]).filter(([address]) => address !== null);
      const held = [...downloads.children].indexOf(document.activeElement);
      downloads.replaceChildren(...offered.flatMap(([href, words]) => [html("a", { href, download: "", class: "ss-button" }, words), " "]));
      if (held >= 0) downloads.children[held]?.focus();
      link.show(files("link", query, pins));
      shell.show(commands.shell);
      python.show(commands.python);
    },
  };
}

function copied(label, id) {
  const text = html("textarea", { id, readonly: true, rows: 1, spellcheck: "false", class: "ss-copied", wrap: "off" });
  const copy = html("button", { type: "button", class: "ss-button", "aria-describedby": id }, `Copy ${label.toLowerCase()}`);
  const said = html("span", { class: "ss-said", role: "status" });
  const element = html("div", { class: "ss-copy" }, html("label", { for: id }, label), text, html("p", {}, copy, " ", said));
  let timer = null;
  copy.addEventListener("click", async () => {
    clearTimeout(timer);
    said.textContent = (await intoClipboard(text)) ? "Copied." : "Selected: copy it with Ctrl+C.";
    timer = setTimeout(() => { said.textContent = ""; }, COPIED_MS);
  });
  return {
    element,
    /** Shows the text; null hides it all. */
    show(value) {
      element.hidden = value === null || value === undefined;
      if (element.hidden || text.value === value) return;
      text.value = value;
      text.rows = Math.min(value.split("\n").length, 12);
    },
  };
}

async function intoClipboard(text) {
  try {
    await navigator.clipboard.writeText(text.value);
    return true;
  } catch {
    text.focus();
    text.select();
    return false;
  }
}

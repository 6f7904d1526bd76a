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
  const [shell, python] = [copied("command", `${id}-shell`), copied("Python", `${id}-python`)];
  const address = copied("link", `${id}-link`);
  host.append(html("section", { class: "ss-section", "aria-labelledby": `${id}-save` },
    html("h2", { id: `${id}-save` }, "Save"), downloads, address.element, shell.element, python.element));

  return {
    show({ query, commands, schedule: { cut } }, pins) {
      const said = (kind) => (kind === "jobs.csv" && cut ? `: ${cut}` : "");
      const all = FILES.map(([kind, words]) => [files(kind, query, pins), `${words}${said(kind)}`]);
      const offered = all.filter(([address]) => address !== null);
      const held = [...downloads.children].indexOf(downloads.querySelector(":focus"));
      const link = ([href, words]) => html("a", { href, download: "", class: "ss-button" }, words);
      downloads.replaceChildren(...offered.flatMap((each) => [link(each), " "]));
      if (held >= 0) downloads.children[held]?.focus();
      address.show(files("link", query, pins));
      shell.show(commands.shell);
      python.show(commands.python);
    },
  };
}

function copied(label, id) {
  const text = html("textarea", { id, readonly: true, rows: 1, spellcheck: "false", class: "ss-copied", wrap: "off" });
  const copy = html("button", { type: "button", class: "ss-button" }, `Copy the ${label}`);
  const said = html("span", { role: "status" });
  const told = html("p", {}, copy, " ", said);
  const element = html("div", { class: "ss-copy" }, html("label", { for: id }, capital(label)), text, told);
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

function capital(text) {
  return text[0].toUpperCase() + text.slice(1);
}

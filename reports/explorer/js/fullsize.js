// A figure that is too small to read on a narrow screen, at the size of the printed page: then it scrolls.

import { html } from "./svg.js";

/** scroll: what holds the picture. A button, and a tap on what tells nothing, show it in full size and back. */
export function fullSize(scroll) {
  const button = html("button", { type: "button", class: "ss-switch ss-full", "aria-pressed": "false" }, "Full size");
  const label = `${scroll.closest("figure").querySelector("figcaption b")?.textContent ?? "Figure"} at full size`;
  const region = { tabindex: "0", role: "region", "aria-label": label, "data-full": "" };
  const toggle = () => {
    const full = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(full));
    for (const [name, value] of Object.entries(region)) {
      if (full) scroll.setAttribute(name, value);
      else scroll.removeAttribute(name);
    }
  };
  button.addEventListener("click", toggle);
  scroll.querySelector("svg").addEventListener("click", () => { if (button.checkVisibility()) toggle(); });
  scroll.after(button);
}

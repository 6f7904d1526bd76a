// In which colours a canvas has to be drawn, and when that changes.

const SCHEMES = ["(prefers-color-scheme: dark)", "(forced-colors: active)", "print"];

/** A text that differs where the colours of palette.css do. */
export function themeOf(element) {
  return `${getComputedStyle(element).colorScheme} ${SCHEMES.map((query) => matchMedia(query).matches)}`;
}

/** Calls `changed` when the theme has, and `print` with whether it is for paper now; gives back what ends that. */
export function watchTheme(changed, print) {
  const gone = new AbortController();
  const { signal } = gone;
  for (const query of SCHEMES) matchMedia(query).addEventListener("change", changed, { signal });
  window.addEventListener("beforeprint", () => print(true), { signal });
  window.addEventListener("afterprint", () => print(false), { signal });
  const themes = new MutationObserver(changed);
  themes.observe(document.documentElement, { attributes: true, subtree: true, attributeFilter: ["data-theme"] });
  return () => {
    gone.abort();
    themes.disconnect();
  };
}

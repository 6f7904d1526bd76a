// Whether what lies behind an element is light or dark: a notebook or a page may have its own theme.

/** "light" or "dark". */
function groundOf(element) {
  for (let behind = element; behind; behind = behind.parentElement) {
    const [red, green, blue, alpha = 1] = (getComputedStyle(behind).backgroundColor.match(/[\d.]+/g) ?? [0, 0, 0, 0]).map(Number);
    if (alpha > 0.5) return 0.299 * red + 0.587 * green + 0.114 * blue < 128 ? "dark" : "light";
  }
  return "light";
}

/** Gives `element` the theme of what is behind it, now and when the page changes its own; returns what ends that. */
export function themed(element) {
  const take = () => { element.dataset.theme = groundOf(element.parentElement); };
  const watch = new MutationObserver(take);
  for (const root of [document.documentElement, document.body]) watch.observe(root, { attributes: true });
  take();
  return () => watch.disconnect();
}

// Elements of SVG and HTML, and numbers as text.

const SVG = "http://www.w3.org/2000/svg";

/** An SVG element with attributes and children, which may be text. */
export function svg(name, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, name), attributes, children);
}

/** An HTML element, the same way. */
export function html(name, attributes = {}, ...children) {
  return filled(document.createElement(name), attributes, children);
}

function filled(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined && value !== false) element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** To so many digits, without zeros behind them; a dash where there is no number. */
export function digits(value, count = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = Number(value.toPrecision(count));
  return (Math.abs(text) >= 1e7 || (text !== 0 && Math.abs(text) < 1e-4) ? text.toExponential() : String(text)).replace("-", "−");
}

/** As `digits`, but rounded up, and whole numbers in full: a need never looks smaller than it is. */
export function noLess(value, count) {
  return value > 0 ? digits(upTo(value, count), 15) : digits(value, count);
}

/** The least number of so many digits, or whole number, that is no less than a positive one. */
export function upTo(value, count) {
  const most = Math.min(Math.max(count, String(Math.trunc(value)).length), 15);
  const near = Number(value.toPrecision(most));
  const place = most - 1 - Math.floor(Math.log10(value));
  return near < value ? near + 10 ** -place : near;
}

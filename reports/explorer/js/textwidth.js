// How wide texts are, each measured once.

const MOST_WIDTHS = 5000;

const widths = new Map();
let pen = null;

/** The width of a text in pixels, set in this font. */
export function textWidth(text, font) {
  const key = `${font} ${text}`;
  if (widths.has(key)) return widths.get(key);
  if (widths.size > MOST_WIDTHS) widths.clear();
  pen ??= document.createElement("canvas").getContext("2d");
  pen.font = font;
  const { width } = pen.measureText(text);
  widths.set(key, width);
  return width;
}

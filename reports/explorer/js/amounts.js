// Needs as text, with the digits of the sentence that answers.

import { digits, noLess, upTo } from "./svg.js";
import { grouped } from "./facts.js";

const ACCURACY_DIGITS = 4;
const SPEED_DIGITS = 5;
const SHARE_DIGITS = 3;

/** A speed in a unit of `power`. */
export function powerText(speed, { short }) {
  if (short.startsWith("%")) return inPercent(speed);
  const text = noLess(speed, SPEED_DIGITS);
  return speed >= 1e4 ? grouped(Number(text)) : text;
}

/** A standard deviation. */
export function accuracyText(std) {
  return noLess(std, ACCURACY_DIGITS);
}

/** A share of all, in percent. */
export function percentText(share) {
  return share === null ? "–" : `${inPercent(percentOf(share))} %`;
}

/** Without what the product of floats adds: 110, not 110.00000000000001. */
function percentOf(share) {
  return Number((100 * share).toPrecision(15));
}

function inPercent(value) {
  if (!(value > 0)) return digits(value);
  const up = upTo(value, SHARE_DIGITS);
  const shown = { minimumSignificantDigits: SHARE_DIGITS, maximumSignificantDigits: 15, useGrouping: up >= 1e4 };
  return up.toLocaleString("en", shown);
}

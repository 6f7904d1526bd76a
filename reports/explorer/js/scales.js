// Scales: from values to pixels and back, and where their ticks are.

const SUPERSCRIPT = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const TICK_LEADS = [[1, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 5], [1, 3], [1]];
const DECADES_APART = [2, 3, 4, 6, 10, 20, 50, 100];
const FEWEST_TICKS = 3;
const MOST_MINOR = 8;
const TICK_ROUNDING = 1e-9;

/** The least and the greatest number of lists, which may hold nulls, or null where they hold none. */
export function extent(...lists) {
  let [low, high] = [Infinity, -Infinity];
  for (const values of lists) {
    for (const value of values) {
      if (!Number.isFinite(value)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : null;
}

/** A scale with the same length for the same difference. The domain may be null, or be one number twice: it is
 *  widened then. Of what is no number it gives null. `invert`: the value at a pixel; `ticks(count)`: at most about so
 *  many round values. */
export function linear(domain, range) {
  const [low, high] = widened(domain);
  const [from, to] = range;
  const scale = (value) => (Number.isFinite(value) ? from + ((value - low) / (high - low)) * (to - from) : null);
  scale.invert = (pixel) => (from === to ? low : low + ((pixel - from) / (to - from)) * (high - low));
  scale.ticks = (count = 5) => ticks(low, high, count);
  scale.minor = () => [];
  scale.domain = [low, high];
  scale.range = range;
  return scale;
}

/** A scale with the same length for the same ratio: of what is not above zero it gives null. `minor`: where ticks
 *  without a number go. */
export function logarithmic(domain, range) {
  const [low, high] = widenedByRatio(domain);
  const [from, to] = range;
  const [first, length] = [Math.log(low), Math.log(high) - Math.log(low)];
  const scale = (value) =>
    Number.isFinite(value) && value > 0 ? from + ((Math.log(value) - first) / length) * (to - from) : null;
  scale.invert = (pixel) => (from === to ? low : Math.exp(first + ((pixel - from) / (to - from)) * length));
  scale.ticks = (count = 5) => logarithmicTicks(low, high, count);
  scale.minor = (count = 5) => minorTicks(low, high, scale.ticks(count));
  scale.domain = [low, high];
  scale.range = range;
  return scale;
}

function widened(domain) {
  const [low, high] = extent(domain ?? []) ?? [0, 1];
  if (low < high) return [low, high];
  const by = Math.abs(low) * 0.1 || 1;
  return [low - by, low + by];
}

function widenedByRatio(domain) {
  const [low, high] = extent((domain ?? []).filter((value) => value > 0)) ?? [1, 10];
  return low < high ? [low, high] : [low / 2, low * 2];
}

/** The multiples of 1, 2 or 5 times a power of ten from `low` to `high`: as many as there are with at most `count`
 *  intervals. */
export function ticks(low, high, count = 5) {
  const least = (high - low) / Math.max(count, 1);
  if (!(least > 0) || !Number.isFinite(least)) return [];
  let power = Math.floor(Math.log10(least)) - 1;
  const fits = (factor) => factor * 10 ** power >= least * (1 - TICK_ROUNDING);
  let factor;
  while ((factor = [1, 2, 5].find(fits)) === undefined) power += 1;
  const step = factor * 10 ** power;
  const last = Math.floor(high / step + TICK_ROUNDING);
  const found = [];
  for (let number = Math.ceil(low / step - TICK_ROUNDING); number <= last; number += 1) {
    found.push(Number(`${number * factor}e${power}`));
  }
  return found.filter((value, index) => value !== found[index - 1]);
}

function logarithmicTicks(low, high, count) {
  const spans = [...TICK_LEADS.map((leads) => [leads, 1]), ...DECADES_APART.map((every) => [[1], every])];
  const found = spans.map(([leads, every]) => multiples(low, high, leads, every));
  const fitting = found.find((each) => each.length <= count + 1);
  const even = ticks(low, high, count);
  return fitting.length >= Math.min(FEWEST_TICKS, even.length) ? fitting : even;
}

function minorTicks(low, high, major) {
  const leads = Math.log10(high / low) <= MOST_MINOR ? TICK_LEADS[0] : [1];
  return multiples(low, high, leads, 1).filter((value) => !major.includes(value));
}

/** These leads times every so many powers of ten. */
function multiples(low, high, leads, every) {
  const found = [];
  for (let power = Math.floor(Math.log10(low)) - 1; power <= Math.log10(high) + 1; power += 1) {
    if (power % every === 0) found.push(...leads.map((lead) => Number(`${lead}e${power}`)));
  }
  return found.filter((value) => value >= low * (1 - TICK_ROUNDING) && value <= high * (1 + TICK_ROUNDING));
}

/** A tick's number: with commas, as a power of ten where it is very large or small, with a minus sign. */
export function tickText(value) {
  const size = Math.abs(value);
  const plain = size === 0 || (size >= 1e-3 && size < 1e6);
  const text = plain ? size.toLocaleString("en", { maximumSignificantDigits: 15 }) : inPowers(size);
  return value < 0 ? `−${text}` : text;
}

function inPowers(size) {
  const [lead, power] = size.toExponential().split("e");
  const raised = [...String(Math.abs(power))].map((digit) => SUPERSCRIPT[digit]).join("");
  return `${lead === "1" ? "" : `${lead}·`}10${power < 0 ? "⁻" : ""}${raised}`;
}

// The query of a link is the design, its fragment the pinned ones; and a design in steps or in hertz and milliseconds.

/** The pairs of a query, a Map of key to text. */
export function queryOf(text) {
  return new Map(new URLSearchParams(text));
}

/** The query as a link has it. */
export function textOf(query) {
  return new URLSearchParams([...query]).toString().replaceAll("%2F", "/").replaceAll("%3A", ":");
}

/** The query with some keys changed; null or no text takes a key out. */
export function changedQuery(query, changes) {
  const next = new Map(query);
  for (const [key, value] of Object.entries(changes)) {
    if (value === null || value === "") next.delete(key);
    else next.set(key, value);
  }
  return next;
}

const TIME_KEYS = ["measurement_hz", "delay_ms", "land_within_ms"];

/** In what a query speaks: "times" or "steps". */
export function modeOf(query) {
  if (TIME_KEYS.some((key) => query.has(key))) return "times";
  return query.has("N") || query.has("M") ? "steps" : "times";
}

/** The same design in steps. `design`: that of the view, in which steps are known. */
export function asSteps(query, design) {
  const L = query.has("land_within_ms") || query.has("L") ? String(design.L) : null;
  const steps = { N: String(design.N), M: design.M === null ? null : String(design.M), L };
  return changedQuery(query, { ...steps, measurement_hz: null, delay_ms: null, land_within_ms: null });
}

/** The same design in hertz and milliseconds, at a loop rate of 400 Hz where none is known. */
export function asTimes(query, design) {
  const hr = design.hr_hz ?? "400";
  const times = { hr_hz: hr, measurement_hz: design.measurement_hz ?? perStep(hr, design.N), N: null, M: null };
  if (design.M !== null) times.delay_ms = design.delay_ms ?? stepsInMs(design.M, hr);
  return changedQuery(query, times);
}

/** The rate of what happens every `steps` steps of a loop of `hr` hertz, exact. */
export function perStep(hr, steps) {
  const [over, under] = ratio(hr);
  return ratioText(over, under * BigInt(steps));
}

/** So many steps of a loop of `hr` hertz in milliseconds, exact. */
export function stepsInMs(steps, hr) {
  const [over, under] = ratio(hr);
  return ratioText(BigInt(steps) * 1000n * under, over);
}

function ratio(text) {
  const [over, under = "1"] = text.split("/").map((part) => part.trim());
  const [a, b] = [over, under].map(decimalRatio);
  return [a[0] * b[1], a[1] * b[0]];
}

function decimalRatio(text) {
  const [digits, exponent = "0"] = text.toLowerCase().split("e");
  const [whole, part = ""] = digits.split(".");
  const tens = Number(exponent) - part.length;
  return [BigInt(whole + part) * 10n ** BigInt(Math.max(tens, 0)), 10n ** BigInt(Math.max(-tens, 0))];
}

function ratioText(over, under) {
  for (let places = 0; places <= 6; places += 1) {
    if ((over * 10n ** BigInt(places)) % under === 0n) {
      const text = String((over * 10n ** BigInt(places)) / under).padStart(places + 1, "0");
      return places ? `${text.slice(0, -places)}.${text.slice(-places)}` : text;
    }
  }
  const common = commonDivisor(over, under);
  return `${over / common}/${under / common}`;
}

function commonDivisor(a, b) {
  return b === 0n ? a : commonDivisor(b, a % b);
}

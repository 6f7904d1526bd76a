// Where a slider stops: values as people write them, within limits.

/** Every whole number from first to last; where there are many, those of three digits. */
export function wholeStops(first, last) {
  if (last - first <= 400) return Array.from({ length: Math.max(last - first, 0) + 1 }, (_, i) => first + i);
  return roundStops(first, last, 2).filter((value) => Number.isInteger(value));
}

/** Numbers of so many digits from first to last, both positive, and these two: evenly spaced in a logarithm, nearly. */
export function roundStops(first, last, count = 2) {
  const found = [first];
  for (let tens = Math.floor(Math.log10(first)); 10 ** tens <= last; tens += 1) {
    for (let lead = 10 ** (count - 1); lead < 10 ** count; lead += 1) {
      const value = Number(`${lead}e${tens - count + 1}`);
      if (value > first && value < last) found.push(value);
    }
  }
  return last > first ? [...found, last] : found;
}

/** Some two hundred from first to last, evenly spaced at multiples of 1, 2 or 5 times a power of ten; and these two. */
export function evenStops(first, last) {
  if (last <= first) return [first];
  const rough = (last - first) / 200;
  const tens = Math.floor(Math.log10(rough));
  const lead = [1, 2, 5, 10].find((factor) => factor * 10 ** tens >= rough * (1 - 1e-9));
  const step = (index) => Number(`${index * lead}e${tens}`);
  const found = [first];
  for (let index = Math.ceil(first / step(1)); step(index) < last; index += 1) {
    if (step(index) > first) found.push(step(index));
  }
  return [...found, last];
}

/** Rounded to so many decimals, down or up, so that a limit is kept. */
export function roundedTo(value, places, round) {
  const scaled = value * 10 ** places;
  const near = Math.round(scaled);
  return Number(`${Math.abs(scaled - near) < 1e-6 ? near : round(scaled)}e-${places}`);
}

/** The place in `stops` of what is nearest to a value. */
export function stopNear(stops, value) {
  let best = 0;
  stops.forEach((stop, index) => {
    if (Math.abs(stop - value) < Math.abs(stops[best] - value)) best = index;
  });
  return best;
}

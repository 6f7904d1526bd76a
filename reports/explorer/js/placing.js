// Where labels go on a line so that none covers another.

/** New centres, as near the wished ones, which ascend, as can be (least squares), `gap` apart and in [low, high]. */
export function spread(centres, widths, low, high, gap) {
  if (!centres.length) return [];
  const offsets = [0];
  for (let at = 1; at < widths.length; at += 1) offsets.push(offsets[at - 1] + (widths[at - 1] + widths[at]) / 2 + gap);
  const blocks = []; // labels that touch: mean of (wished - offset), how many
  centres.forEach((centre, index) => {
    let [mean, count] = [centre - offsets[index], 1];
    while (blocks.length && blocks[blocks.length - 1][0] > mean) {
      const [before, more] = blocks.pop();
      [mean, count] = [(before * more + mean * count) / (more + count), more + count];
    }
    blocks.push([mean, count]);
  });
  const least = low + widths[0] / 2;
  const most = high - widths[widths.length - 1] / 2 - offsets[offsets.length - 1];
  const shifts = blocks.flatMap(([mean, count]) => Array(count).fill(Math.min(Math.max(mean, least), most)));
  return shifts.map((shift, index) => shift + offsets[index]);
}

/** The farthest that a label stands from where it was wished. */
export function worstShift(centres, placed) {
  return Math.max(0, ...centres.map((centre, index) => Math.abs(centre - placed[index])));
}

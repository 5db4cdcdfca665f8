// Numbers for axes: round places, short words.

/** About `count` round numbers between lo and hi. */
export function ticks(lo, hi, count = 5) {
  if (!(hi > lo)) return [lo];
  const rough = (hi - lo) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((k) => k * power >= rough * 0.999) * power;
  const found = [];
  for (let k = Math.ceil(lo / step - 1e-9); k * step <= hi + 1e-9 * step; k++) found.push(k * step);
  return found;
}

/** Powers of ten between lo and hi (both > 0), at most `count`; round numbers where there is less than one decade. */
export function powers(lo, hi, count = 5) {
  const first = Math.ceil(Math.log10(lo) - 1e-9);
  const last = Math.floor(Math.log10(hi) + 1e-9);
  if (last <= first) return ticks(lo, hi, 3).filter((value) => value > 0);
  const stride = Math.ceil((last - first + 1) / count);
  const found = [];
  for (let k = first; k <= last; k += stride) found.push(10 ** k);
  return found;
}

/** A number in few characters: 0.12, 1300, 2.5e−6; "–" for none. */
export function short(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size < 1e-300) return "0";
  const plain = size >= 1e-3 && size < 1e5;
  const text = plain ? String(Number(value.toPrecision(Math.max(digits, size >= 1e3 ? 5 : 0)))) : tens(value, digits);
  return text.replaceAll("-", "−");
}

/** Mantissa and exponent. */
function tens(value, digits) {
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return `${Number(mantissa)}e${Number(exponent)}`;
}

/** Large counts: 1.3 M, 820 k. */
export function count(value) {
  if (value === null || value === undefined) return "–";
  if (value >= 1e6) return `${short(value / 1e6)} M`;
  return value >= 1e4 ? `${short(value / 1e3)} k` : short(value);
}

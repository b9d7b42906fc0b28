/** What stands in a table where a figure is missing. */
const MISSING = '–';

function isNumber(value) {
  return typeof value === 'number' && Number.isFinite(value);
}

/** A value from outside as a list. */
function list(value) {
  return Array.isArray(value) ? value : [];
}

/** The largest of numbers; spreading into Math.max would overflow the stack at a million. */
function largest(numbers) {
  return list(numbers).reduce((most, value) => (isNumber(value) && value > most ? value : most), 0);
}

function total(numbers) {
  return list(numbers).reduce((sum, value) => sum + (isNumber(value) ? value : 0), 0);
}

function median(numbers) {
  const sorted = list(numbers).filter(isNumber).sort((a, b) => a - b);
  return sorted.length === 0 ? null : sorted[sorted.length >> 1];
}

/** A number with thousands separators and a fixed number of decimals. */
function decimal(value, digits = 0) {
  if (!isNumber(value)) return MISSING;
  const text = value.toLocaleString('en-US', {
    minimumFractionDigits: digits, maximumFractionDigits: digits,
  });
  return text.replace('-', '\u2212');
}

/** A number with three significant digits, for values whose magnitude isn't known in advance. */
function significant(value, digits = 3) {
  if (!isNumber(value)) return MISSING;
  if (value !== 0 && (Math.abs(value) < 1e-4 || Math.abs(value) >= 1e9)) {
    return value.toExponential(digits - 1).replaceAll('-', '\u2212');
  }
  return value.toLocaleString('en-US', { maximumSignificantDigits: digits })
    .replace('-', '\u2212');
}

function signed(value, digits) {
  return (value > 0 ? '+' : '') + decimal(value, digits);
}

/** A number with its unit, or null if there is no number. */
function measure(value, digits, unit) {
  return isNumber(value) ? `${decimal(value, digits)}\u00a0${unit}` : null;
}

function percent(share, digits = 0) {
  return isNumber(share) ? measure(share * 100, digits, '%') : null;
}

function duration(seconds) {
  if (!isNumber(seconds)) return null;
  if (seconds < 0.995) return measure(seconds, 2, 's');
  if (seconds < 9.95) return measure(seconds, 1, 's');
  if (seconds < 119.5) return measure(seconds, 0, 's');
  const minutes = Math.floor(seconds / 60);
  if (minutes < 60) return `${minutes}\u00a0min ${Math.round(seconds) % 60}\u00a0s`;
  return `${decimal(Math.floor(minutes / 60))}\u00a0h ${minutes % 60}\u00a0min`;
}

function byteCount(bytes) {
  if (!isNumber(bytes)) return null;
  const [size, unit] = [[1e9, 'GB'], [1e6, 'MB'], [1e3, 'kB']].find(([size]) => bytes >= size)
    ?? [1, 'bytes'];
  return measure(bytes / size, bytes / size < 9.95 && size > 1 ? 1 : 0, unit);
}

function plural(count, noun, nouns = `${noun}s`) {
  return `${decimal(count)} ${count === 1 ? noun : nouns}`;
}

/** `pointCloudGeneration` as "Point cloud generation", for names that the page doesn't know. */
function wordsOf(identifier) {
  const words = String(identifier).replace(/([a-z\d])([A-Z])/g, '$1 $2').toLowerCase();
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** The bytes of a base64 string; none if it isn't valid. */
function decodedBytes(text) {
  if (typeof text !== 'string') return new Uint8Array();
  try {
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
    const binary = atob(text);
    return Uint8Array.from(binary, (character) => character.charCodeAt(0));
  } catch {
    return new Uint8Array();
  }
}

/**
 * A typed array from base64 (little-endian, as all machines that run browsers are), cut to whole
 * elements.
 *
 * @param {Function} Type for instance `Uint16Array`
 */
function decodedArray(Type, text) {
  const bytes = decodedBytes(text);
  return new Type(bytes.buffer, 0, Math.floor(bytes.length / Type.BYTES_PER_ELEMENT));
}

/** The outlines of a mask as `points` of SVG polygons in a picture of `width` × `height`. */
function decodedOutlines(texts, width, height) {
  return list(texts).map((text) => {
    const values = decodedArray(Uint16Array, text);
    const points = [];
    for (let i = 0; i + 1 < values.length; i += 2) {
      const x = (values[i] / 65535) * width;
      const y = (values[i + 1] / 65535) * height;
      points.push(`${x.toFixed(1)},${y.toFixed(1)}`);
    }
    return points.join(' ');
  });
}

/** Residuals as {x, y} in shares of the picture, and {dx, dy} in pixels of the full-size photo. */
function decodedResiduals(text) {
  const unsigned = decodedArray(Uint16Array, text);
  const signed = new Int16Array(unsigned.buffer, 0, unsigned.length);
  const residuals = [];
  for (let i = 0; i + 3 < unsigned.length; i += 4) {
    residuals.push({
      x: unsigned[i] / 65535, y: unsigned[i + 1] / 65535,
      dx: signed[i + 2] / 100, dy: signed[i + 3] / 100,
    });
  }
  return residuals;
}

/** A decoded picture, or null if there is none or it is damaged. */
async function decodedPicture(address) {
  if (!isPicture(address)) return null;
  const image = new Image();
  image.src = address;
  return image.decode().then(() => image, () => null);
}

/** Only pictures that lie in the page itself: nothing is loaded from elsewhere. */
function isPicture(address) {
  return typeof address === 'string' && address.startsWith('data:image/');
}

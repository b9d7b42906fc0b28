/**
 * The photo that all parts of the page show as selected.
 *
 * @param {PhotoRecord[]} photos
 */
function makeSelection(photos) {
  const listeners = [];
  let current = photos.find((photo) => photo.isUsed && photo.picture)
    ?? photos.find((photo) => photo.picture) ?? photos[0] ?? null;
  return {
    get photo() { return current; },
    select(photo) {
      if (!photo || photo === current) return;
      current = photo;
      for (const listener of listeners) listener(photo);
    },
    /** Calls the listener now, and again with each change. */
    follow(listener) {
      listeners.push(listener);
      if (current) listener(current);
    },
  };
}

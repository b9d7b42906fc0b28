/**
 * The photos of the report, joined with their pictures, cameras and poses.
 *
 * @typedef {Object} PhotoRecord the fields of report.json and
 * @property {number} index position in the report
 * @property {boolean} isUsed whether the model was made with it
 * @property {boolean} isPlanned whether there was no run yet
 * @property {?Object} picture thumbnail, outlines and residuals
 * @property {?Object} lens refined camera
 * @property {?{position: number[], axes: number[][]}} pose
 */
function photoRecords(report, material) {
  const pictures = list(material.photos);
  const cameras = list(report.cameras);
  return list(report.photos).map((photo, index) => ({
    ...photo,
    index,
    name: String(photo?.name ?? `Photo ${index + 1}`),
    isUsed: photo?.status === 'registered',
    isPlanned: report.verdict?.level === 'unknown',
    picture: isPicture(pictures[index]?.picture) ? pictures[index] : null,
    lens: lensOf(cameras[photo?.camera], photo),
    pose: poseOf(photo),
  }));
}

/** Focal length, principal point and distortion, or the guess of a phone's wide lens. */
function lensOf(camera, photo) {
  const width = camera?.width ?? photo?.width;
  const height = camera?.height ?? photo?.height;
  if (!isNumber(width) || !isNumber(height) || width <= 0 || height <= 0) return null;
  const known = camera?.refined ?? camera?.initial ?? {};
  const numbers = (values, count) => {
    const given = list(values).slice(0, count);
    return given.length === count && given.every(isNumber) ? given : null;
  };
  const guess = 0.8 * Math.max(width, height);
  return {
    width, height,
    focalLength: numbers(known.focalLength, 2) ?? [guess, guess],
    principalPoint: numbers(known.principalPoint, 2) ?? [width / 2, height / 2],
    distortion: numbers(known.distortion, 4) ?? [0, 0, 0, 0],
  };
}

/** The camera's center and its axes (right, down, forward) in the world. */
function poseOf(photo) {
  const position = list(photo?.position);
  const rotation = list(photo?.rotation);
  const isComplete = position.length === 3 && rotation.length === 4
    && position.every(isNumber) && rotation.every(isNumber) && Math.hypot(...rotation) > 0;
  if (!isComplete) return null;
  const length = Math.hypot(...rotation);
  const [w, x, y, z] = rotation.map((value) => value / length);
  return {
    position,
    axes: [
      [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
      [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
      [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
    ],
  };
}

/**
 * The compared pairs of photos. `needed` is 0 for a pair that is used; otherwise it has fewer
 * matches than that.
 */
function pairRecords(report, photos) {
  const columns = report.matches?.pairs;
  if (!columns) return [];
  const byName = new Map(photos.map((photo) => [photo.name, photo]));
  const names = list(report.matches.photos);
  const photoAt = (index) => (names.length > 0 ? byName.get(names[index]) : photos[index]);
  return list(columns.first).map((first, i) => ({
    first: photoAt(first),
    second: photoAt(columns.second?.[i]),
    matches: columns.matches?.[i] ?? 0,
    needed: columns.needed?.[i] ?? 0,
    degrees: columns.degrees?.[i],
  })).filter((pair) => pair.first && pair.second && pair.first !== pair.second);
}

/** For each photo, its pairs that are used, the one with the most matches first. */
function partnersOf(photos, pairs) {
  const partners = photos.map(() => []);
  for (const pair of pairs) {
    if (pair.needed > 0) continue;
    partners[pair.first.index].push({ photo: pair.second, matches: pair.matches });
    partners[pair.second.index].push({ photo: pair.first, matches: pair.matches });
  }
  for (const each of partners) each.sort((a, b) => b.matches - a.matches);
  return partners;
}

/** Places from which photos are missing, of one piece of advice. */
function placesOf(advice) {
  const isPoint = (point) => list(point).length === 3 && point.every(isNumber);
  return list(advice?.places).filter((place) => isPoint(place?.position) && isPoint(place?.target));
}

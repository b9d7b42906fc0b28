/** The cameras: what was assumed before the run, and what it found. */
function camerasSection(report) {
  const cameras = list(report.cameras).filter((camera) => camera?.initial || camera?.refined);
  return section('cameras', 'Cameras',
    'The lens as it was assumed, and as the photos show it. A focal length that changes by more '
    + 'than a few percent means that the assumption was poor or the photos leave it open.',
    cameras.length > 0 && scroller('Table of cameras', cameras.map(cameraTable)));
}

function cameraTable(camera, index) {
  const rows = cameraRows(camera.initial ?? {}, camera.refined ?? {});
  const source = { exif: 'from the photo’s metadata', assumed: 'assumed' }[camera.initial?.source];
  const head = (text, className) => element('th', { scope: 'col', class: className }, text);
  return element('table', {},
    element('caption', {}, `Camera ${index + 1}: ${decimal(camera.width)} × `
      + `${decimal(camera.height)} px, ${plural(camera.photos ?? 0, 'photo')}`),
    element('thead', {}, element('tr', {}, head('Parameter'),
      head(source ? `Initial (${source})` : 'Initial', 'number'), head('Refined', 'number'),
      head('Change', 'number'))),
    element('tbody', {}, rows.map(({ name, digits, initial, refined, change }) => element('tr', {},
      element('th', { scope: 'row' }, name),
      element('td', { class: 'number' }, decimal(initial, initial === 0 ? 0 : digits)),
      element('td', { class: 'number' }, decimal(refined, refined === 0 ? 0 : digits)),
      element('td', { class: 'number' }, change)))));
}

/** Lengths change in percent; distortion is often 0 at first, so that its difference is shown. */
function cameraRows(initial, refined) {
  const row = (name, key, index, digits, isRelative) => {
    const [before, after] = [initial[key]?.[index], refined[key]?.[index]];
    const isKnown = isNumber(before) && isNumber(after);
    let change = MISSING;
    if (isKnown && before === after) change = 'none';
    else if (isKnown && isRelative && before !== 0) {
      change = `${signed((after / before - 1) * 100, 2)}\u00a0%`;
    } else if (isKnown) change = signed(after - before, digits);
    return { name, digits, initial: before, refined: after, change };
  };
  const isSquare = [initial, refined].every(({ focalLength }) =>
    list(focalLength)[0] === list(focalLength)[1]);
  return [
    ...(isSquare ? [row('Focal length, px', 'focalLength', 0, 1, true)] : [
      row('Focal length across, px', 'focalLength', 0, 1, true),
      row('Focal length down, px', 'focalLength', 1, 1, true)]),
    row('Middle of the lens, x, px', 'principalPoint', 0, 1, true),
    row('Middle of the lens, y, px', 'principalPoint', 1, 1, true),
    row('Radial distortion k1', 'distortion', 0, 4),
    row('Radial distortion k2', 'distortion', 1, 4),
    row('Tilt of the lens p1', 'distortion', 2, 5),
    row('Tilt of the lens p2', 'distortion', 3, 5),
  ].filter((each) => isNumber(each.initial) || isNumber(each.refined));
}

/** From where the photos look at the object: azimuth around, elevation toward the middle. */
function directionsChart(page) {
  const { photos, selection, report } = page;
  const posed = photos.filter((photo) => photo.pose);
  if (posed.length === 0) return null;
  const center = objectCenter(page, posed);
  const polar = (point) => {
    const [x, y, z] = point.map((value, i) => value - center[i]);
    return { azimuth: Math.atan2(x, z), elevation: Math.atan2(y, Math.hypot(x, z)) };
  };
  const places = list(report.advice).flatMap(placesOf);
  const lowest = Math.min(...[...posed.map((photo) => photo.pose.position),
    ...places.map((place) => place.position)].map((point) => polar(point).elevation));
  // Rings down to the horizon always, and below it only if somebody looks from there.
  const floor = Math.min(0, Math.floor((lowest * 6) / Math.PI) * 30);
  const radius = 150;
  const at = ({ azimuth, elevation }) => {
    const distance = (radius * (90 - (elevation * 180) / Math.PI)) / (90 - floor);
    return [distance * Math.sin(azimuth), distance * Math.cos(azimuth)];
  };
  const size = posed.length > 200 ? 2.5 : 5;
  const dots = posed.map((photo) =>
    directionDot(photo, at(polar(photo.pose.position)), size, selection));
  const ghosts = places.map((place) => {
    const [x, y] = at(polar(place.position));
    return drawing('path', { class: 'place', d: `M${x} ${y - 6}l6 10h-12z` },
      drawing('title', {}, 'A photo from here is missing'));
  });
  selection.follow((photo) => dots.forEach((dot, i) =>
    dot.classList.toggle('selected', posed[i] === photo)));
  const sentence = 'The object seen from above: the middle is straight from above, the outer ring '
    + `${floor < 0 ? 'from below' : 'level with the object'}. Large gaps are sides without photos.`;
  return element('figure', { class: 'chart' },
    element('figcaption', {}, element('h3', {}, 'Directions of the photos'),
      element('p', {}, sentence)),
    drawing('svg', { id: 'directions', viewBox: '-180 -172 360 344', role: 'img',
      'aria-label': `Directions of ${posed.length} photos about the object. ${sentence}` },
    directionRings(floor, radius), dots, ghosts),
    element('p', { class: 'swatches' },
      element('span', { class: 'swatch' }, element('i', { class: 'dot' }), 'photo'),
      places.length > 0 && element('span', { class: 'swatch' },
        element('i', { class: 'triangle' }, '▲'), 'suggested photo')));
}

/** The center of the model; without a model, of what the cameras look at. */
function objectCenter(page, posed) {
  const bounds = page.view?.scene?.parts.surface?.bounds;
  if (bounds) return bounds.center;
  const model = page.material.model ?? page.material.points?.sparse;
  if (list(model?.origin).length === 3 && isNumber(model.size)) {
    return [model.origin[0] + model.size / 2, model.origin[1] + model.size / 2,
      model.origin[2] + model.size / 2];
  }
  const mean = (i) => total(posed.map((photo) => photo.pose.position[i])) / posed.length;
  return [mean(0), 0, mean(2)];
}

function directionDot(photo, [x, y], r, selection) {
  return drawing('circle', { class: 'dot', cx: x.toFixed(1), cy: y.toFixed(1), r,
    onclick: () => selection.select(photo) }, drawing('title', {}, photo.name));
}

function directionRings(floor, radius) {
  const parts = [];
  for (let elevation = 60; elevation >= floor; elevation -= 30) {
    const r = (radius * (90 - elevation)) / (90 - floor);
    parts.push(drawing('circle', { class: elevation === 0 ? 'rule strong' : 'rule', r }),
      drawing('text', { class: 'tick halo', x: r * Math.sin(2.88), y: r * Math.cos(2.88) + 4 },
        `${decimal(elevation)}°`));
  }
  for (let i = 0; i < 12; i += 1) {
    const [x, y] = [Math.sin((i * Math.PI) / 6), Math.cos((i * Math.PI) / 6)];
    parts.unshift(drawing('line', { class: 'rule', x1: 0, y1: 0, x2: x * radius, y2: y * radius }));
    if (i % 3 === 0) {
      parts.push(drawing('text', { class: 'tick', x: x * (radius + 17), y: y * (radius + 13) + 4 },
        `${i * 30}°`));
    }
  }
  return parts;
}

/** The selected photo, large: with its mask, its errors and the maps of the surface over it. */
function pictureView(page) {
  const { photos, selection } = page;
  if (!photos.some((photo) => photo.picture)) return null;
  const stage = element('div', { class: 'picture-stage' });
  const facts = element('div', { class: 'picture-facts' });
  const caption = element('p', { id: 'picture-caption', class: 'hint', 'aria-live': 'polite' });
  const controls = pictureControls(page, () => show(selection.photo));
  const step = (by) => {
    const count = photos.length;
    selection.select(photos[(selection.photo.index + by + count) % count]);
  };
  const view = element('div', { id: 'picture', class: 'picture', tabindex: 0, role: 'group',
    'aria-label': 'Selected photo; the left and right arrow keys change it' },
  element('div', { class: 'picture-head' },
    element('h3', { id: 'picture-name' }),
    element('div', { class: 'steps' },
      element('button', { type: 'button', id: 'photo-previous', onclick: () => step(-1) },
        '← Previous'),
      element('button', { type: 'button', id: 'photo-next', onclick: () => step(1) }, 'Next →'))),
  element('div', { class: 'picture-body' },
    element('div', {}, stage, caption), element('div', {}, controls.element, facts)));
  view.addEventListener('keydown', (event) => {
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!by || event.target !== view) return;
    event.preventDefault();
    step(by);
  });
  function show(photo) {
    view.querySelector('h3').replaceChildren(nameElement(photo));
    const layers = pictureLayers(page, photo, controls);
    stage.replaceChildren(...layers.elements);
    caption.textContent = layers.sentence;
    facts.replaceChildren(...pictureFacts(page, photo));
  }
  selection.follow(show);
  page.showPicture = () => show(selection.photo);
  return view;
}

/** Check boxes for outline and errors, and the choice of a map with its opacity. */
function pictureControls(page, changed) {
  const { photos } = page;
  const checkbox = (id, text, isPossible) => isPossible && element('label', {},
    element('input', { type: 'checkbox', id, checked: true, onchange: changed }), text);
  const maps = page.view?.scene?.parts.surface?.maps ?? [];
  const canProject = maps.length > 0 && photos.some((photo) => photo.pose);
  const choose = () => {
    opacityLabel.hidden = select.value === '';
    changed();
  };
  const select = canProject && element('select', { id: 'picture-map', onchange: choose },
    element('option', { value: '' }, 'Nothing'),
    maps.map((map) => element('option', { value: map.key }, map.name)));
  const opacity = canProject && element('input', {
    type: 'range', id: 'picture-opacity', min: 0, max: 100, value: 75,
    oninput: (event) => {
      const canvas = document.getElementById('picture-projection');
      if (canvas) canvas.style.opacity = event.target.value / 100;
    },
  });
  const opacityLabel = opacity && element('label', { class: 'field', hidden: true },
    'Opacity of the map', opacity);
  const form = element('fieldset', {}, element('legend', {}, 'Over the photo'),
    checkbox('picture-outline', 'Outline of the object',
      photos.some((photo) => list(photo.picture?.outlines).length > 0)),
    checkbox('picture-residuals', 'Errors of the points',
      photos.some((photo) => photo.picture?.residuals)),
    select && element('label', { class: 'field' }, 'Map of the surface', select),
    opacityLabel);
  const isChecked = (id) => form.querySelector(`#${id}`)?.checked ?? false;
  return {
    element: form.children.length > 1 ? form : null,
    get showsOutline() { return isChecked('picture-outline'); },
    get showsResiduals() { return isChecked('picture-residuals'); },
    get map() { return maps.find((map) => map.key === select.value) ?? null; },
    get opacity() { return opacity ? opacity.value / 100 : 1; },
  };
}

function pictureLayers(page, photo, controls) {
  if (!photo.picture) {
    return { elements: [thumbnail(photo)], sentence: 'The report has no picture of this photo.' };
  }
  const { picture, width = 4, height = 3 } = photo.picture;
  const elements = [element('img', {
    id: 'picture-image', src: picture, width, height, alt: `The photo ${photo.name}`,
  })];
  const sentences = [];
  if (controls.map) {
    const canvas = projectedMap(page, photo, controls.map, width, height);
    if (canvas) {
      canvas.style.opacity = controls.opacity;
      elements.push(canvas, mapLegend(controls.map));
    } else {
      sentences.push('The position of this photo is unknown, so the surface can’t be drawn on it.');
    }
  }
  if (controls.showsOutline && list(photo.picture.outlines).length > 0) {
    elements.push(outlineDrawing(photo.picture));
  }
  const residuals = controls.showsResiduals ? decodedResiduals(photo.picture.residuals) : [];
  if (residuals.length > 0) {
    const factor = residualFactor(residuals, photo);
    elements.push(residualDrawing(residuals, photo, factor));
    const isPart = isNumber(photo.observations) && residuals.length < photo.observations;
    sentences.push(`Lines: the errors of ${isPart ? 'the ' : ''}${decimal(residuals.length)} points`
      + `${isPart ? ` with the largest errors, of ${decimal(photo.observations)}` : ''}, drawn `
      + `${decimal(factor)} times as long as they are. Long lines side by side in one direction `
      + 'mean that the camera or the object moved.');
  }
  return { elements, sentence: sentences.join(' ') };
}

/** The round factor that makes large errors about 4 % of the photo's width long. */
function residualFactor(residuals, photo) {
  const lengths = residuals.map(({ dx, dy }) => Math.hypot(dx, dy)).sort((a, b) => a - b);
  const long = lengths[Math.floor(lengths.length * 0.9)] || 1;
  const wanted = ((photo.width ?? photo.picture.width) * 0.04) / long;
  const factors = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  return factors.findLast((factor) => factor <= wanted) ?? 1;
}

function residualDrawing(residuals, photo, factor) {
  const width = photo.width ?? photo.picture.width;
  const height = photo.height ?? photo.picture.height;
  const number = (value) => value.toFixed(1);
  const path = residuals.map(({ x, y, dx, dy }) =>
    `M${number(x * width)} ${number(y * height)}l${number(dx * factor)} ${number(dy * factor)}`);
  const svg = (className) => drawing('path', { class: className, d: path.join('') });
  return drawing('svg', {
    class: 'residuals', viewBox: `0 0 ${width} ${height}`, 'aria-hidden': 'true',
  }, svg('halo'), svg('line'));
}

/** Words and figures of the photo, and the photos with which it shares the most. */
function pictureFacts(page, photo) {
  const size = isNumber(photo.width) && isNumber(photo.height)
    ? `${decimal(photo.width)} × ${decimal(photo.height)} px` : null;
  const figures = PHOTO_COLUMNS.filter(({ key }) => isNumber(photo[key]));
  const partners = page.partners[photo.index];
  return [
    element('p', { class: 'reason' }, statusBadge(photo),
      photo.reason && element('span', {}, ` ${photo.reason}`)),
    figureList([['Size', size], ...figures.map(({ key, title, unit, text }) =>
      [title, `${text(photo[key])}${unit ? `\u00a0${unit}` : ''}`])], 'facts'),
    partners.length > 0 && element('h4', {}, 'Shares the most matches with'),
    photoButtons(partners.slice(0, 4).map((partner) => partner.photo), page.selection),
  ].filter(Boolean);
}

/** Names of the ways to color the surface that aren't maps. */
const SURFACE_NAMES = {
  texture: 'Texture', colors: 'Colors', shape: 'Shape only', wireframe: 'Wireframe',
};

/** The section with the 3-D view; null if the page has nothing to show in it. */
function modelSection(page) {
  const view = sceneView(page);
  if (!view) return null;
  page.view = view;
  return section('model', 'The model and the cameras',
    view.isFlat ? null : 'Drag to turn, click a camera to see its photo.', view.element);
}

/**
 * The 3-D view with its controls, or still pictures where there is no WebGL.
 *
 * @returns {?{element: Element, ready: Promise, isFlat: boolean}}
 */
function sceneView(page) {
  const canvas = element('canvas', {
    id: 'view', tabindex: 0, role: 'img', 'aria-describedby': 'view-keys',
    'aria-label': page.isViewer ? '3-D view of the model' : '3-D view of the model and the cameras',
  });
  const scene = makeScene(page, canvas);
  if (!scene) return stillPictures(page);
  const legend = element('div', { id: 'legend', hidden: true, 'aria-live': 'polite' });
  const select = colorSelect(scene, legend);
  const copy = element('canvas', { id: 'view-copy', 'aria-hidden': 'true' });
  followPrinting(scene, copy);
  page.selection.follow(scene.mark);
  followTheme(scene.mark);
  const viewport = element('div', { class: 'viewport' }, canvas, copy, legend, viewTools(scene));
  const panel = element('div', { class: 'panel' },
    select && element('label', { class: 'field' }, 'Color by', select),
    !page.isViewer && layerChoices(page, scene),
    !page.isViewer && selectedPhoto(page),
    element('p', { id: 'view-keys', class: 'hint' },
      'Arrow keys turn, + and − zoom, Home resets; dragging with shift moves. ',
      !page.isViewer && 'Click the view before you zoom with the wheel.'));
  const ready = scene.load().then(() => {
    select?.dispatchEvent(new Event('change'));
    scene.mark();
  });
  return {
    element: element('div', { class: 'scene' }, viewport, panel), scene, ready,
    showPlaces: page.isViewer ? null : (advice) => showPlaces(scene, advice),
  };
}

function colorSelect(scene, legend) {
  const { surface } = scene.parts;
  if (!surface) return null;
  const option = (value, text) => element('option', { value }, text);
  const select = element('select', { id: 'color-by' },
    surface.modes.map((mode) => option(mode, SURFACE_NAMES[mode])),
    surface.maps.length > 0 && element('optgroup', { label: 'Maps of the surface' },
      surface.maps.map((map) => option(map.key, map.name))));
  // A page about errors shows them first.
  if (surface.maps.some((map) => map.key === 'distance')) select.value = 'distance';
  select.addEventListener('change', () => {
    const map = surface.maps.find((each) => each.key === select.value);
    surface.show(select.value);
    legend.hidden = !map;
    legend.replaceChildren(...(map ? [mapLegend(map), mapExplanation(map)] : []));
    scene.request();
  });
  return select;
}

function mapExplanation(map) {
  return element('p', {}, MAP_EXPLANATIONS[map.key] ?? '');
}

/** Check boxes for the layers, and one for the places of the advice. */
function layerChoices(page, scene) {
  const checkbox = (key, name, isChecked, changed) => element('label', {},
    element('input', {
      type: 'checkbox', id: `layer-${key}`, checked: isChecked,
      onchange: (event) => { changed(event.target.checked); scene.request(); },
    }), name);
  const places = list(page.report.advice).flatMap(placesOf);
  return element('fieldset', {}, element('legend', {}, 'Show'),
    scene.layers.map(({ key, name, objects: [object] }) => {
      const isShown = object.visible || key === 'photos';
      return checkbox(key, name, isShown, (visible) => { object.visible = visible; });
    }),
    places.length > 0 && checkbox('places', 'Suggested places for photos', false,
      (visible) => scene.showPlaces(visible ? places : [])));
}

/** Shows the places of one piece of advice, from a direction from which they can be seen. */
function showPlaces(scene, advice) {
  const places = placesOf(advice);
  scene.showPlaces(places);
  const checkbox = document.getElementById('layer-places');
  if (checkbox) checkbox.checked = true;
  const mean = [0, 1, 2].map((i) =>
    total(places.map((place) => place.position[i] - place.target[i])) / places.length);
  const flat = Math.hypot(mean[0], mean[2]);
  const { home } = scene.parts;
  const isOneSided = flat > Math.abs(mean[1]) * 0.5;
  scene.orbit.reset({
    ...home, distance: home.distance * 1.15,
    azimuth: isOneSided ? Math.atan2(mean[0], mean[2]) + 0.4 : home.azimuth,
    elevation: Math.min(Math.max(Math.atan2(mean[1], flat) + 0.15, -0.35), 0.7),
  });
  document.getElementById('model')?.scrollIntoView({ block: 'start' });
  scene.canvas.focus({ preventScroll: true });
}

function viewTools(scene) {
  const tool = (id, sign, name, action) => element('button', {
    type: 'button', id, 'aria-label': name, title: name, onclick: action,
  }, sign);
  return element('div', { class: 'tools' },
    tool('zoom-in', '+', 'Zoom in', () => scene.orbit.zoom(1 / 1.25)),
    tool('zoom-out', '−', 'Zoom out', () => scene.orbit.zoom(1.25)),
    tool('reset', '⌂', 'Reset the view', () => scene.orbit.reset()));
}

/** A small picture of the selected photo, beside the view. */
function selectedPhoto(page) {
  if (page.photos.length === 0) return null;
  const place = element('div', { class: 'selected-photo' });
  page.selection.follow((photo) => place.replaceChildren(
    thumbnail(photo),
    element('p', {}, nameElement(photo), ' ',
      element('a', { href: '#picture' }, 'Large picture'))));
  return place;
}

/** The browser prints a WebGL canvas as empty: put a copy in its place, in light colors. */
function followPrinting(scene, copy) {
  addEventListener('beforeprint', () => {
    scene.mark();
    scene.draw();
    copy.width = scene.canvas.width;
    copy.height = scene.canvas.height;
    copy.getContext('2d').drawImage(scene.canvas, 0, 0);
  });
  addEventListener('afterprint', () => scene.mark());
}

/** What is shown instead of the 3-D view. */
function stillPictures(page) {
  const { pictures } = page.material;
  if (!isPicture(pictures) && !hasGeometry(page) && !page.isViewer) return null;
  const reason = graphicsLibrary()
    ? 'This browser has no WebGL, so the model can’t be turned here.'
    : 'This page was written without the 3-D library, so the model can’t be turned here.';
  if (!isPicture(pictures)) {
    return {
      isFlat: true, ready: Promise.resolve(),
      element: element('p', { class: 'hint', id: 'view-missing' }, reason,
        ' Open the model’s file in another program.'),
    };
  }
  const image = element('img',
    { id: 'pictures', src: pictures, alt: 'The model from eight sides' });
  return {
    isFlat: true, ready: image.decode().catch(() => {}),
    element: element('figure', { class: 'still' }, image, element('figcaption', {}, reason)),
  };
}

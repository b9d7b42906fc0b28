/** The 3-D library, whichever revision the page has; null if it has none. */
function graphicsLibrary() {
  const library = globalThis.THREE_LIBRARY ?? globalThis.THREE;
  // One bundle exports the library's names as a whole, next to other things.
  return library?.THREE ?? library ?? null;
}

/** A renderer, or null where the browser has no WebGL. */
function makeRenderer(three, canvas) {
  // The library itself would report the failure on the console.
  const kind = Number.parseInt(three.REVISION, 10) >= 163 ? 'webgl2' : 'webgl';
  const context = canvas.getContext(kind, { antialias: true, alpha: false });
  return context ? new three.WebGLRenderer({ canvas, context }) : null;
}

/**
 * The 3-D view without its controls: layers, drawing, picking.
 *
 * @param {Object} page
 * @param {HTMLCanvasElement} canvas
 * @returns {?Object} null without library, WebGL or anything to show
 */
function makeScene(page, canvas) {
  const three = graphicsLibrary();
  if (!three || !hasGeometry(page)) return null;
  const renderer = makeRenderer(three, canvas);
  if (!renderer) return null;
  const parts = sceneParts(three, page);
  const scene = new three.Scene();
  const camera = new three.PerspectiveCamera(36, 1, 0.01, 100);
  const all = [parts.ground, parts.surface?.mesh, parts.sparse, parts.dense, parts.links,
    parts.cameras?.group, parts.cameras?.planes].filter(Boolean);
  scene.add(...all);
  parts.links.visible = false;
  if (parts.dense) parts.dense.visible = false;
  if (parts.sparse) parts.sparse.visible = !parts.surface;
  const view = { three, renderer, parts, canvas, layers: sceneLayers(parts) };
  const painter = makePainter(renderer, canvas, () => paint(view, scene, camera));
  view.request = painter.request;
  view.draw = painter.draw;
  view.orbit = makeOrbit(canvas, parts.home, {
    isGreedy: page.isViewer,
    changed: painter.request,
    clicked: (x, y) => page.selection.select(pickedPhoto(view, camera, x, y)),
  });
  view.mark = () => {
    const { photo } = page.selection;
    parts.cameras?.mark(photo);
    parts.links.userData.mark(photo);
    parts.ground.userData.mark();
    renderer.setClearColor(new three.Color().setHex(hexColor('--stage')), 1);
    painter.request();
  };
  view.showPlaces = (places) => {
    if (view.places) scene.remove(view.places);
    view.places = placeLines(three, places, parts.depth);
    scene.add(view.places);
    painter.request();
  };
  view.load = async () => {
    await Promise.all([parts.surface?.load(), parts.cameras?.load()]);
  };
  return view;
}

function hasGeometry(page) {
  const { material, photos } = page;
  return Boolean(material.model?.positions || material.points?.sparse || material.points?.dense
    || photos.some((photo) => photo.pose));
}

function hexColor(name) {
  const [red, green, blue] = themeColor(name).map((value) => Math.round(value * 255));
  return red * 65536 + green * 256 + blue;
}

function sceneParts(three, { material, photos, partners }) {
  const surface = makeSurface(three, material.model);
  const sparse = makePoints(three, material.points?.sparse, 2.5);
  const dense = makePoints(three, material.points?.dense, 2);
  const posed = photos.filter((photo) => photo.pose && photo.lens);
  const object = surface?.bounds ?? dense?.userData.bounds ?? sparse?.userData.bounds
    ?? { center: [0, 0, 0], radius: 0.5, bottom: 0 };
  const reach = posed.map((photo) =>
    Math.hypot(...photo.pose.position.map((value, i) => value - object.center[i])));
  const radius = median(reach) ?? object.radius * 1.5;
  const depth = frustumDepth(posed, radius);
  return {
    surface, sparse, dense, depth,
    extent: Math.max(largest(reach), object.radius) * 1.5,
    cameras: posed.length > 0 ? makeCameras(three, posed, depth) : null,
    links: makeLinks(three, posed, partners),
    ground: groundLines(three, Math.max(radius, object.radius), Math.min(object.bottom, 0)),
    home: homeView(object, posed, radius),
  };
}

/** A view from three quarters in front, wide enough for a ring of cameras. */
function homeView({ center, radius }, posed, ring) {
  const height = total(posed.map((photo) => photo.pose.position[1] - center[1]))
    / Math.max(posed.length, 1);
  return {
    target: [center[0], center[1] + height * 0.45, center[2]],
    distance: Math.max(radius * 3.8, posed.length > 0 ? ring * 2.5 : 0),
    azimuth: Math.PI / 7, elevation: Math.PI / 9,
  };
}

/** What can be shown and hidden: a key, a name, and the objects. */
function sceneLayers(parts) {
  const { surface, sparse, dense, cameras, links } = parts;
  return [
    { key: 'model', name: 'Model', objects: [surface?.mesh] },
    { key: 'cameras', name: 'Cameras', objects: [cameras?.group] },
    { key: 'photos', name: 'Photos at the cameras', objects: [cameras?.planes] },
    { key: 'sparse', name: 'Sparse points', objects: [sparse] },
    { key: 'dense', name: 'Dense points', objects: [dense] },
    {
      key: 'links', name: 'Links: the 5 strongest matches',
      objects: [links.userData.count && links],
    },
  ].filter((layer) => layer.objects.every(Boolean));
}

function paint(view, scene, camera) {
  const { parts, orbit, renderer, canvas } = view;
  const eye = orbit.position();
  camera.aspect = canvas.clientWidth / Math.max(canvas.clientHeight, 1);
  // A tall window would cut off the sides: keep the field of view across the shorter side.
  camera.fov = camera.aspect >= 1 ? 36 : Math.min(36 / camera.aspect, 75);
  const distance = orbit.distance + Math.hypot(...orbit.target) + parts.extent;
  camera.near = Math.max(orbit.distance / 100, distance / 5000);
  camera.far = distance * 2;
  camera.position.set(...eye);
  camera.lookAt(...orbit.target);
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  if (parts.cameras?.planes.visible) parts.cameras.sort(eye);
  renderer.render(scene, camera);
}

function pickedPhoto(view, camera, x, y) {
  const { three, canvas, parts } = view;
  const layers = parts.cameras;
  if (!layers || !(layers.group.visible || layers.planes.visible)) return null;
  const point = new three.Vector3((x / canvas.clientWidth) * 2 - 1,
    1 - (y / canvas.clientHeight) * 2, 0.5).unproject(camera);
  const eye = view.orbit.position();
  return layers.pick(eye, point.toArray().map((value, i) => value - eye[i]));
}

/**
 * A map of the surface as this photo sees it: the model, drawn with the photo's own camera.
 *
 * @returns {?HTMLCanvasElement} null without a 3-D view, a pose or a camera
 */
function projectedMap(page, photo, map, width, height) {
  const scene = page.view?.scene;
  const surface = scene?.parts.surface;
  if (!surface || !photo.pose || !photo.lens) return null;
  const { three, renderer } = scene;
  const projection = scene.projection ??= makeProjection(three, surface);
  const { geometry, uniforms } = projection;
  geometry.setAttribute('value', surface.values(map));
  uniforms.isClosedMap.value = map.key === 'closed' ? 1 : 0;
  setCamera(three, uniforms, photo, surface);
  const target = new three.WebGLRenderTarget(width, height);
  const bytes = new Uint8Array(width * height * 4);
  const ratio = renderer.getClearColor(new three.Color()) ?? new three.Color();
  const color = ratio.clone();
  const alpha = renderer.getClearAlpha();
  renderer.setClearColor(0x000000, 0);
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(projection.scene, projection.camera);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, bytes);
  renderer.setRenderTarget(null);
  renderer.setClearColor(color, alpha);
  target.dispose();
  const canvas = element('canvas', { id: 'picture-projection', width, height });
  canvas.getContext('2d')
    .putImageData(new ImageData(new Uint8ClampedArray(bytes.buffer), width, height), 0, 0);
  return canvas;
}

/** The model's buffers with a shader that projects them into a photo. */
function makeProjection(three, surface) {
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', surface.geometry.attributes.position);
  geometry.setIndex(surface.geometry.index);
  const { ramp, noData, closedColor, shownColor } = surface.shared;
  const uniforms = {
    ramp, noData, closedColor, shownColor, isClosedMap: { value: 0 },
    cameraFromModel: { value: new three.Matrix4() }, distortion: { value: new three.Vector4() },
    focalLength: { value: new three.Vector2() }, principalPoint: { value: new three.Vector2() },
    imageSize: { value: new three.Vector2() }, depthRange: { value: new three.Vector2() },
    maximumRadius: { value: 1 },
  };
  const mesh = new three.Mesh(geometry, new three.ShaderMaterial({
    uniforms, vertexShader: PROJECTION_VERTEX, fragmentShader: PROJECTION_FRAGMENT,
    side: three.DoubleSide,
  }));
  mesh.frustumCulled = false;
  const scene = new three.Scene();
  scene.add(mesh);
  return { scene, geometry, uniforms, camera: new three.PerspectiveCamera() };
}

function setCamera(three, uniforms, photo, surface) {
  const { position, axes } = photo.pose;
  const { lens } = photo;
  const rows = axes.map((axis) =>
    [...axis, -axis.reduce((sum, value, i) => sum + value * position[i], 0)]);
  uniforms.cameraFromModel.value.set(...rows[0], ...rows[1], ...rows[2], 0, 0, 0, 1)
    .multiply(surface.mesh.matrixWorld);
  uniforms.focalLength.value.set(...lens.focalLength);
  uniforms.principalPoint.value.set(...lens.principalPoint);
  uniforms.distortion.value.set(...lens.distortion);
  uniforms.imageSize.value.set(lens.width, lens.height);
  uniforms.maximumRadius.value = monotonicRadius(lens);
  const { center, radius } = surface.bounds;
  const distance = Math.hypot(...center.map((value, i) => value - position[i]));
  uniforms.depthRange.value.set(
    Math.max(distance - radius, (distance + radius) / 1000) * 0.9, (distance + radius) * 1.1);
}

/**
 * The largest distance from the optical axis (in the plane at depth 1) up to which the distortion
 * grows; beyond it, the polynomial would fold points from outside back into the photo.
 */
function monotonicRadius({ distortion: [k1, k2] }) {
  for (let radius = 0.05; radius < 10; radius += 0.05) {
    const r2 = radius * radius;
    if (1 + 3 * k1 * r2 + 5 * k2 * r2 * r2 <= 0) return radius;
  }
  return 10;
}

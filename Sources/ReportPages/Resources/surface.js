/**
 * The textured model as a mesh whose coloring can be switched.
 *
 * @returns {?{mesh: Object, geometry: Object, bounds: Object, modes: string[], maps: Object[],
 *   show: function(string), load: function(): Promise}} null without a model
 */
function makeSurface(three, model) {
  const positions = decodedArray(Uint16Array, model?.positions);
  const count = Math.floor(positions.length / 3);
  const triangles = decodedArray(count <= 65536 ? Uint16Array : Uint32Array, model?.triangles);
  if (count === 0 || triangles.length < 3 || largestOf(triangles) >= count) return null;
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(positions, 3, true));
  geometry.setIndex(new three.BufferAttribute(triangles, 1));
  geometry.setAttribute('normal', surfaceNormals(three, model, positions, triangles));
  const optional = (name, field, Type, size) => {
    const values = decodedArray(Type, model[field]);
    if (values.length < count * size) return false;
    geometry.setAttribute(name, new three.BufferAttribute(values, size, true));
    return true;
  };
  const hasCoordinates = optional('uv', 'coordinates', Uint16Array, 2);
  const hasColors = optional('tint', 'colors', Uint8Array, 3);
  const parts = list(model.parts).filter((part) => isNumber(part?.first) && isNumber(part?.count));
  if (parts.length === 0) parts.push({ first: 0, count: triangles.length / 3 });
  const hasTexture = hasCoordinates && parts.some((part) => isPicture(part.texture));
  const shared = surfaceUniforms(three, model);
  const materials = parts.map((part, index) => {
    geometry.addGroup(part.first * 3, part.count * 3, index);
    return new three.ShaderMaterial({
      uniforms: { ...shared, mode: { value: SURFACE_MODES.shape }, picture: { value: null } },
      vertexShader: SURFACE_VERTEX, fragmentShader: SURFACE_FRAGMENT, side: three.DoubleSide,
    });
  });
  const mesh = new three.Mesh(geometry, materials);
  placeQuantized(mesh, model);
  const isComplete = (map) => decodedBytes(map?.values).length >= count;
  const maps = list(model.maps).filter(isComplete);
  const surface = { mesh, geometry, maps, shared, bounds: boundsOf(positions, model) };
  surface.modes = [hasTexture && 'texture', hasColors && 'colors', 'shape', 'wireframe']
    .filter(Boolean);
  surface.values = (map) => mapAttribute(three, map);
  surface.show = (key) => showSurface(surface, materials, key);
  const repeats = list(model.coordinateSize).some((size) => size > 1);
  surface.load = () => Promise.all(parts.map(async (part, index) => {
    const image = await decodedPicture(part.texture);
    if (image) materials[index].uniforms.picture.value = pictureTexture(three, image, repeats);
  }));
  return surface;
}

/** The box about quantized positions: its center and half of its diagonal. */
function boundsOf(positions, { origin, size }) {
  const low = [65535, 65535, 65535];
  const high = [0, 0, 0];
  for (let i = 0; i < positions.length; i += 1) {
    const axis = i % 3;
    if (positions[i] < low[axis]) low[axis] = positions[i];
    if (positions[i] > high[axis]) high[axis] = positions[i];
  }
  const scale = (isNumber(size) && size > 0 ? size : 1) / 65535;
  const start = list(origin).length === 3 ? origin : [0, 0, 0];
  return {
    center: start.map((value, i) => value + (scale * (low[i] + high[i])) / 2),
    radius: (scale * Math.hypot(...high.map((value, i) => value - low[i]))) / 2,
    bottom: start[1] + scale * low[1],
  };
}

/** Indices are read from a file: one beyond the vertices would read beyond the buffers. */
function largestOf(values) {
  let most = 0;
  for (const value of values) if (value > most) most = value;
  return most;
}

function surfaceUniforms(three, model) {
  const pair = (values, missing) => ({
    value: new three.Vector2(...(list(values).length === 2 ? values : missing)) });
  const color = (bytes) => ({ value: new three.Vector3(...bytes.map((byte) => byte / 255)) });
  return {
    ramp: { value: rampTexture(three) },
    coordinateOrigin: pair(model.coordinateOrigin, [0, 0]),
    coordinateSize: pair(model.coordinateSize, [1, 1]),
    noData: color(NO_DATA), closedColor: color(CLOSED), shownColor: color(SHOWN),
  };
}

function showSurface(surface, materials, key) {
  const map = surface.maps.find((each) => each.key === key);
  if (map) surface.geometry.setAttribute('value', surface.values(map));
  const mode = map ? (key === 'closed' ? 'closed' : 'heat') : key;
  for (const material of materials) {
    const { uniforms } = material;
    // A part without a texture, or whose picture isn't decoded yet, shows its colors or shape.
    const isBare = mode === 'texture' && !uniforms.picture.value;
    const bare = surface.modes.includes('colors') ? 'colors' : 'shape';
    uniforms.mode.value = SURFACE_MODES[isBare ? bare : mode] ?? SURFACE_MODES.shape;
    material.wireframe = key === 'wireframe';
  }
}

/** The values of a map as an attribute; made once, so that its buffer stays on the GPU. */
function mapAttribute(three, map) {
  map.attribute ??= new three.BufferAttribute(decodedArray(Uint8Array, map.values), 1);
  return map.attribute;
}

/** Positions are stored as shares of a cube: the object's own transform undoes this. */
function placeQuantized(object, { origin, size }) {
  object.position.set(...(list(origin).length === 3 ? origin : [0, 0, 0]));
  object.scale.setScalar(isNumber(size) && size > 0 ? size : 1);
  object.frustumCulled = false;
  object.updateMatrixWorld();
}

function surfaceNormals(three, model, positions, triangles) {
  const stored = decodedArray(Int8Array, model.normals);
  if (stored.length >= positions.length) return new three.BufferAttribute(stored, 3, true);
  const sums = new Float32Array(positions.length);
  for (let t = 0; t + 2 < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t] * 3, triangles[t + 1] * 3, triangles[t + 2] * 3];
    const e = [0, 1, 2].map((i) => positions[b + i] - positions[a + i]);
    const f = [0, 1, 2].map((i) => positions[c + i] - positions[a + i]);
    for (let i = 0; i < 3; i += 1) {
      const normal = e[(i + 1) % 3] * f[(i + 2) % 3] - e[(i + 2) % 3] * f[(i + 1) % 3];
      sums[a + i] += normal;
      sums[b + i] += normal;
      sums[c + i] += normal;
    }
  }
  return new three.BufferAttribute(sums, 3);
}

function rampTexture(three) {
  const bytes = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; i += 1) bytes.set([...viridis(i / 255), 255], i * 4);
  const texture = new three.DataTexture(bytes, 256, 1, three.RGBAFormat);
  texture.magFilter = three.LinearFilter;
  texture.minFilter = three.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

function pictureTexture(three, image, repeats = false) {
  const texture = new three.Texture(image);
  if (repeats) texture.wrapS = texture.wrapT = three.RepeatWrapping;
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  return texture;
}

/** A cloud of points, or null. */
function makePoints(three, cloud, size) {
  const positions = decodedArray(Uint16Array, cloud?.positions);
  if (positions.length < 3) return null;
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(positions, 3, true));
  const given = decodedArray(Uint8Array, cloud.colors);
  const colors = given.length >= positions.length ? given
    : new Uint8Array(positions.length).fill(128);
  geometry.setAttribute('tint', new three.BufferAttribute(colors, 3, true));
  const points = new three.Points(geometry, new three.ShaderMaterial({
    uniforms: { size: { value: size } },
    vertexShader: POINT_VERTEX, fragmentShader: POINT_FRAGMENT,
  }));
  placeQuantized(points, cloud);
  points.userData.bounds = boundsOf(positions, cloud);
  return points;
}

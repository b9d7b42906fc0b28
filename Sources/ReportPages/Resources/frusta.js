/** The four corners of a photo at a depth in front of its camera, clockwise from the top left. */
function photoCorners(photo, depth) {
  const { position, axes } = photo.pose;
  const { width, height, focalLength, principalPoint } = photo.lens;
  return [[0, 0], [width, 0], [width, height], [0, height]].map(([u, v]) => {
    const x = (u - principalPoint[0]) / focalLength[0];
    const y = (v - principalPoint[1]) / focalLength[1];
    return position.map((value, i) =>
      value + depth * (x * axes[0][i] + y * axes[1][i] + axes[2][i]));
  });
}

/** The depth at which the pictures of neighboring cameras don't cover each other. */
function frustumDepth(photos, radius) {
  const gaps = photos.map((photo) => photos.reduce((least, other) => {
    if (other === photo) return least;
    const gap = Math.hypot(
      ...photo.pose.position.map((value, i) => value - other.pose.position[i]));
    return gap > 0 && gap < least ? gap : least;
  }, Infinity));
  const gap = median(gaps) ?? Infinity;
  return Math.min(Math.max(gap * 0.5, radius * 0.04), radius * 0.16);
}

/** The edges of a pyramid as pairs of points. */
function pyramidEdges(apex, corners) {
  return corners.flatMap((corner, i) => [apex, corner, corner, corners[(i + 1) % 4]]);
}

/** Line segments with a color and an opacity for each end. */
function makeLines(three, points, tints) {
  const geometry = new three.BufferGeometry();
  geometry.setAttribute('position',
    new three.BufferAttribute(Float32Array.from(points.flat()), 3));
  geometry.setAttribute('tint', new three.BufferAttribute(new Uint8Array(tints), 4, true));
  const lines = new three.LineSegments(geometry, colorMaterial(three));
  lines.frustumCulled = false;
  return lines;
}

function colorMaterial(three) {
  return new three.ShaderMaterial({
    vertexShader: LINE_VERTEX, fragmentShader: LINE_FRAGMENT, side: three.DoubleSide,
    transparent: true, depthWrite: false,
  });
}

function byteColor(name, opacity) {
  return [...themeColor(name).map((value) => Math.round(value * 255)), Math.round(opacity * 255)];
}

/**
 * All cameras: their pyramids, the photos in them, and a frame about the selected one.
 *
 * @param {PhotoRecord[]} photos those with a pose and a lens
 */
function makeCameras(three, photos, depth) {
  const corners = photos.map((photo) => photoCorners(photo, depth));
  const edges = photos.flatMap((photo, i) => pyramidEdges(photo.pose.position, corners[i]));
  const lines = makeLines(three, edges, new Array(edges.length * 4).fill(128));
  const planes = makePlanes(three, corners, photos.map((photo) => photo.pose.axes[2]));
  const frame = makeLines(three, [], []);
  const group = new three.Group();
  group.add(lines, frame);
  return {
    group, planes: planes.mesh, sort: planes.sort,
    load: () => planes.load(photos),
    /** Colors the pyramids; the selected one gets a second, larger outline. */
    mark(selected) {
      const usual = byteColor('--camera', 0.75);
      const accent = byteColor('--selected', 1);
      const { tint } = lines.geometry.attributes;
      photos.forEach((photo, i) => {
        const color = photo === selected ? accent : usual;
        for (let k = 0; k < 16; k += 1) tint.array.set(color, (i * 16 + k) * 4);
      });
      tint.needsUpdate = true;
      markFrame(three, frame, photos.includes(selected) ? selected : null, depth, accent);
    },
    /** The photo whose picture a ray meets first. */
    pick: (origin, direction) => photos[nearestQuad(corners, origin, direction)] ?? null,
  };
}

/** Lines are one pixel wide everywhere, so a bold frame is several of them. */
function markFrame(three, frame, photo, depth, color) {
  const rings = photo ? [1, 1.008, 1.016, 1.024, 1.032].flatMap((factor) => {
    const center = photo.pose.position.map((value, i) => value + depth * photo.pose.axes[2][i]);
    const corners = photoCorners(photo, depth).map((corner) =>
      corner.map((value, i) => center[i] + factor * (value - center[i])));
    return corners.flatMap((corner, i) => [corner, corners[(i + 1) % 4]]);
  }) : [];
  frame.geometry.dispose();
  frame.geometry = makeLines(three, rings, rings.flatMap(() => color)).geometry;
}

/** The photos as rectangles with one texture, and so one draw call. */
function makePlanes(three, corners, directions) {
  const columns = Math.max(1, Math.ceil(Math.sqrt(corners.length)));
  const geometry = new three.BufferGeometry();
  const coordinates = corners.flatMap((_, i) => {
    const inset = 0.004;
    const left = ((i % columns) + inset) / columns;
    const right = ((i % columns) + 1 - inset) / columns;
    const top = 1 - (Math.floor(i / columns) + inset) / columns;
    const bottom = 1 - (Math.floor(i / columns) + 1 - inset) / columns;
    return [left, top, right, top, right, bottom, left, bottom];
  });
  geometry.setAttribute('position',
    new three.BufferAttribute(Float32Array.from(corners.flat(2)), 3));
  geometry.setAttribute('normal', new three.BufferAttribute(
    Float32Array.from(directions.flatMap((each) => [each, each, each, each].flat())), 3));
  geometry.setAttribute('uv', new three.BufferAttribute(Float32Array.from(coordinates), 2));
  geometry.setIndex(new three.BufferAttribute(new Uint32Array(corners.length * 6), 1));
  const uniforms = { atlas: { value: null } };
  const mesh = new three.Mesh(geometry, new three.ShaderMaterial({
    uniforms, vertexShader: PLANE_VERTEX, fragmentShader: PLANE_FRAGMENT,
    side: three.DoubleSide, transparent: true, depthWrite: false,
  }));
  mesh.frustumCulled = false;
  mesh.visible = false;
  return {
    mesh,
    /** Puts the farthest first, since some of them are translucent. */
    sort(eye) {
      const distances = corners.map((quad) =>
        Math.hypot(...eye.map((value, i) => (quad[0][i] + quad[2][i]) / 2 - value)));
      const order = corners.map((_, i) => i).sort((a, b) => distances[b] - distances[a]);
      order.forEach((quad, i) => geometry.index.array.set(
        [0, 3, 2, 0, 2, 1].map((corner) => quad * 4 + corner), i * 6));
      geometry.index.needsUpdate = true;
    },
    async load(photos) {
      uniforms.atlas.value = pictureTexture(three, await photoAtlas(photos, columns));
      mesh.visible = true;
    },
  };
}

/** All photos in one square picture. Each fills a square cell: the rectangle undoes the change. */
async function photoAtlas(photos, columns) {
  const side = columns <= 20 ? 2048 : 4096;
  const cell = side / columns;
  const canvas = element('canvas', { width: side, height: side });
  const context = canvas.getContext('2d');
  context.fillStyle = '#888';
  context.fillRect(0, 0, side, side);
  await Promise.all(photos.map(async (photo, i) => {
    const image = await decodedPicture(photo.picture?.picture);
    const [x, y] = [(i % columns) * cell, Math.floor(i / columns) * cell];
    if (image) context.drawImage(image, x, y, cell, cell);
  }));
  return canvas;
}

/** The index of the rectangle that a ray meets first; −1 if it meets none. */
function nearestQuad(corners, origin, direction) {
  const minus = (a, b) => a.map((value, i) => value - b[i]);
  const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
  const cross = (a, b) => [0, 1, 2].map((i) =>
    a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
  let found = -1;
  let nearest = Infinity;
  corners.forEach(([topLeft, topRight, , bottomLeft], index) => {
    const right = minus(topRight, topLeft);
    const down = minus(bottomLeft, topLeft);
    const normal = cross(right, down);
    const t = dot(minus(topLeft, origin), normal) / dot(direction, normal);
    if (!(t > 0 && t < nearest)) return;
    const point = minus(origin.map((value, i) => value + t * direction[i]), topLeft);
    const u = dot(point, right) / dot(right, right);
    const v = dot(point, down) / dot(down, down);
    if (u < 0 || u > 1 || v < 0 || v > 1) return;
    nearest = t;
    found = index;
  });
  return found;
}

/** Lines from each photo to the five with which it shares the most matches. */
function makeLinks(three, photos, partners) {
  const linked = new Map();
  for (const photo of photos) {
    const strongest = partners[photo.index].filter((partner) => photos.includes(partner.photo));
    for (const { photo: other, matches } of strongest.slice(0, 5)) {
      const [a, b] = photo.index < other.index ? [photo, other] : [other, photo];
      linked.set(`${a.index} ${b.index}`, { a, b, matches });
    }
  }
  const links = [...linked.values()];
  const most = Math.log(1 + largest(links.map((link) => link.matches)));
  const lines = makeLines(three, links.flatMap(({ a, b }) => [a.pose.position, b.pose.position]),
    new Array(links.length * 8).fill(0));
  lines.userData.count = links.length;
  lines.userData.mark = (selected) => {
    const { tint } = lines.geometry.attributes;
    links.forEach(({ a, b, matches }, i) => {
      const isSelected = a === selected || b === selected;
      const opacity = isSelected ? 1 : 0.15 + (0.6 * Math.log(1 + matches)) / (most || 1);
      const color = byteColor(isSelected ? '--selected' : '--camera', opacity);
      tint.array.set([...color, ...color], i * 8);
    });
    tint.needsUpdate = true;
  };
  return lines;
}

/** Ghost cameras where photos are missing, each with a line to what it should show. */
function placeLines(three, places, depth) {
  const color = byteColor('--place', 1);
  const points = [];
  const tints = [];
  for (const { position, target } of places) {
    const edges = pyramidEdges(position, ghostCorners(position, target, depth));
    points.push(...edges, position, target);
    tints.push(...edges.flatMap(() => color), ...color.slice(0, 3), 110, ...color.slice(0, 3), 20);
  }
  return makeLines(three, points, tints);
}

function ghostCorners(position, target, depth) {
  const unit = (vector) => {
    const length = Math.hypot(...vector) || 1;
    return vector.map((value) => value / length);
  };
  const forward = unit(target.map((value, i) => value - position[i]));
  const isSteep = Math.hypot(forward[0], forward[2]) < 1e-6;
  const right = isSteep ? [1, 0, 0] : unit([-forward[2], 0, forward[0]]);
  const down = [0, 1, 2].map((i) => forward[(i + 1) % 3] * right[(i + 2) % 3]
    - forward[(i + 2) % 3] * right[(i + 1) % 3]);
  return [[-0.4, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.4, 0.3]].map(([x, y]) =>
    position.map((value, i) => value + depth * (forward[i] + x * right[i] + y * down[i])));
}

/** Rings and spokes on the ground, like those of the chart of directions. */
function groundLines(three, radius, bottom) {
  const points = [];
  const at = (distance, angle) =>
    [distance * Math.sin(angle), bottom, distance * Math.cos(angle)];
  const turn = 2 * Math.PI;
  for (const ring of [1 / 3, 2 / 3, 1]) {
    for (let i = 0; i < 96; i += 1) {
      points.push(at(ring * radius, (i / 96) * turn), at(ring * radius, ((i + 1) / 96) * turn));
    }
  }
  for (let i = 0; i < 12; i += 1) {
    points.push(at(radius / 6, (i / 12) * turn), at(radius, (i / 12) * turn));
  }
  const lines = makeLines(three, points, points.flatMap(() => [0, 0, 0, 0]));
  lines.userData.mark = () => {
    const { tint } = lines.geometry.attributes;
    const color = byteColor('--ground', 1);
    for (let i = 0; i < points.length; i += 1) tint.array.set(color, i * 4);
    tint.needsUpdate = true;
  };
  return lines;
}

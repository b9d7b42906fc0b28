/**
 * Turns, moves and zooms a camera about a target, by mouse, touch and keys. Its own, because the
 * controls of the library differ between its versions.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {{target: number[], distance: number, azimuth: number, elevation: number}} home angles in
 *   radians; azimuth 0 looks along −z, elevation is measured upward
 * @param {{changed: function(boolean), clicked: function(number, number), isGreedy: boolean}} host
 *   `changed` receives whether more changes follow; a greedy view also takes the wheel unfocused
 */
function makeOrbit(canvas, home, host) {
  const orbit = { ...home, reset, turn, zoom, position: () => place(orbit) };
  function reset(next = home) {
    Object.assign(orbit, next, { target: [...next.target] });
    host.changed(false);
  }
  function turn(azimuth, elevation, isMoving = false) {
    orbit.azimuth += azimuth;
    orbit.elevation = Math.min(Math.max(orbit.elevation + elevation, -1.56), 1.56);
    host.changed(isMoving);
  }
  function zoom(factor, isMoving = false) {
    const distance = orbit.distance * factor;
    orbit.distance = Math.min(Math.max(distance, home.distance / 50), home.distance * 10);
    host.changed(isMoving);
  }
  function move(right, up) {
    const { azimuth, elevation } = orbit;
    const rightward = [Math.cos(azimuth), 0, -Math.sin(azimuth)];
    const upward = [-Math.sin(elevation) * Math.sin(azimuth), Math.cos(elevation),
      -Math.sin(elevation) * Math.cos(azimuth)];
    orbit.target = orbit.target.map((value, i) =>
      value + orbit.distance * (right * rightward[i] + up * upward[i]));
    host.changed(true);
  }
  followPointers(canvas, orbit, move, host);
  followKeys(canvas, orbit);
  canvas.addEventListener('wheel', (event) => {
    // A page that scrolls past the view must not be caught by it.
    if (!host.isGreedy && document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    zoom(Math.exp(Math.min(Math.max(event.deltaY, -120), 120) * 0.0015), true);
  }, { passive: false });
  return orbit;
}

function place({ target, distance, azimuth, elevation }) {
  const flat = distance * Math.cos(elevation);
  return [target[0] + flat * Math.sin(azimuth), target[1] + distance * Math.sin(elevation),
    target[2] + flat * Math.cos(azimuth)];
}

/** One pointer turns (or moves, with shift or another button); two move and zoom. */
function followPointers(canvas, orbit, move, host) {
  const pointers = new Map();
  let travel = 0;
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (pointers.size === 0) travel = 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    canvas.setPointerCapture(event.pointerId);
    canvas.focus({ preventScroll: true });
  });
  canvas.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = spread();
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    travel += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) {
      move(-dx / canvas.clientHeight / 2, dy / canvas.clientHeight / 2);
      if (spread() > 0) orbit.zoom(before / spread(), true);
    } else if (event.shiftKey || event.buttons > 1) {
      move(-dx / canvas.clientHeight, dy / canvas.clientHeight);
    } else {
      orbit.turn(-dx * 0.008, dy * 0.008, true);
    }
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && travel < 5 && event.button === 0) {
      const box = canvas.getBoundingClientRect();
      host.clicked(event.clientX - box.left, event.clientY - box.top);
    }
    host.changed(false);
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
}

function followKeys(canvas, orbit) {
  const step = Math.PI / 18;
  const actions = {
    ArrowLeft: () => orbit.turn(-step, 0), ArrowRight: () => orbit.turn(step, 0),
    ArrowUp: () => orbit.turn(0, step), ArrowDown: () => orbit.turn(0, -step),
    '+': () => orbit.zoom(1 / 1.2), '=': () => orbit.zoom(1 / 1.2), '-': () => orbit.zoom(1.2),
    Home: () => orbit.reset(),
  };
  canvas.addEventListener('keydown', (event) => {
    const isShortcut = event.ctrlKey || event.altKey || event.metaKey;
    if (isShortcut || !Object.hasOwn(actions, event.key)) return;
    event.preventDefault();
    actions[event.key]();
  });
}

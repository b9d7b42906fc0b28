/**
 * Draws only when something has changed. While the view is turned and frames take long (software
 * rendering), they have half the resolution, and a sharp one follows.
 */
function makePainter(renderer, canvas, paint) {
  const slowMilliseconds = 40;
  let scheduled = 0;
  let rest = 0;
  let isMoving = false;
  let isCoarse = false;
  let last = null;
  let interval = 0;
  function draw() {
    const ratio = Math.min(devicePixelRatio, 2) * (isCoarse ? 0.5 : 1);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0 || height === 0) return;
    if (renderer.getPixelRatio() !== ratio) renderer.setPixelRatio(ratio);
    if (canvas.width !== Math.floor(width * ratio)
      || canvas.height !== Math.floor(height * ratio)) renderer.setSize(width, height, false);
    paint();
  }
  function frame(now) {
    scheduled = 0;
    // A call to draw only queues commands. How long they take shows in the time between frames;
    // its moving average keeps a single late frame from blurring the view.
    if (isMoving && last !== null) interval += (now - last - interval) / 4;
    last = isMoving ? now : null;
    isCoarse = isMoving && (isCoarse || interval > slowMilliseconds);
    draw();
  }
  function request(moreFollows = false) {
    isMoving = moreFollows;
    clearTimeout(rest);
    // A wheel has no end: without more changes, the sharp frame comes after a moment. It is
    // longer than a slow frame, for events wait for frames.
    if (moreFollows) rest = setTimeout(request, 700);
    scheduled ||= requestAnimationFrame(frame);
  }
  new ResizeObserver(() => request()).observe(canvas);
  return { request, draw };
}

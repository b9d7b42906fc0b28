/** The levels of a verdict in words, with a sign, so that color alone never carries the meaning. */
const LEVELS = {
  good: ['Good', '✓'], fair: ['Fair', '!'], poor: ['Poor', '!'], failed: ['Failed', '✕'],
  unknown: ['Not yet known', '?'],
};

/** The title, the verdict and the key figures. */
function summaryHeader(report, photos, title) {
  const run = report.run ?? {};
  const started = new Date(run.started ?? NaN);
  const date = Number.isNaN(started.getTime()) ? null
    : started.toLocaleString('en-US', { dateStyle: 'long', timeStyle: 'short' });
  return element('header', { id: 'summary' },
    element('p', { class: 'overline' }, 'Photogrammetry report'),
    element('h1', {}, element('bdi', {}, title)),
    element('p', { class: 'lead' }, [date, run.output && `written to ${run.output}`,
      scaleSentence(report.worldFrame)].filter(Boolean).join(' · ')),
    verdict(report),
    keyFigures(report, photos));
}

function verdict(report) {
  const given = report.verdict ?? {};
  const level = Object.hasOwn(LEVELS, given.level ?? '') ? given.level
    : (list(report.errors).length > 0 ? 'failed' : null);
  if (!level && !given.sentence) return null;
  const [word, sign] = LEVELS[level ?? 'unknown'];
  return element('p', { id: 'verdict', class: `verdict ${level ?? 'unknown'}` },
    element('span', { class: 'badge' },
      element('span', { class: 'sign', 'aria-hidden': 'true' }, sign), word),
    element('span', {}, given.sentence ?? 'The run failed.'));
}

function scaleSentence(worldFrame) {
  return {
    arbitrary: 'sizes without a unit', depth: 'scale from depth maps', gps: 'scale from GPS',
    knownDistance: 'scale from a known distance', given: 'scale of the given cameras',
  }[worldFrame?.scale];
}

function keyFigures(report, photos) {
  const stages = list(report.stages);
  const count = (name, key) => stages.find((stage) => stage.name === name)?.counts?.[key];
  const points = (value) => (isNumber(value) ? decimal(value) : null);
  const peak = largest([...list(report.memory?.bytes),
    ...stages.map((stage) => stage.peakMemoryBytes)]);
  const used = photos.filter((photo) => photo.isUsed).length;
  const isMade = report.verdict?.level !== 'unknown';
  return figureList([
    photos.length > 0 && isMade
      ? ['photos used', `${decimal(used)} of ${decimal(photos.length)}`]
      : ['photos', photos.length > 0 ? decimal(photos.length) : null],
    ['triangles', points(report.surface?.triangles ?? count('textureMapping', 'triangles'))],
    ['mean reprojection error', measure(report.meanReprojectionError, 2, 'px'),
      'how far points land from where the photos show them'],
    ['sparse points', points(count('imageAlignment', 'points')
      ?? (list(report.tracks?.lengths).length > 0 ? total(report.tracks.lengths) : null)),
    'found in several photos'],
    ['dense points', points(count('pointCloudGeneration', 'points')), 'measured on the surface'],
    ['time', duration(report.run?.seconds
      ?? (stages.length > 0 ? total(stages.map((stage) => stage.seconds)) : null))],
    ['peak memory', peak > 0 ? byteCount(peak) : null],
  ], 'figures');
}

/** Errors, concerns, advice and the command: what to know and what to do next. */
function adviceSection(report, photos, selection, showPlaces) {
  const byName = new Map(photos.map((photo) => [photo.name, photo]));
  const messages = (texts, sign, kind) => list(texts).map((text) =>
    element('li', { class: kind },
      element('span', { class: 'sign', 'aria-hidden': 'true' }, sign),
      element('div', {}, element('strong', {}, `${wordsOf(kind)}: `), String(text))));
  const advice = list(report.advice).map((each) => element('li', { class: 'advice' },
    element('span', { class: 'sign', 'aria-hidden': 'true' }, '→'),
    element('div', {},
      element('p', {}, String(each?.sentence ?? '')),
      photoButtons(list(each?.photos).map((name) => byName.get(name)).filter(Boolean), selection),
      placesOf(each).length > 0 && showPlaces && element('button', {
        type: 'button', class: 'show-places', onclick: () => showPlaces(each),
      }, `Show ${plural(placesOf(each).length, 'place')} in the 3-D view`))));
  const items = [...messages(report.errors, '✕', 'error'),
    ...messages(report.concerns, '!', 'concern'), ...advice];
  return section('advice', 'What to do next', null,
    items.length > 0 && element('ul', { class: 'messages' }, items),
    items.length === 0 && report.verdict?.level === 'good'
      && element('p', {}, 'Nothing: the photos show the object from all sides.'),
    commandLine(report.run?.command));
}

/** Small pictures of photos; a click selects one. Many are cut to the first eight. */
function photoButtons(photos, selection) {
  if (photos.length === 0) return null;
  const shown = photos.slice(0, 8);
  return element('div', { class: 'photo-buttons' },
    shown.map((photo) => element('button', {
      type: 'button', class: 'photo-button', onclick: () => showPhoto(photo, selection),
    }, thumbnail(photo), nameElement(photo))),
    photos.length > shown.length
      && element('span', {}, `and ${decimal(photos.length - shown.length)} more`));
}

/** Selects a photo and brings its large picture into sight. */
function showPhoto(photo, selection) {
  selection.select(photo);
  document.getElementById('picture')?.scrollIntoView({ block: 'nearest' });
}

/** The command that repeats the run, quoted for a shell. */
function commandLine(words) {
  if (list(words).length === 0) return null;
  const quoted = words.map((word) => (/^[\w@%+=:,./-]+$/.test(word) ? word
    : `'${String(word).replaceAll("'", "'\\''")}'`)).join(' ');
  const code = element('code', { id: 'command', tabindex: 0 }, quoted);
  const button = element('button', { type: 'button', id: 'copy' }, 'Copy');
  button.addEventListener('click', async () => {
    getSelection().selectAllChildren(code);
    const isCopied = await navigator.clipboard?.writeText(quoted).then(() => true, () => false);
    button.textContent = isCopied ? 'Copied' : 'Selected';
  });
  return element('div', { class: 'command' },
    element('h3', {}, 'This command repeats the run'),
    element('div', {}, code, button));
}

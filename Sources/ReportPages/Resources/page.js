/*
 * The page of a report, or of a model alone. All files are joined into one module script, so that
 * the page is one file that opens without a server. This file is the last: it uses all others.
 *
 * Order of the files:
 *   elements.js formatting.js decoding.js records.js selection.js colormaps.js theme.js
 *   shaders.js surface.js frusta.js orbit.js painter.js scene.js view.js
 *   charts.js summary.js photos.js projection.js picture.js matches.js groups.js
 *   directions.js coverage.js cameras.js stages.js notes.js page.js
 */

/** What all sections work from. */
function readPage() {
  const read = (id) => JSON.parse(document.getElementById(id).textContent) ?? {};
  const report = read('report');
  const material = read('material');
  const photos = photoRecords(report, material);
  const pairs = pairRecords(report, photos);
  return {
    report, material, photos, pairs, partners: partnersOf(photos, pairs),
    selection: makeSelection(photos), isViewer: material.viewer === true, view: null,
  };
}

function buildReport(page, main) {
  const { report, photos, material, selection } = page;
  // The button prints in light colors; the view copies itself for print after that.
  const theme = themeButton();
  // The view comes first, because other sections refer to it.
  const model = modelSection(page);
  const matches = matchesSection(page);
  // What keeps groups apart explains why a run failed.
  const isSplit = photoGroups(photos).length > 1;
  const sections = [
    adviceSection(report, photos, selection, page.view?.showPlaces),
    model,
    isSplit ? matches : null,
    photosSection(page),
    isSplit ? null : matches,
    coverageSection(page),
    camerasSection(report),
    stagesSection(report),
    notesSection(report, material),
  ].filter(Boolean);
  main.replaceChildren(summaryHeader(report, photos, pageTitle(report)), ...sections);
  const links = sections.map((each) => element('a', { href: `#${each.id}` },
    NAVIGATION[each.id]));
  document.getElementById('bar').append(
    element('nav', { 'aria-label': 'Sections' }, links), theme);
}

/** Short names of the sections. */
const NAVIGATION = {
  advice: 'Next steps', model: 'Model', photos: 'Photos', matches: 'Matches',
  coverage: 'Coverage', cameras: 'Cameras', stages: 'Time', notes: 'Notes',
};

function buildViewer(page, main) {
  const theme = themeButton();
  const view = sceneView(page);
  page.view = view;
  document.body.classList.add('viewer');
  document.getElementById('bar').append(
    element('h1', {}, element('bdi', {}, pageTitle(page.report))), theme);
  const facts = list(page.material.facts).filter((fact) => list(fact).length >= 2)
    .map(([term, value]) => [String(term), String(value)]);
  main.replaceChildren(view.element);
  const panel = main.querySelector('.panel') ?? main;
  const figures = figureList(facts, 'facts');
  const field = panel.querySelector('.field');
  if (figures && field) field.after(figures);
  else if (figures) panel.prepend(figures);
  panel.append(...[libraryLicense(page.material.library)].filter(Boolean));
}

function pageTitle(report) {
  return String(report.run?.name || document.title || 'Report');
}

/** The first complete frame: all pictures in sight are decoded and the 3-D view is drawn. */
async function markReady(page) {
  await page.view?.ready;
  // Not those of tables: to ask where one of them lies would lay out a thousand hidden ones.
  const images = [...document.images].filter((image) => !image.closest('td')).slice(0, 40);
  await Promise.all(images.map((image) => image.decode().catch(() => {})));
  await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  document.documentElement.dataset.ready = '1';
}

function startPage() {
  const page = readPage();
  const main = document.getElementById('main');
  if (page.isViewer) buildViewer(page, main);
  else buildReport(page, main);
  // For tests: a browser clears a WebGL canvas after each frame, so they draw before they read it.
  globalThis.photogrammetryReport = { draw: () => page.view?.scene?.draw() };
  return markReady(page);
}

await startPage();

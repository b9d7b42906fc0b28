/** Warnings, details, all settings, versions and licenses: what the curious and the expert need. */
function notesSection(report, material) {
  const run = report.run ?? {};
  const cores = isNumber(run.cores) ? plural(run.cores, 'core') : null;
  return section('notes', 'Notes and settings', null,
    textList('warnings', 'Warnings', report.warnings, true),
    textList('details', 'Details', report.details, false),
    settingsTree(report.configuration),
    figureList([
      ['Program', run.program], ['System', run.system],
      ['Machine', [run.processor, cores, byteCount(run.memoryBytes)].filter(Boolean).join(', ')
        || null],
      ['Format of the report', report.version ? String(report.version) : null],
    ], 'facts'),
    libraryLicense(material.library));
}

function textList(id, title, texts, isOpen) {
  if (list(texts).length === 0) return null;
  return element('details', { id, open: isOpen },
    element('summary', {}, `${title} (${texts.length})`),
    element('ul', {}, texts.map((text) => element('li', {}, String(text)))));
}

function settingsTree(configuration) {
  if (!configuration || Object.keys(configuration).length === 0) return null;
  return branch('All settings', configuration, { id: 'settings' });
}

/** A part of the settings; its contents are made when it is opened. */
function branch(title, value, attributes = {}) {
  const details = element('details', attributes, element('summary', {}, title));
  details.addEventListener('toggle', () => details.append(leaves(value)), { once: true });
  return details;
}

function leaves(value) {
  const isTree = (each) => typeof each === 'object' && Object.keys(each ?? {}).length > 0;
  const entries = Object.entries(value);
  return element('div', { class: 'settings' },
    entries.filter(([, each]) => !isTree(each)).map(([key, each]) => element('p', {},
      element('code', {}, key), ' ', element('span', {}, settingText(each)))),
    entries.filter(([, each]) => isTree(each)).map(([key, each]) => branch(key, each)));
}

function settingText(value) {
  if (value === null || value === undefined) return 'not set';
  if (typeof value === 'object') return 'none';
  return typeof value === 'boolean' ? (value ? 'yes' : 'no') : String(value);
}

function libraryLicense(library) {
  if (!library?.license || !graphicsLibrary()) return null;
  return element('details', { id: 'library' },
    element('summary', {}, `The 3-D view is drawn by ${library.name ?? 'a library'}`),
    element('pre', {}, String(library.license)));
}

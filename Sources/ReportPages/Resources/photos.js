/** What became of a photo: a word and a sign. */
const STATUSES = {
  registered: ['Used', '✓', 'good'], refused: ['Refused', '✕', 'failed'],
  notRegistered: ['Not used', '✕', 'failed'], missing: ['Not read', '✕', 'failed'],
};

/** The same before a run, when the photos have only been examined. */
const PLANNED_STATUSES = {
  registered: ['Usable', '✓', 'good'], notRegistered: ['Not linked', '✕', 'failed'],
};

function statusBadge(photo) {
  const statuses = photo.isPlanned ? { ...STATUSES, ...PLANNED_STATUSES } : STATUSES;
  const known = Object.hasOwn(statuses, photo.status ?? '') ? statuses[photo.status] : null;
  const [word, sign, level] = known ?? [wordsOf(photo.status ?? 'unknown'), '?', 'unknown'];
  return element('span', { class: `badge ${level}` },
    element('span', { class: 'sign', 'aria-hidden': 'true' }, sign), word);
}

/**
 * The photo's thumbnail with the outline of its mask; a dotted box if it has no picture. It isn't
 * loaded lazily: the data is in the page, and a lazy picture would be missing in print. It is
 * decoded when it is painted.
 */
function thumbnail(photo) {
  if (!photo.picture) return element('span', { class: 'thumbnail empty' }, 'no picture');
  const { picture, width = 4, height = 3 } = photo.picture;
  const box = element('span', { class: 'thumbnail' },
    element('img', { src: picture, alt: '', decoding: 'async', width, height }));
  const outlines = list(photo.picture.outlines);
  if (outlines.length > 0) box.append(outlineDrawing(photo.picture));
  return box;
}

/** The mask's outlines as a drawing that lies over the picture. */
function outlineDrawing({ outlines, width = 4, height = 3 }) {
  return drawing('svg', {
    class: 'outlines', viewBox: `0 0 ${width} ${height}`, 'aria-hidden': 'true',
  }, decodedOutlines(outlines, width, height).map((points) => drawing('polygon', { points })));
}

/** The columns with numbers: key, title, unit, explanation, text of a photo's value. */
const PHOTO_COLUMNS = [
  ['features', 'Features', '', 'Distinct spots that can be found again in other photos', 0],
  ['observations', 'Observations', '', 'Points of the model that were found in this photo', 0],
  ['meanResidual', 'Mean error', 'px', 'How far these points land from where the photo shows them',
    3],
  ['residual95', '95 % below', 'px', '95 of 100 points land closer than this', 2],
  ['partners', 'Partners', '', 'Other photos that show the same spots', 0],
  ['maskAgreement', 'Mask agrees', '%', 'How well the object’s outline fits the outlines of the '
    + 'other photos', 0],
  ['maskShare', 'Object', '%', 'Share of the photo that the object fills', 0],
  ['sharpness', 'Sharpness', '%', 'Share of the pixels that hold detail; 100 % is sharp', 0],
  ['exposure', 'Exposure', 'EV', 'Brighter (+) or darker (−) than the mean of the photos', 2],
  ['textureShare', 'Texture', '%', 'Share of the surface that has its color from this photo', 1],
].map(([key, title, unit, explanation, digits]) => ({
  key, title, unit, explanation,
  text: (value) => {
    if (!isNumber(value)) return MISSING;
    if (key === 'exposure') return signed(value, digits);
    return decimal(unit === '%' ? value * 100 : value, digits);
  },
}));

/** The table of all photos: those that aren't used first, with the reason. */
function photosSection(page) {
  const { photos, selection } = page;
  if (photos.length === 0) return null;
  const columns = PHOTO_COLUMNS.filter(({ key }) => photos.some((photo) => isNumber(photo[key])));
  const rows = new Map(photos.map((photo) => [photo, photoRow(photo, columns, selection)]));
  const body = element('tbody', {}, defaultOrder(photos).map((photo) => rows.get(photo)));
  // Pictures that can't be seen aren't laid out; a page with few is better complete at once.
  const table = element('table', { id: 'photo-table', class: photos.length > 100 ? 'many' : null },
    element('caption', { class: 'hidden' }, 'All photos; the column titles sort'),
    element('thead', {}, photoHeads(columns, photos, rows, body)), body);
  followRowKeys(body);
  selection.follow((photo) => markRow(rows, photo));
  const unused = photos.filter((photo) => !photo.isUsed).length;
  const lead = `${unused > 0 ? 'Photos that were not used come first. ' : ''}Select a row to see `
    + 'the photo large; the white line is the outline of the object that was found.';
  return section('photos', 'Photos', lead,
  unused > 0 && photoFilter(photos.length, unused, table),
  scroller('Table of photos', table),
  pictureView(page));
}

/** Photos with a fault of their own, then those that fit no other, then those that are used. */
function defaultOrder(photos) {
  const rank = (photo) => (photo.isUsed ? 2 : Number(photo.status === 'notRegistered'));
  return [...photos].sort((a, b) => rank(a) - rank(b) || a.index - b.index);
}

function photoRow(photo, columns, selection) {
  return element('tr', {
    tabindex: -1, 'data-index': photo.index, class: photo.isUsed ? null : 'unused',
    onclick: () => selection.select(photo),
  },
  element('td', {}, thumbnail(photo)),
  element('th', { scope: 'row' }, nameElement(photo)),
  element('td', { class: 'reason' }, statusBadge(photo),
    photo.reason && element('p', {}, String(photo.reason))),
  columns.map(({ key, text }) => element('td', { class: 'number' }, text(photo[key]))));
}

/** The titles of the columns, as buttons that sort. */
function photoHeads(columns, photos, rows, body) {
  const heads = [];
  function head(title, unit, explanation, valueOf, isNumeric) {
    const cell = element('th', { scope: 'col', class: isNumeric ? 'number' : null },
      element('button', { type: 'button', title: explanation, onclick: () => sort(cell, valueOf) },
        title, unit && element('small', {}, ` ${unit}`)));
    heads.push(cell);
    return cell;
  }
  function sort(cell, valueOf) {
    const isAscending = cell.getAttribute('aria-sort') !== 'ascending';
    for (const each of heads) each.removeAttribute('aria-sort');
    cell.setAttribute('aria-sort', isAscending ? 'ascending' : 'descending');
    const sign = isAscending ? 1 : -1;
    const sorted = [...photos].sort((a, b) => compare(valueOf(a), valueOf(b), sign));
    body.append(...sorted.map((photo) => rows.get(photo)));
  }
  return element('tr', {},
    element('th', { scope: 'col' }, 'Picture'),
    head('Photo', '', 'Name of the file', (photo) => photo.name),
    head('Verdict', '', 'What became of the photo, and why',
      (photo) => (photo.isUsed ? 1 : 0)),
    columns.map(({ key, title, unit, explanation }) =>
      head(title, unit, explanation, (photo) => photo[key], true)));
}

/** Compares numbers or names; a missing value comes last in both directions. */
function compare(a, b, sign) {
  const isMissing = (value) => value === null || value === undefined;
  if (isMissing(a) || isMissing(b)) return isMissing(a) - isMissing(b);
  if (typeof a === 'string') return sign * a.localeCompare(b, 'en', { numeric: true });
  return sign * (a - b);
}

function photoFilter(count, unused, table) {
  const choice = (value, text, isChecked) => element('label', {},
    element('input', {
      type: 'radio', name: 'photo-filter', id: `filter-${value}`, value, checked: isChecked,
      onchange: () => { table.dataset.filter = value; },
    }), text);
  return element('fieldset', { class: 'filter' },
    element('legend', { class: 'hidden' }, 'Photos in the table'),
    choice('all', `All ${decimal(count)}`, true),
    choice('unused', `Not used: ${decimal(unused)}`, false));
}

/** Only one row is reached by the tab key; from there, arrows and Enter go on. */
function followRowKeys(body) {
  body.addEventListener('keydown', (event) => {
    const row = event.target.closest('tr');
    if (!row || event.target !== row) return;
    const next = (sibling) => {
      let found = row[sibling];
      while (found && found.offsetParent === null) found = found[sibling];
      return found;
    };
    const target = {
      ArrowDown: () => next('nextElementSibling'), ArrowUp: () => next('previousElementSibling'),
    }[event.key]?.();
    if (target) target.focus();
    else if (event.key === 'Enter' || event.key === ' ') row.click();
    else return;
    event.preventDefault();
  });
}

function markRow(rows, photo) {
  for (const [each, row] of rows) {
    const isSelected = each === photo;
    if (isSelected === row.hasAttribute('aria-current')) continue;
    if (isSelected) row.setAttribute('aria-current', 'true');
    else row.removeAttribute('aria-current');
    row.tabIndex = isSelected ? 0 : -1;
  }
  const row = rows.get(photo);
  const scroller = row?.closest('.scroller');
  if (!scroller) return;
  // `scrollIntoView` would also scroll the page, away from where the photo was selected.
  const head = row.closest('table').tHead.offsetHeight;
  const top = row.offsetTop - head;
  const bottom = row.offsetTop + row.offsetHeight - scroller.clientHeight;
  if (scroller.scrollTop > top) scroller.scrollTop = top;
  else if (scroller.scrollTop < bottom) scroller.scrollTop = bottom;
}

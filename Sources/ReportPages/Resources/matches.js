/** Above this number of photos, the matrix is painted: a million SVG elements hang a browser. */
const MAXIMUM_DRAWN_PHOTOS = 60;

/** Which photos were compared, what they share, and what keeps groups apart. */
function matchesSection(page) {
  const { photos, pairs, selection } = page;
  if (pairs.length === 0) return null;
  return section('matches', 'Which photos belong together',
    'Photos are joined where they show the same spots. A model needs one group: photos that '
    + 'overlap like the links of a chain.',
    groupsView(page),
    matchMatrix(photos, pairs, selection));
}

/** The photos in the order of their groups, so that each group is one square. */
function matrixOrder(photos) {
  const rank = (photo) => (isNumber(photo.group) ? photo.group : Infinity);
  return [...photos].sort((a, b) => rank(a) - rank(b) || a.index - b.index || 0);
}

function matchMatrix(photos, pairs, selection) {
  const order = matrixOrder(photos);
  const place = new Map(order.map((photo, i) => [photo, i]));
  const used = pairs.filter((pair) => pair.needed === 0 && pair.matches > 0);
  const most = largest(used.map((pair) => pair.matches)) || 1;
  const least = used.reduce((low, pair) => Math.min(low, pair.matches), most);
  const share = (matches) => Math.log(matches / least) / (Math.log(most / least) || 1);
  const cells = pairs.map((pair) => ({
    pair, row: place.get(pair.first), column: place.get(pair.second),
    color: pair.needed > 0 ? null : cssColor(viridis(share(pair.matches))),
  }));
  const readout = element('p', { id: 'match-readout', class: 'hint', 'aria-live': 'polite' },
    'Point at a square to read its numbers; click it to select the photo of its row.');
  const label = `Matrix of ${photos.length} photos: ${decimal(used.length)} pairs are used, `
    + `${decimal(pairs.length - used.length)} share too little.`;
  const graph = order.length > MAXIMUM_DRAWN_PHOTOS
    ? paintedMatrix(order.length, cells, label) : drawnMatrix(order, cells, label);
  followMatrixPointer(graph.element, graph.frame, order, cells, readout, selection);
  return element('figure', { class: 'matrix' },
    element('figcaption', {}, element('h3', {}, 'Matches between all photos'),
      element('p', {}, 'Row and column are photos; the color is the number of spots that both '
        + 'show.')),
    element('div', { class: 'matrix-body', style: `--count: ${order.length}` }, graph.element,
      element('div', {}, matrixLegend(least, most), readout, pairFigures(pairs, used))));
}

function pairFigures(pairs, used) {
  return figureList([
    ['Pairs compared', decimal(pairs.length)], ['Pairs used', decimal(used.length)],
    ['Median matches of a used pair',
      used.length > 0 ? decimal(median(used.map((pair) => pair.matches))) : null],
  ], 'facts');
}

function drawnMatrix(order, cells, label) {
  const count = order.length;
  const names = count <= 40 ? order.map((photo) => shortName(photo.name)) : [];
  const margin = names.length > 0
    ? Math.min(largest(names.map((name) => name.length)) * 7.3 + 8, 130) : 4;
  const side = 560;
  const cell = (side - margin) / count;
  const square = (row, column, color) => {
    const inset = color ? 0.4 : cell * 0.34;
    return drawing('rect', {
      class: color ? null : 'lacking', fill: color,
      x: (margin + column * cell + inset).toFixed(1), y: (margin + row * cell + inset).toFixed(1),
      width: (cell - 2 * inset).toFixed(1), height: (cell - 2 * inset).toFixed(1),
    });
  };
  const svg = drawing('svg', { id: 'match-matrix', viewBox: `0 0 ${side} ${side}`, role: 'img',
    'aria-label': label },
  drawing('rect', { class: 'ground', x: margin, y: margin, width: side - margin,
    height: side - margin }),
  cells.flatMap(({ row, column, color }) =>
    [square(row, column, color), square(column, row, color)]),
  matrixNames(names, margin, cell));
  return { element: svg, frame: { margin: margin / side, count } };
}

function matrixNames(names, margin, cell) {
  return names.flatMap((name, i) => {
    const at = margin + (i + 0.5) * cell + 4;
    const transform = `translate(${at} ${margin - 5}) rotate(-90)`;
    return [drawing('text', { class: 'tick end', x: margin - 5, y: at }, name),
      drawing('text', { class: 'tick start', transform }, name)];
  });
}

function paintedMatrix(count, cells, label) {
  const cell = Math.max(1, Math.floor(1120 / count));
  const canvas = element('canvas', { id: 'match-matrix', role: 'img', 'aria-label': label,
    width: cell * count, height: cell * count });
  const context = canvas.getContext('2d');
  const gap = cell > 4 ? 1 : 0;
  const paint = () => {
    context.clearRect(0, 0, canvas.width, canvas.height);
    const muted = cssColor(themeColor('--muted').map((value) => Math.round(value * 255)));
    for (const { row, column, color } of cells) {
      const inset = color ? 0 : Math.floor(cell * 0.3);
      const size = Math.max(1, cell - gap - 2 * inset);
      context.fillStyle = color ?? muted;
      context.fillRect(column * cell + inset, row * cell + inset, size, size);
      context.fillRect(row * cell + inset, column * cell + inset, size, size);
    }
  };
  paint();
  followTheme(paint);
  return { element: canvas, frame: { margin: 0, count } };
}

/** The end of a long name differs more often than its start. */
function shortName(name) {
  const stem = name.replace(/\.\w{1,5}$/, '');
  return stem.length > 17 ? `…${stem.slice(-16)}` : stem;
}

function followMatrixPointer(graph, { margin, count }, order, cells, readout, selection) {
  const byPlace = new Map(cells.flatMap((cell) => [
    [cell.row * count + cell.column, cell.pair], [cell.column * count + cell.row, cell.pair]]));
  const placeOf = (event) => {
    const box = graph.getBoundingClientRect();
    const at = (value, size) => Math.floor(((value / size - margin) / (1 - margin)) * count);
    const row = at(event.clientY - box.top, box.height);
    const column = at(event.clientX - box.left, box.width);
    const isInside = Math.min(row, column) >= 0 && Math.max(row, column) < count;
    return isInside && row !== column ? { row, column } : null;
  };
  graph.addEventListener('pointermove', (event) => {
    const place = placeOf(event);
    if (!place) return;
    const [first, second] = [order[place.row], order[place.column]];
    readout.replaceChildren(nameElement(first), ' and ', nameElement(second), ': ',
      pairSentence(byPlace.get(place.row * count + place.column)));
  });
  graph.addEventListener('click', (event) => {
    const place = placeOf(event);
    if (place) selection.select(order[place.row]);
  });
}

function pairSentence(pair) {
  if (!pair) return 'not compared.';
  const matches = plural(pair.matches, 'match', 'matches');
  if (pair.needed > 0) return `${matches}; ${decimal(pair.needed)} are needed.`;
  const angle = isNumber(pair.degrees) && pair.degrees > 0
    ? `, seen from directions ${decimal(pair.degrees, 1)}° apart` : '';
  return `${matches}${angle}.`;
}

function matrixLegend(least, most) {
  const middle = Math.round(Math.sqrt(least * most));
  return element('div', { class: 'legend inline' },
    element('div', { class: 'gradient', style: `background:${viridisGradient()}` }),
    element('div', { class: 'ends' },
      element('span', {}, decimal(least)), element('span', {}, decimal(middle)),
      element('span', {}, `${decimal(most)} matches`)),
    element('span', { class: 'swatch' }, element('i', { class: 'lacking' }),
      'compared, but too few matches'),
    element('span', { class: 'swatch' }, element('i', { class: 'ground' }), 'not compared'));
}

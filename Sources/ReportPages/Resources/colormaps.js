/** Viridis at nine equidistant places; between them, linear interpolation errs by less than 2 %. */
const VIRIDIS = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141],
  [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37],
];

/** Light gray for "no data"; viridis has no gray, so the two can't be confused. */
const NO_DATA = [200, 200, 200];

/** The color of a share (0…1) as three bytes. */
function viridis(share) {
  const at = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(at), VIRIDIS.length - 2);
  return VIRIDIS[low].map((value, i) =>
    Math.round(value + (at - low) * (VIRIDIS[low + 1][i] - value)));
}

function cssColor(bytes) {
  return `rgb(${bytes.join(' ')})`;
}

function viridisGradient() {
  return `linear-gradient(to right, ${VIRIDIS.map(cssColor).join(', ')})`;
}

/** The legend of a map of the surface: colors, the numbers at both ends, the unit. */
function mapLegend(map) {
  if (map.key === 'closed') {
    return element('div', { class: 'legend' },
      element('strong', {}, 'Closed by guess'),
      swatch(CLOSED, 'No photo shows this; closed by guess'),
      swatch(SHOWN, 'Shown by photos'));
  }
  const unit = map.unit ? ` ${map.unit}` : '';
  const number = (value) => significant(value, 3);
  const middle = (map.low + map.high) / 2;
  return element('div', { class: 'legend' },
    element('strong', {}, map.name),
    element('div', { class: 'gradient', style: `background:${viridisGradient()}` }),
    element('div', { class: 'ends' },
      element('span', {}, number(map.low)),
      element('span', {}, number(middle)),
      element('span', {}, `${map.clipped ? '≥\u00a0' : ''}${number(map.high)}${unit}`)),
    swatch(NO_DATA, 'No data'));
}

function swatch(bytes, text) {
  return element('span', { class: 'swatch' },
    element('i', { style: `background:${cssColor(bytes)}` }), text);
}

/** Colors of the map of closed surface, which has two values only. */
const CLOSED = [232, 119, 34];
const SHOWN = [214, 219, 222];

/** One sentence for each map of the surface. */
const MAP_EXPLANATIONS = {
  photos: 'How many photos show each spot. Three or more make it reliable.',
  reprojection: 'How far points of the surface land from where the photos show them.',
  photometric: 'How much the photos disagree about the color of a spot: movement, gloss or '
    + 'changing light.',
  uncertainty: 'How far the surface may lie from where it is drawn.',
  distance: 'How far the surface is from the reference.',
};

/** How well the photos cover the object, and how well they fit together. */
function coverageSection(page) {
  const { report } = page;
  const surface = report.surface ?? {};
  const unit = report.worldFrame?.scale && report.worldFrame.scale !== 'arbitrary';
  const charts = [directionsChart(page), ...histograms(report)].filter(Boolean);
  const uncertainty = surface.medianUncertainty;
  return section('coverage', 'Coverage and accuracy', null,
    figureList([
      ['of the surface closed by guess', percent(surface.closedShare), 'no photo shows it'],
      ['median disagreement of colors', measure(surface.medianPhotometricResidual, 1, 'of 255'),
        'between photos that show the same spot'],
      ['median uncertainty', isNumber(uncertainty)
        ? (unit ? `${significant(uncertainty * 1000, 2)}\u00a0mm` : significant(uncertainty, 2))
        : null, unit ? 'of the surface’s position' : 'of the surface’s position, in model units'],
    ], 'figures'),
    charts.length > 0 && element('div', { class: 'charts' }, charts));
}

function histograms(report) {
  return [surfacePhotosChart(list(report.surface?.photosHistogram)),
    trackLengthChart(list(report.tracks?.lengths)),
    residualChart(report.tracks ?? {})].filter(Boolean);
}

function surfacePhotosChart(shares) {
  const few = total(shares.slice(0, 3));
  const last = Math.max(shares.findLastIndex((share) => share > 0), 6);
  const shown = shares.slice(0, last + 1);
  return barChart({
    title: 'Photos that show the surface',
    sentence: `${percent(few)} of the surface is shown by fewer than three photos.`,
    labels: shown.map((_, i) => (i === 24 ? '24+' : String(i))), values: shown, marked: 3,
    horizontal: 'photos (fewer than three are set off)', vertical: 'share of the surface',
    format: (share) => `${significant(share * 100, 2)}\u00a0%`,
  });
}

function trackLengthChart(lengths) {
  const last = lengths.findLastIndex((count) => count > 0);
  const shown = lengths.slice(2, last + 1);
  const mean = total(lengths.map((count, i) => count * i)) / total(lengths);
  return barChart({
    title: 'Photos per point',
    sentence: `A point was found in ${decimal(mean, 1)} photos on average. More is more accurate.`,
    labels: shown.map((_, i) => String(i + 2)), values: shown,
    horizontal: 'photos in which a point was found', vertical: 'points',
    format: (count) => decimal(count),
  });
}

function residualChart({ residualStep: step, residuals }) {
  const values = list(residuals);
  if (!isNumber(step) || !(step > 0)) return null;
  const last = values.findLastIndex((count) => count > 0);
  const digits = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)) || 0;
  const isOpen = last === values.length - 1;
  const shown = values.slice(0, last + 1);
  const half = total(values) / 2;
  let sum = 0;
  const middle = values.findIndex((count) => { sum += count; return sum >= half; });
  return barChart({
    title: 'Reprojection errors',
    sentence: `Half of the points land within ${decimal((middle + 1) * step, 2)} pixels of where `
      + 'the photo shows them.',
    labels: shown.map((_, i) => (i === last && isOpen ? '≥ ' : '') + decimal(i * step, digits)),
    values: shown, horizontal: 'error in pixels, from', vertical: 'observations',
    format: (count) => decimal(count),
  });
}

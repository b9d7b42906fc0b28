/** About `count` round numbers from 0 to at least `high`: steps are 1, 2 or 5 times 10ⁿ. */
function roundTicks(high, count = 4) {
  if (!(high > 0)) return [0, 1];
  const raw = high / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((factor) => factor * power >= raw * 0.999) * power;
  const ticks = [];
  for (let i = 0; i <= Math.ceil(high / step - 1e-9); i += 1) ticks.push(i * step);
  return ticks;
}

/**
 * A bar chart with axes, as a figure with a title and a sentence. Its numbers are also readable
 * without the picture: as a table in the figure's details.
 *
 * @param {{title: string, sentence: string, labels: string[], values: number[],
 *   horizontal: string, vertical: string, format: function(number): string, marked: ?number}} chart
 *   the first `marked` bars are set off
 */
function barChart(chart) {
  const values = chart.values.map((value) => (isNumber(value) && value > 0 ? value : 0));
  if (total(values) === 0) return null;
  const box = { left: 52, right: 356, top: 30, bottom: 190 };
  const ticks = roundTicks(largest(values));
  const high = ticks[ticks.length - 1];
  const width = (box.right - box.left) / values.length;
  const yOf = (value) => box.bottom - (value / high) * (box.bottom - box.top);
  const bars = values.map((value, i) => drawing('rect', {
    class: i < (chart.marked ?? 0) ? 'bar marked' : 'bar',
    x: (box.left + (i + 0.1) * width).toFixed(2), y: yOf(value).toFixed(2),
    width: (width * 0.8).toFixed(2), height: (box.bottom - yOf(value)).toFixed(2),
  }, drawing('title', {}, `${chart.labels[i]}: ${chart.format(value)}`)));
  const graph = drawing('svg', {
    viewBox: '0 0 360 232', role: 'img', 'aria-label': `${chart.title}. ${chart.sentence}`,
  }, horizontalRules(ticks, box, yOf, chart.format), bars, barLabels(chart.labels, box, width),
  drawing('text', { class: 'axis', x: (box.left + box.right) / 2, y: 228 }, chart.horizontal),
  drawing('text', { class: 'axis start', x: 0, y: 12 }, chart.vertical));
  return element('figure', { class: 'chart' },
    element('figcaption', {}, element('h3', {}, chart.title), element('p', {}, chart.sentence)),
    graph, chartNumbers(chart, values));
}

function horizontalRules(ticks, box, yOf, format) {
  return ticks.map((tick) => [
    drawing('line', { class: 'rule', x1: box.left, x2: box.right, y1: yOf(tick), y2: yOf(tick) }),
    drawing('text', { class: 'tick end', x: box.left - 6, y: yOf(tick) + 4 }, format(tick)),
  ]);
}

/** As many labels as fit without touching each other, always with the last. */
function barLabels(labels, box, width) {
  const longest = Math.max(...labels.map((label) => label.length));
  const stride = Math.max(1, Math.ceil((longest * 7 + 8) / width));
  const last = labels.length - 1;
  return labels.map((label, i) => {
    if (i !== last && (i % stride !== 0 || (last - i) < stride)) return null;
    const x = box.left + (i + 0.5) * width;
    return drawing('text', { class: 'tick', x: x.toFixed(1), y: box.bottom + 16 }, label);
  });
}

function chartNumbers(chart, values) {
  return element('details', { class: 'numbers' },
    element('summary', {}, 'Numbers'),
    element('table', {},
      element('thead', {}, element('tr', {},
        element('th', { scope: 'col' }, chart.horizontal),
        element('th', { scope: 'col', class: 'number' }, chart.vertical))),
      element('tbody', {}, values.map((value, i) => element('tr', {},
        element('th', { scope: 'row' }, chart.labels[i]),
        element('td', { class: 'number' }, chart.format(value)))))));
}

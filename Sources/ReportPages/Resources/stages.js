/** What the stages do, in words for somebody who takes photos. */
const STAGE_NAMES = {
  preProcessing: 'Reading photos', imageAlignment: 'Finding the cameras',
  objectMasking: 'Finding the object', pointCloudGeneration: 'Measuring points',
  meshGeneration: 'Building the surface', textureMapping: 'Coloring the surface',
  optimization: 'Writing files',
};

function stageName(stage) {
  const name = stage.name ?? 'unnamed';
  return Object.hasOwn(STAGE_NAMES, name) ? STAGE_NAMES[name] : wordsOf(name);
}

/** When each stage ran, how much of it used one core only, and the memory meanwhile. */
function stagesSection(report) {
  const stages = timedStages(report);
  const end = Math.max(largest(stages.map((stage) => stage.start + stage.seconds)),
    report.run?.seconds ?? 0);
  if (stages.length === 0 || !(end > 0)) return null;
  const serial = total(stages.map((stage) => stage.serialSeconds));
  const cores = report.run?.threads ?? report.run?.cores;
  const lead = [
    `The run took ${duration(report.run?.seconds ?? end)}`,
    isNumber(cores) && ` on ${plural(cores, 'core')}`,
    serial > 0 && `; for ${duration(serial)} of it, only one core worked (striped)`,
  ].filter(Boolean).join('');
  return section('stages', 'Time and memory', `${lead}.`,
    element('div', { class: 'timeline' },
      stages.map((stage) => stageRow(stage, end)), memoryRow(report.memory, end), timeAxis(end)),
    stageDetails(stages));
}

/** The stages with their starts; where these weren't recorded, one follows the other. */
function timedStages(report) {
  let clock = 0;
  return list(report.stages).filter((stage) => isNumber(stage?.seconds)).map((stage) => {
    const start = isNumber(stage.start) ? stage.start : clock;
    clock = start + stage.seconds;
    return { ...stage, start };
  });
}

function stageRow(stage, end) {
  const share = (seconds) => `${((100 * seconds) / end).toFixed(2)}%`;
  const serial = Math.min(stage.serialSeconds ?? 0, stage.seconds);
  const bar = element('div', { class: 'stage-bar',
    style: `left:${share(stage.start)};width:${share(stage.seconds)}` },
  serial > 0 && element('i', { style: `width:${((100 * serial) / stage.seconds).toFixed(1)}%` }));
  const figures = [duration(stage.seconds), byteCount(stage.peakMemoryBytes)].filter(Boolean);
  return element('div', { class: 'timeline-row' },
    element('span', { class: 'timeline-name' }, stageName(stage)),
    element('div', { class: 'timeline-track', 'aria-hidden': 'true' }, bar),
    element('span', { class: 'timeline-figure' }, figures.join(', ')));
}

function memoryRow(memory, end) {
  const samples = list(memory?.bytes).filter(isNumber);
  const times = list(memory?.seconds).filter(isNumber);
  if (samples.length < 2 || times.length !== samples.length) return null;
  const peak = largest(samples);
  const x = (i) => Math.min((1000 * times[i]) / end, 1000).toFixed(1);
  const line = samples.map((value, i) => `${x(i)},${(100 - (96 * value) / peak).toFixed(1)}`);
  const area = `${x(0)},100 ${line.join(' ')} ${x(samples.length - 1)},100`;
  return element('div', { class: 'timeline-row memory' },
    element('span', { class: 'timeline-name' }, 'Memory'),
    element('div', { class: 'timeline-track' },
      drawing('svg', { viewBox: '0 0 1000 100', preserveAspectRatio: 'none', role: 'img',
        'aria-label': `Memory over time, at most ${byteCount(peak)}` },
      drawing('polygon', { points: area }), drawing('polyline', { points: line.join(' ') }))),
    element('span', { class: 'timeline-figure' }, `at most ${byteCount(peak)}`));
}

function timeAxis(end) {
  const ticks = roundTicks(end, 6).filter((tick) => tick <= end);
  return element('div', { class: 'timeline-row axis' },
    element('span', { class: 'timeline-name' }),
    element('div', { class: 'timeline-track' }, ticks.map((tick) =>
      element('span', { style: `left:${((100 * tick) / end).toFixed(2)}%` },
        tick === 0 ? '0 s' : duration(tick).replace('.0', '')))),
    element('span', { class: 'timeline-figure' }));
}

/** All numbers of the stages and their steps, for those who look for the slow part. */
function stageDetails(stages) {
  const cell = (text) => element('td', { class: 'number' }, text ?? MISSING);
  const row = (each, name, className) => element('tr', { class: className },
    element('th', { scope: 'row' }, name), cell(duration(each.seconds)),
    cell(duration(each.cpuSeconds)), cell(duration(each.serialSeconds)),
    cell(byteCount(each.peakMemoryBytes)));
  const head = (text) => element('th', { scope: 'col', class: 'number' }, text);
  return element('details', {}, element('summary', {}, 'Steps of the stages and their results'),
    scroller('Table of steps', element('table', {},
      element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, 'Stage'),
        head('Time'), head('Time of all cores'), head('One core only'), head('Peak memory'))),
      element('tbody', {}, stages.flatMap((stage) => [
        row(stage, stageName(stage)),
        ...list(stage.steps).map((step) => row(step, wordsOf(step.name), 'step')),
        stageCounts(stage),
      ])))));
}

function stageCounts(stage) {
  const counts = Object.entries(stage.counts ?? {}).filter(([, value]) => isNumber(value));
  if (counts.length === 0) return null;
  const texts = counts.map(([key, value]) => `${wordsOf(key).toLowerCase()} `
    + (Number.isInteger(value) ? decimal(value) : significant(value)));
  return element('tr', { class: 'counts' }, element('td', { colspan: 5 }, texts.join(' · ')));
}

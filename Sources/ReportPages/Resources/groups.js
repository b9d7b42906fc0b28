/** How many groups are described each; the rest is summed up. */
const MAXIMUM_GROUPS = 8;

/** The groups of photos in words, and for each the strongest link that did not suffice. */
function groupsView({ photos, pairs, selection }) {
  const groups = photoGroups(photos);
  if (groups.length === 0) return null;
  const loose = photos.filter((photo) => !isNumber(photo.group));
  if (groups.length === 1) {
    const sentence = loose.length === 0 ? 'All photos form one group.'
      : `${plural(groups[0].length, 'photo')} form one group; `
        + `${plural(loose.length, 'photo')} belong to none.`;
    return element('p', { class: 'groups-sentence' }, sentence);
  }
  const large = groups.filter((group) => group.length > 1).slice(0, MAXIMUM_GROUPS);
  const single = groups.filter((group) => group.length === 1).map(([photo]) => photo);
  return element('div', { id: 'groups', class: 'groups' },
    element('p', { class: 'groups-sentence' },
      `The photos form ${decimal(groups.length)} groups that share too little with each other.`),
    element('ol', {}, large.map((group, i) => groupItem(group, i, selection))),
    single.length > 0 && element('p', {}, `${plural(single.length, 'photo')} without a link to any `
      + 'other: ', ...nameRuns(single), '.'),
    loose.length > 0 && element('p', {}, `${plural(loose.length, 'photo')} that took no part in `
      + 'the comparison: ', ...nameRuns(loose), '.'),
    element('h3', {}, 'What is missing between them'),
    element('ul', { class: 'bridges' },
      bridges(large, pairs).map((bridge) => bridgeItem(bridge, selection)),
      single.slice(0, MAXIMUM_GROUPS).map((photo) => singleItem(photo, pairs, selection))));
}

/** The groups, the largest first. */
function photoGroups(photos) {
  const groups = new Map();
  for (const photo of photos) {
    if (!isNumber(photo.group)) continue;
    if (!groups.has(photo.group)) groups.set(photo.group, []);
    groups.get(photo.group).push(photo);
  }
  return [...groups.values()].sort((a, b) => b.length - a.length);
}

function groupItem(group, index, selection) {
  const ends = group.length > 6 ? [...group.slice(0, 3), ...group.slice(-3)] : group;
  return element('li', {},
    element('strong', {}, `Group ${index + 1}: ${plural(group.length, 'photo')}`), ' ',
    ...nameRuns(group), photoButtons(ends, selection));
}

/** Names, with runs of photos that follow each other as "first … last". */
function nameRuns(photos) {
  const runs = [];
  for (const photo of photos) {
    const run = runs[runs.length - 1];
    if (run && photo.index === run[run.length - 1].index + 1) run.push(photo);
    else runs.push([photo]);
  }
  const shown = runs.slice(0, 12);
  const texts = shown.flatMap((run, i) => {
    const last = run[run.length - 1];
    return [i > 0 && ', ', nameElement(run[0]),
      ...(run.length > 1 ? [run.length > 2 ? ' … ' : ', ', nameElement(last)] : [])];
  });
  return [...texts.filter(Boolean),
    ...(runs.length > shown.length ? [` and ${runs.length - shown.length} more`] : [])];
}

/** For each two groups, the pair between them that came closest to what is needed. */
function bridges(groups, pairs) {
  const groupOf = new Map(groups.flatMap((group, i) => group.map((photo) => [photo, i])));
  const best = new Map();
  for (const pair of pairs) {
    const [a, b] = [groupOf.get(pair.first), groupOf.get(pair.second)];
    if (a === undefined || b === undefined || a === b) continue;
    const key = a < b ? `${a} ${b}` : `${b} ${a}`;
    const isBetter = !best.has(key) || pair.matches > best.get(key).pair.matches;
    if (isBetter) best.set(key, { pair, groups: a < b ? [a, b] : [b, a] });
  }
  const linked = groups.flatMap((_, b) => groups.slice(0, b).map((_, a) =>
    best.get(`${a} ${b}`) ?? { pair: null, groups: [a, b] }));
  return linked.sort((x, y) => (y.pair?.matches ?? -1) - (x.pair?.matches ?? -1))
    .slice(0, MAXIMUM_GROUPS);
}

function bridgeItem({ pair, groups: [a, b] }, selection) {
  return linkItem(`Group ${a + 1} – group ${b + 1}: `, pair, selection);
}

/** A photo that is alone, and the pair by which it comes closest to another one. */
function singleItem(photo, pairs, selection) {
  const own = pairs.filter(({ first, second }) => first === photo || second === photo);
  const [best] = own.sort((a, b) => b.matches - a.matches);
  return linkItem([nameElement(photo), ' alone: '], best, selection);
}

function linkItem(title, pair, selection) {
  if (!pair) return element('li', {}, title, 'no compared photos show a common spot.');
  return element('li', {},
    element('p', {}, title, 'the strongest link is ', nameElement(pair.first), ' – ',
      nameElement(pair.second), ` with ${plural(pair.matches, 'match', 'matches')}`,
      pair.needed > 0 ? ` of ${decimal(pair.needed)} needed. ` : '. ',
      'Take photos from positions between these two.'),
    photoButtons([pair.first, pair.second], selection));
}

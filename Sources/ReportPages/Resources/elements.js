/**
 * Makes an HTML element. Children that are strings become text nodes, never markup: names of photos
 * and messages come from outside.
 *
 * @param {string} tag
 * @param {Object<string, *>} attributes `onclick` and the like add a listener; null and false omit.
 * @param {...(Node|string|null|Array)} children
 */
function element(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** Makes an SVG element; otherwise like `element`. */
function drawing(tag, attributes = {}, ...children) {
  return filled(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? '' : value);
  }
  const isPresent = (child) => child !== undefined && child !== null && child !== false;
  node.append(...children.flat(2).filter(isPresent));
  return node;
}

/** The name of a photo, isolated so that marks of right-to-left scripts affect nothing else. */
function nameElement(photo) {
  return element('bdi', { class: 'name' }, photo.name);
}

/** A section of the page, or null if it would be empty. */
function section(id, title, lead, ...content) {
  const present = content.flat().filter(Boolean);
  if (present.length === 0) return null;
  return element('section', { id, 'aria-labelledby': `${id}-title` },
    element('header', {},
      element('h2', { id: `${id}-title` }, title),
      lead && element('p', { class: 'lead' }, lead)),
    present);
}

/** A frame in which wide or long tables scroll, also by keys. */
function scroller(label, ...content) {
  return element('div', { class: 'scroller', tabindex: 0, role: 'region', 'aria-label': label },
    content);
}

/** A list of terms and figures; pairs without a figure are omitted. */
function figureList(pairs, className) {
  const present = pairs.filter(([, value]) => value !== null && value !== undefined);
  if (present.length === 0) return null;
  return element('dl', { class: className }, present.map(([term, value, explanation]) =>
    element('div', {},
      element('dt', {}, term, explanation && element('small', {}, explanation)),
      element('dd', {}, value))));
}

/** The button that goes round between the system's theme, light and dark. */
function themeButton() {
  const root = document.documentElement;
  const names = { system: 'System', light: 'Light', dark: 'Dark' };
  const themes = Object.keys(names);
  const button = element('button', { id: 'theme', type: 'button', onclick: advance });
  function show(theme) {
    root.dataset.theme = theme;
    button.textContent = `Theme: ${names[theme]}`;
    dispatchEvent(new Event('themechange'));
  }
  function advance() {
    show(themes[(themes.indexOf(root.dataset.theme) + 1) % themes.length]);
  }
  show('system');
  // Paper is white: print in light colors, whatever the screen shows.
  let shown = null;
  addEventListener('beforeprint', () => { shown = root.dataset.theme; show('light'); });
  addEventListener('afterprint', () => show(shown ?? 'system'));
  return button;
}

/** Calls the listener when the colors of the page change, by the button, the system or printing. */
function followTheme(listener) {
  addEventListener('themechange', listener);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', listener);
}

/** A color of the style sheet (`--ink` …) as three numbers 0…1, for WebGL and canvases. */
function themeColor(name) {
  const probe = element('span', { style: `color:var(${name})`, hidden: true });
  document.body.append(probe);
  const numbers = getComputedStyle(probe).color.match(/[\d.]+/g) ?? [];
  probe.remove();
  return [0, 1, 2].map((i) => Number(numbers[i] ?? 0) / 255);
}

/* theme.js: dark and light, and the colours of what is drawn. */

const KEY = 'muster-theme';
const dark = window.matchMedia('(prefers-color-scheme: dark)');

const NAMES = ['arena', 'grid', 'gridFine', 'faint', 'ink', 'soft', 'follower', 'leader', 'electing', 'absent',
               'dead', 'trouble', 'outline', 'nose', 'reference', 'vertex', 'vertexFree', 'vertexText', 'link', 'linkFar',
               'linkPicked', 'range', 'rangeEdge', 'picked', 'chartLine', 'chartFill', 'chartRest', 'accent', 'card'];

/* By the names above, of the theme in force. */
export const colours = {};

/* `changed` is called whenever the colours are others. */
export function startTheme(changed) {
  const apply = () => {
    document.documentElement.dataset.theme = chosen() ?? (dark.matches ? 'dark' : 'light');
    const style = getComputedStyle(document.documentElement);
    for (const name of NAMES) {
      const variable = name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
      colours[name] = style.getPropertyValue(`--${variable}`).trim();
    }
    changed();
  };
  dark.addEventListener('change', apply);
  apply();
  return () => {
    store(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark');
    apply();
  };
}

function chosen() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function store(theme) {
  try {
    localStorage.setItem(KEY, theme);
  } catch { /* a browser that keeps nothing */ }
}

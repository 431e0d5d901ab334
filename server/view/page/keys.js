/* keys.js: what the keyboard does wherever the focus is, but in a field. */

const DIGITS_FOR = 900; /* ms in which digits make one number */
const PAN = 60; /* px */

export function listenToKeys(does) {
  let digits = '';
  let since = 0;

  const number = (key) => {
    const goesOn = performance.now() - since < DIGITS_FOR;
    if (key === '0' && !(goesOn && digits)) {
      does.fit();
      return;
    }
    digits = goesOn ? digits + key : key;
    since = performance.now();
    if (!does.pick(Number(digits)) && digits !== key) does.pick(Number(digits = key));
  };

  const keys = {
    s: () => does.stop(), ' ': () => does.play(), '.': () => does.step(), g: () => does.live(),
    f: () => does.follow(), '+': () => does.zoom(1.25), '=': () => does.zoom(1.25), '-': () => does.zoom(0.8),
    i: () => does.toggle('ids'), l: () => does.toggle('links'), r: () => does.toggle('range'), t: () => does.trails(),
    n: () => does.pickNext(1), p: () => does.pickNext(-1), d: () => does.draws(), '?': () => does.signs(), escape: () => does.back(),
  };
  const pans = { arrowleft: [PAN, 0], arrowright: [-PAN, 0], arrowup: [0, PAN], arrowdown: [0, -PAN] };

  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented) return;
    const { target } = event;
    const key = event.key.toLowerCase();
    if (target.matches('input, select, textarea') && key !== 'escape') return;
    if ((key === ' ' || key === 'enter') && target.matches('button, a')) return;
    if (/^\d$/.test(key)) number(key);
    else if (key in keys) keys[key]();
    else if (key in pans && target.id === 'arena') does.pan(...pans[key]);
    else return;
    event.preventDefault();
  });
}

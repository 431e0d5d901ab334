/* formation.js: vertices about the leader, as they are drawn (x ahead of it, y to its left, m) and as they
 * are sent: (L, psi), distance and direction from its heading. The first vertex is the leader's. */

const NAME = /^[A-Za-z0-9._-]{1,63}$/;
const TOGETHER = 0.01; /* m: two vertices that are no farther apart are in one place */
const ROUND = 1e6; /* a micrometre, a microradian */

export function toPolar({ x, y }) {
  return { L: round(Math.hypot(x, y)), psi: round(Math.atan2(y, x)) };
}

/* On the grid; 0: there is none. */
export function snap({ x, y }, step) {
  if (step <= 0) return { x: round(x), y: round(y) };
  return { x: round(Math.round(x / step) * step), y: round(Math.round(y / step) * step) };
}

/* Where the vertices of a scene's formation are about its leader's vertex. */
export function placesOf(scene) {
  const { about } = scene;
  const c = Math.cos(about.theta);
  const s = Math.sin(about.theta);
  const places = Array.from({ length: scene.vertexCount }, (_, k) => {
    const dx = scene.vertexX(k) - about.x;
    const dy = scene.vertexY(k) - about.y;
    return { x: round3(c * dx + s * dy), y: round3(c * dy - s * dx) };
  });
  const leader = places.findIndex(({ x, y }) => Math.hypot(x, y) < TOGETHER / 2);
  if (leader < 0) return [{ x: 0, y: 0 }, ...places];
  return [{ x: 0, y: 0 }, ...places.filter((_, k) => k !== leader)];
}

/* Why they cannot be sent, in words; null: they can. `robots` there are. */
export function flawOf(name, places, robots) {
  if (!NAME.test(name)) return 'A name is 1 to 63 letters, digits, dots, underscores or hyphens.';
  if (places.length > robots) return `${places.length} vertices for ${robots} robots: as many or fewer are allowed.`;
  for (let b = 1; b < places.length; b++) {
    const { x, y } = places[b];
    if (!Number.isFinite(x) || !Number.isFinite(y)) return `Vertex ${b + 1} needs two numbers.`;
    const a = places.slice(0, b).findIndex((one) => Math.hypot(one.x - x, one.y - y) <= TOGETHER);
    if (a >= 0) return `Vertices ${a + 1} and ${b + 1} are in one place.`;
  }
  return null;
}

/* The first of drawn-1, drawn-2, ... that is free. */
export function freeName(names) {
  for (let k = 1; ; k++) {
    if (!names.includes(`drawn-${k}`)) return `drawn-${k}`;
  }
}

function round(value) {
  return Math.round(value * ROUND) / ROUND + 0;
}

function round3(value) {
  return Math.round(value * 1000) / 1000 + 0;
}

/* bodies.js: the shapes that tell robots apart without their colours. Each adds to the current path, so that
 * all robots of a kind are one path. Canvas pixels; theta as in the arena, counter-clockwise. */

const TURN = 2 * Math.PI;

/* A follower: a disc. */
export function disc(path, x, y, r) {
  path.moveTo(x + r, y);
  path.arc(x, y, r, 0, TURN);
}

/* The leader: an arrow head. */
export function arrow(path, x, y, theta, r) {
  polygon(path, x, y, theta, r, [[1.55, 0], [-1, 1.05], [-0.5, 0], [-1, -1.05]]);
}

/* A robot in an election: a diamond. */
export function diamond(path, x, y, theta, r) {
  polygon(path, x, y, theta, r, [[1.45, 0], [0, 1.1], [-1.1, 0], [0, -1.1]]);
}

/* Which way it heads. */
export function nose(path, x, y, theta, r) {
  const c = Math.cos(theta);
  const s = -Math.sin(theta);
  path.moveTo(x + 0.2 * r * c, y + 0.2 * r * s);
  path.lineTo(x + r * c, y + r * s);
}

/* Dead. */
export function cross(path, x, y, r) {
  const d = 0.62 * r;
  path.moveTo(x - d, y - d);
  path.lineTo(x + d, y + d);
  path.moveTo(x - d, y + d);
  path.lineTo(x + d, y - d);
}

/* Stalled: both wheels blocked. */
export function wheels(path, x, y, theta, r) {
  const c = Math.cos(theta);
  const s = -Math.sin(theta);
  for (const side of [-1.45, 1.45]) {
    const mx = x - side * r * s;
    const my = y + side * r * c;
    path.moveTo(mx - 0.8 * r * c, my - 0.8 * r * s);
    path.lineTo(mx + 0.8 * r * c, my + 0.8 * r * s);
  }
}

function polygon(path, x, y, theta, r, corners) {
  const c = Math.cos(theta) * r;
  const s = Math.sin(theta) * r;
  corners.forEach(([a, b], k) => {
    const px = x + a * c - b * s;
    const py = y - a * s - b * c;
    if (k === 0) path.moveTo(px, py);
    else path.lineTo(px, py);
  });
  path.closePath();
}

/* camera.js: from metres of the arena to pixels of the canvas and back; y is up in the arena. */

export const SCALE_MIN = 0.2; /* pixels per metre */
export const SCALE_MAX = 4000;
const LEAST = 1.6; /* m that are seen at least */
const MARGIN = 0.14; /* part of the canvas on each side */

export class Camera {
  x = 0; /* what is in the middle, m */
  y = 0;
  scale = 100;
  width = 1; /* px */
  height = 1;

  toScreenX(x) { return this.width / 2 + (x - this.x) * this.scale; }
  toScreenY(y) { return this.height / 2 - (y - this.y) * this.scale; }
  toArenaX(px) { return this.x + (px - this.width / 2) / this.scale; }
  toArenaY(py) { return this.y - (py - this.height / 2) / this.scale; }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /* What is under the pixel stays there. */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const x = this.toArenaX(px);
    const y = this.toArenaY(py);
    this.scale = Math.min(SCALE_MAX, Math.max(SCALE_MIN, this.scale * factor));
    this.x = x - (px - this.width / 2) / this.scale;
    this.y = y + (py - this.height / 2) / this.scale;
  }

  /* Where it has to be for a box to be seen whole, below `head` pixels that are taken. */
  fitting({ left, right, bottom, top }, head = 0) {
    const free = 1 - 2 * MARGIN;
    const wanted = Math.min(this.width * free / Math.max(right - left, LEAST),
                            (this.height - head) * free / Math.max(top - bottom, LEAST));
    const scale = Math.min(SCALE_MAX, Math.max(SCALE_MIN, wanted));
    return { x: (left + right) / 2, y: (bottom + top) / 2 + head / 2 / scale, scale };
  }

  /* Goes towards such a place; `part` of the way, 1 all of it. */
  approach(place, part) {
    this.x += (place.x - this.x) * part;
    this.y += (place.y - this.y) * part;
    this.scale *= (place.scale / this.scale) ** part;
  }
}

/* What is to be seen of a scene: its robots, but no dead ones far away from the others. */
export function boxOf(scene) {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (let i = 0; i < scene.count; i++) {
    if (scene.alive(i)) stretch(box, scene.x(i), scene.y(i));
  }
  for (let k = 0; k < scene.vertexCount; k++) stretch(box, scene.vertexX(k), scene.vertexY(k));
  if (box.left > box.right) {
    for (let i = 0; i < scene.count; i++) stretch(box, scene.x(i), scene.y(i));
    return box.left > box.right ? { left: -1, right: 1, bottom: -1, top: 1 } : box;
  }
  const near = { left: box.left - 1.5, right: box.right + 1.5, bottom: box.bottom - 1.5, top: box.top + 1.5 };
  for (let i = 0; i < scene.count; i++) {
    if (inside(near, scene.x(i), scene.y(i))) stretch(box, scene.x(i), scene.y(i));
  }
  return box;
}

function stretch(box, x, y) {
  if (!Number.isFinite(x) || !Number.isFinite(y)) return;
  box.left = Math.min(box.left, x);
  box.right = Math.max(box.right, x);
  box.bottom = Math.min(box.bottom, y);
  box.top = Math.max(box.top, y);
}

function inside(box, x, y) {
  return x >= box.left && x <= box.right && y >= box.bottom && y <= box.top;
}

/* The distance between grid lines that are at least `pixels` apart: 1, 2 or 5 times a power of 10. */
export function niceStep(perUnit, pixels) {
  const least = pixels / perUnit;
  const power = 10 ** Math.floor(Math.log10(least));
  for (const times of [1, 2, 5]) {
    if (times * power >= least * 0.999) return times * power;
  }
  return 10 * power;
}

/* poses.js: where robots are between two scenes, and where they have been. */

const LEAP = 1; /* m in a tick or so: it was put elsewhere, and did not drive there */

/* Pixels and the like come from here, in one array a value: written anew for each picture. */
export class Poses {
  count = 0;
  x = new Float64Array(0);
  y = new Float64Array(0);
  theta = new Float64Array(0);

  /* At `time`, between `scene` and the `next` one, which may be missing. */
  set(scene, next, time) {
    this.#grow(scene.count);
    const part = partBetween(scene, next, time);
    for (let i = 0; i < scene.count; i++) {
      const x = scene.x(i);
      const y = scene.y(i);
      const theta = scene.theta(i);
      if (part === 0 || next.id(i) !== scene.id(i)) {
        this.#put(i, x, y, theta);
        continue;
      }
      const dx = next.x(i) - x;
      const dy = next.y(i) - y;
      if (Math.abs(dx) + Math.abs(dy) > LEAP + 4 * (next.time - scene.time)) this.#put(i, x, y, theta);
      else this.#put(i, x + part * dx, y + part * dy, theta + part * turn(theta, next.theta(i)));
    }
  }

  #put(i, x, y, theta) {
    this.x[i] = x;
    this.y[i] = y;
    this.theta[i] = theta;
  }

  #grow(count) {
    this.count = count;
    if (this.x.length >= count) return;
    this.x = new Float64Array(count);
    this.y = new Float64Array(count);
    this.theta = new Float64Array(count);
  }
}

/* How far `time` is from one scene to the next, 0 to 1. */
export function partBetween(scene, next, time) {
  if (!next || next.count !== scene.count || next.time <= scene.time) return 0;
  return Math.min(1, Math.max(0, (time - scene.time) / (next.time - scene.time)));
}

/* A pose on the way from one to the other. */
export function poseBetween(from, to, part) {
  return {
    x: from.x + part * (to.x - from.x),
    y: from.y + part * (to.y - from.y),
    theta: from.theta + part * turn(from.theta, to.theta),
  };
}

/* The shorter way from one heading to another, rad. */
export function turn(from, to) {
  return Math.atan2(Math.sin(to - from), Math.cos(to - from));
}

/* Scenes of the last `length` seconds before `time`, oldest first, `points` at most. They are the same
 * ones from picture to picture, so that a trail does not crawl. */
export function scenesBefore(timeline, time, length, points) {
  const step = length / points;
  const found = [];
  for (let k = Math.ceil((time - length) / step); k * step < time; k++) {
    const scene = timeline.scenes[timeline.indexAt(k * step)];
    if (scene && scene !== found[found.length - 1] && scene.time > time - length - step) found.push(scene);
  }
  return found;
}

/* links.js: who hears whom, as pairs of indices. */

import { ROLE } from './fleet.js';

/* `both`: each hears the other; `one`: the second hears the first, and is not heard. Flat: a, b, a, b, ...
 * As scene_hears(): both take part, neither is muted, they are of one group, and the sender is leader or candidate
 * or within the range. */
export function linksOf(scene) {
  const n = scene.count;
  const x = new Float64Array(n);
  const y = new Float64Array(n);
  const group = new Int32Array(n); /* -1: takes no part */
  const far = new Uint8Array(n);   /* is heard everywhere */
  for (let i = 0; i < n; i++) {
    x[i] = scene.x(i);
    y[i] = scene.y(i);
    group[i] = scene.alive(i) && scene.linked(i) && !scene.muted(i) ? scene.group(i) : -1;
    far[i] = scene.role(i) === ROLE.L || scene.candidate(i) ? 1 : 0;
  }
  const reach = scene.range ** 2;
  const both = [];
  const one = [];
  for (let i = 0; i < n; i++) {
    if (group[i] < 0) continue;
    for (let j = i + 1; j < n; j++) {
      if (group[j] !== group[i]) continue;
      const near = (x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 <= reach;
      if (near || (far[i] && far[j])) both.push(i, j);
      else if (far[i]) one.push(i, j);
      else if (far[j]) one.push(j, i);
    }
  }
  return { both, one };
}

/* trails.js: where robots have been, as lines that fade in bands. */

import { scenesBefore } from './poses.js';

export const BANDS = 4; /* the last one the newest */

const POINTS = 6000; /* of all robots in a picture */
const POINTS_EACH = { least: 6, most: 200 };
const NEAR = 2; /* px: points that are closer are left out */
const FASTEST = 4; /* m/s; who was faster was put elsewhere, and a metre off */

export class Trails {
  /* The last `length` seconds before `time`. */
  constructor(scene, timeline, time, length) {
    const fair = Math.floor(POINTS / Math.max(1, scene.count));
    const points = Math.max(POINTS_EACH.least, Math.min(POINTS_EACH.most, fair));
    this.past = scenesBefore(timeline, time, length, points).filter((one) => one.count === scene.count);
    this.leap = 1 + FASTEST * length / points;
  }

  /* Adds one robot's band to the current path; the last one ends where the robot now is, in pixels. */
  add(pen, camera, i, band, nowX, nowY) {
    const from = Math.max(0, Math.floor(this.past.length * band / BANDS) - 1); /* so that bands join */
    const to = Math.floor(this.past.length * (band + 1) / BANDS);
    const leap = this.leap * camera.scale;
    let [x, y, begun] = [0, 0, false];
    const go = (px, py, must) => {
      const far = Math.abs(px - x) + Math.abs(py - y);
      if (begun && far < NEAR && !must) return;
      if (!begun || far > leap) pen.moveTo(px, py);
      else pen.lineTo(px, py);
      [x, y, begun] = [px, py, true];
    };
    for (let k = from; k < to; k++) {
      go(camera.toScreenX(this.past[k].x(i)), camera.toScreenY(this.past[k].y(i)), k === to - 1);
    }
    if (band === BANDS - 1 && begun) go(nowX, nowY, true);
  }
}

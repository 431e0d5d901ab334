/* grid.js: the lines of the ground, what they are numbered with, and the scale. */

import { niceStep } from './camera.js';
import { fixed } from './words.js';

const APART = 70; /* px between numbered lines at the least */

/* Adds lines to the current path, on whole pixels. */
export function gridLines(pen, camera, step) {
  for (let k = Math.ceil(camera.toArenaX(0) / step); camera.toScreenX(k * step) <= camera.width; k++) {
    const x = Math.round(camera.toScreenX(k * step)) + 0.5;
    pen.moveTo(x, 0);
    pen.lineTo(x, camera.height);
  }
  for (let k = Math.ceil(camera.toArenaY(camera.height) / step); camera.toScreenY(k * step) >= 0; k++) {
    const y = Math.round(camera.toScreenY(k * step)) + 0.5;
    pen.moveTo(0, y);
    pen.lineTo(camera.width, y);
  }
}

export function drawGrid(pen, camera, colours) {
  const step = niceStep(camera.scale, APART);
  pen.lineWidth = 1;
  for (const [apart, colour] of [[step / 5, colours.gridFine], [step, colours.grid]]) {
    pen.beginPath();
    gridLines(pen, camera, apart);
    pen.strokeStyle = colour;
    pen.stroke();
  }
  drawNumbers(pen, camera, colours, step);
}

/* Along the left and the bottom; none under the tools and the scale. */
function drawNumbers(pen, camera, colours, step) {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  pen.fillStyle = colours.faint;
  pen.font = '11px system-ui, sans-serif';
  pen.textBaseline = 'bottom';
  pen.textAlign = 'left';
  for (let k = Math.ceil(camera.toArenaX(60) / step); camera.toScreenX(k * step) < camera.width - 150; k++) {
    pen.fillText(fixed(k * step, digits), camera.toScreenX(k * step) + 3, camera.height - 2);
  }
  for (let k = Math.ceil(camera.toArenaY(camera.height - 30) / step); camera.toScreenY(k * step) > 70; k++) {
    pen.fillText(fixed(k * step, digits), 3, camera.toScreenY(k * step) - 1);
  }
}

export function drawScale(pen, camera, colours) {
  const step = niceStep(camera.scale, APART);
  const right = camera.width - 14;
  const left = right - step * camera.scale;
  const y = camera.height - 14;
  pen.beginPath();
  pen.moveTo(left, y - 4);
  pen.lineTo(left, y);
  pen.lineTo(right, y);
  pen.lineTo(right, y - 4);
  pen.strokeStyle = colours.ink;
  pen.lineWidth = 1.5;
  pen.stroke();
  pen.fillStyle = colours.ink;
  pen.font = '12px system-ui, sans-serif';
  pen.textAlign = 'center';
  pen.textBaseline = 'bottom';
  pen.fillText(lengthWords(step), (left + right) / 2, y - 4);
}

export function lengthWords(metres) {
  return metres < 1 ? `${Math.round(metres * 100)} cm` : `${metres} m`;
}

/* legend.js: what the signs of the arena mean, drawn by what draws them there. */

import { arrow, cross, diamond, disc, nose, wheels } from './bodies.js';

const WIDE = 60;
const HIGH = 40;
const R = 9;
const X = WIDE / 2;
const Y = HIGH / 2;

const body = (shape, name) => (pen, c) => {
  pen.beginPath();
  shape(pen);
  pen.fillStyle = c[name];
  pen.fill();
  stroke(pen, c.outline, 1.3);
};
const follower = (pen, c) => {
  body((path) => disc(path, X, Y, R), 'follower')(pen, c);
  line(pen, (path) => nose(path, X, Y, 0.5, R), c.nose, 2);
};

const SIGNS = [
  ['leader', body((path) => arrow(path, X, Y, 0.5, R), 'leader')],
  ['follower', follower],
  ['in an election', body((path) => diamond(path, X, Y, 0, R), 'electing')],
  ['ringed: a candidate, may lead', (pen, c) => {
    line(pen, (path) => disc(path, X, Y, R * 1.5), c.electing, 1.8);
    follower(pen, c);
  }],
  ['broken ring: muted, its beacons are lost', (pen, c) => {
    pen.setLineDash([4, 4]);
    line(pen, (path) => disc(path, X, Y, R * 1.95), c.trouble, 2);
    pen.setLineDash([]);
    follower(pen, c);
  }],
  ['bars: stalled, its wheels are held', (pen, c) => {
    follower(pen, c);
    line(pen, (path) => wheels(path, X, Y, 0.5, R), c.trouble, 3);
  }],
  ['hollow: not linked', (pen, c) => {
    line(pen, (path) => disc(path, X, Y, R), c.absent, 1.8);
    line(pen, (path) => nose(path, X, Y, 0.5, R), c.absent, 2);
  }],
  ['crossed: dead', (pen, c) => {
    line(pen, (path) => disc(path, X, Y, R), c.dead, 1.8);
    line(pen, (path) => cross(path, X, Y, R), c.dead, 2);
  }],
  ['a vertex, and the robot that holds it', (pen, c) => {
    line(pen, (path) => { path.moveTo(14, 28); path.lineTo(44, 12); }, c.vertex, 1);
    line(pen, (path) => disc(path, 44, 12, 5), c.vertex, 1.3);
    body((path) => disc(path, 14, 28, 7), 'follower')(pen, c);
  }],
  ['a vertex that nobody holds', (pen, c) => {
    pen.setLineDash([2.5, 2.5]);
    line(pen, (path) => disc(path, X, Y, 6), c.vertexFree, 1.6);
    pen.setLineDash([]);
  }],
  ['the reference: where the leader should be', (pen, c) => {
    line(pen, (path) => {
      disc(path, X - 6, Y, 10);
      path.moveTo(X + 4, Y);
      path.lineTo(X + 16, Y);
    }, c.reference, 1.6);
  }],
];

export function drawLegend(list, colours) {
  const ratio = window.devicePixelRatio || 1;
  list.replaceChildren(...SIGNS.map(([words, draw]) => {
    const item = document.createElement('li');
    const canvas = Object.assign(document.createElement('canvas'), { width: WIDE * ratio, height: HIGH * ratio });
    const pen = canvas.getContext('2d');
    pen.scale(ratio, ratio);
    draw(pen, colours);
    item.append(canvas, words);
    return item;
  }));
}

function line(pen, path, colour, width) {
  pen.beginPath();
  path(pen);
  stroke(pen, colour, width);
}

function stroke(pen, colour, width) {
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke();
}

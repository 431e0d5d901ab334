/* arena.js: the picture of the arena from above. Robots of a kind are drawn as one path: a hundred of them
 * cost little more than one, also where a processor does the drawing. */

import { ROLE } from './fleet.js';
import { arrow, cross, diamond, disc, nose, wheels } from './bodies.js';
import { linksOf } from './links.js';
import { niceStep } from './camera.js';
import { partBetween, poseBetween, scenesBefore } from './poses.js';
import { fixed, troubled } from './words.js';

const BODY = 0.08; /* m: about what a robot's radius is */
const TRAIL_POINTS = 6000; /* of all robots in a picture */
const TRAIL_BANDS = 4; /* of fading */
const MANY = 200; /* robots */
const COARSE = 3; /* px of the page in one of the discs' */
const RANGE_PALE = 0.1;
const FEW = 20; /* robots whose discs have an edge each */
const LINKS_EVERY = 0.1; /* s of the wall */

const KINDS = ['follower', 'leader', 'electing', 'absent', 'dead'];

export class Arena {
  #kind = new Uint8Array(0);
  #px = new Float64Array(0);
  #py = new Float64Array(0);
  #links = { scene: null, at: -1, both: [], one: [] };

  constructor(canvas, camera) {
    this.canvas = canvas;
    this.camera = camera;
    this.pen = canvas.getContext('2d', { alpha: false });
  }

  /* Adapts to the size on the page. True when it has changed. */
  resize() {
    if (this.canvas.clientWidth === 0) return false; /* not to be seen now: the camera stays */
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (this.canvas.width === width && this.canvas.height === height && this.ratio === ratio) return false;
    this.canvas.width = width;
    this.canvas.height = height;
    this.ratio = ratio;
    this.camera.width = width / ratio;
    this.camera.height = height / ratio;
    return true;
  }

  get radius() {
    const least = this.crowded ? 4.5 : 7.5;
    return Math.min(22, Math.max(least, BODY * this.camera.scale));
  }

  /* The index of the robot under a point of the canvas, -1: none. */
  robotAt(px, py, slack) {
    let best = -1;
    let least = (this.radius * 1.3 + slack) ** 2;
    for (let i = 0; i < this.count; i++) {
      const distance = (this.#px[i] - px) ** 2 + (this.#py[i] - py) ** 2;
      if (distance < least) {
        least = distance;
        best = i;
      }
    }
    return best;
  }

  /* `show`: ids, links, range, trails (s), vertices; `picked`: a robot's id; `ghost`: a pose or null. */
  draw({ scene, next, poses, time, timeline, show, picked, ghost, colours, now }) {
    const { pen, camera } = this;
    this.colours = colours;
    this.#place(scene, poses);
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.fillStyle = colours.arena;
    pen.fillRect(0, 0, camera.width, camera.height);
    const pickedAt = picked === 0 ? -1 : scene.indexOf(picked);
    if (show.range) this.#drawRange(scene);
    this.#drawGrid();
    if (pickedAt >= 0 && scene.alive(pickedAt)) this.#drawRangeOf(scene, pickedAt);
    if (show.links || pickedAt >= 0) this.#drawLinks(scene, show.links, pickedAt, now);
    if (show.trails > 0) this.#drawTrails(scene, timeline, time, show.trails);
    this.#drawVertices(scene, next, time);
    this.#drawReference(scene, next, time);
    this.#drawBodies(scene, poses);
    this.#vertexNumbers();
    if (pickedAt >= 0) this.#drawPicked(pickedAt);
    this.#drawIds(scene, show.ids, pickedAt);
    if (ghost) this.#drawGhost(ghost, pickedAt);
    this.#drawScale();
  }

  drawNothing(colours) {
    this.colours = colours;
    this.pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    this.pen.fillStyle = colours.arena;
    this.pen.fillRect(0, 0, this.camera.width, this.camera.height);
    this.#drawGrid();
    this.#drawScale();
  }

  #place(scene, poses) {
    const n = scene.count;
    this.count = n;
    this.crowded = n > 40;
    if (this.#kind.length < n) {
      this.#kind = new Uint8Array(n);
      this.#px = new Float64Array(n);
      this.#py = new Float64Array(n);
    }
    for (let i = 0; i < n; i++) {
      this.#px[i] = this.camera.toScreenX(poses.x[i]);
      this.#py[i] = this.camera.toScreenY(poses.y[i]);
      this.#kind[i] = kindOf(scene, i);
    }
  }

  /* Of very many, a pixel wide: any other width costs a processor ten times as much. */
  #stroke(colour, width) {
    this.pen.strokeStyle = colour;
    this.pen.lineWidth = this.count > MANY ? 1 : width;
    this.pen.stroke();
  }

  #drawGrid() {
    const { pen, camera, colours } = this;
    const step = niceStep(camera.scale, 70);
    pen.beginPath();
    this.#gridLines(step / 5);
    this.#stroke(colours.gridFine, 1);
    pen.beginPath();
    this.#gridLines(step);
    this.#stroke(colours.grid, 1);
    this.#gridNumbers(step);
  }

  #gridLines(step) {
    const { pen, camera } = this;
    const left = camera.toArenaX(0);
    const bottom = camera.toArenaY(camera.height);
    for (let k = Math.ceil(left / step); ; k++) {
      const px = Math.round(camera.toScreenX(k * step)) + 0.5;
      if (px > camera.width) break;
      pen.moveTo(px, 0);
      pen.lineTo(px, camera.height);
    }
    for (let k = Math.ceil(bottom / step); ; k++) {
      const py = Math.round(camera.toScreenY(k * step)) + 0.5;
      if (py < 0) break;
      pen.moveTo(0, py);
      pen.lineTo(camera.width, py);
    }
  }

  #gridNumbers(step) {
    const { pen, camera, colours } = this;
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

  #drawScale() {
    const { pen, camera, colours } = this;
    const step = niceStep(camera.scale, 70);
    const wide = step * camera.scale;
    const right = camera.width - 14;
    const y = camera.height - 14;
    pen.beginPath();
    pen.moveTo(right - wide, y - 4);
    pen.lineTo(right - wide, y);
    pen.lineTo(right, y);
    pen.lineTo(right, y - 4);
    this.#stroke(colours.ink, 1.5);
    pen.fillStyle = colours.ink;
    pen.font = '12px system-ui, sans-serif';
    pen.textAlign = 'center';
    pen.textBaseline = 'bottom';
    pen.fillText(step < 1 ? `${Math.round(step * 100)} cm` : `${step} m`, right - wide / 2, y - 4);
  }

  /* Where discs overlap it is no darker: they are drawn aside, coarsely, and laid over the picture as one. */
  #drawRange(scene) {
    const { pen, camera, colours } = this;
    const r = scene.range * camera.scale;
    if (!(r > 0) || r > 1e5) return;
    const sender = (i) => scene.alive(i) && scene.linked(i) && !scene.muted(i);
    const layer = this.#layer();
    layer.fillStyle = colours.range;
    for (let i = 0; i < scene.count; i++) {
      if (!sender(i)) continue;
      layer.beginPath();
      disc(layer, this.#px[i] / COARSE, this.#py[i] / COARSE, r / COARSE);
      layer.fill();
    }
    pen.globalAlpha = RANGE_PALE;
    pen.drawImage(layer.canvas, 0, 0, camera.width, camera.height);
    pen.globalAlpha = 1;
    if (this.count > FEW) return;
    pen.beginPath();
    for (let i = 0; i < scene.count; i++) {
      if (sender(i)) disc(pen, this.#px[i], this.#py[i], r);
    }
    this.#stroke(colours.rangeEdge, 1);
  }

  /* An empty canvas of a coarser kind. */
  #layer() {
    const width = Math.ceil(this.camera.width / COARSE);
    const height = Math.ceil(this.camera.height / COARSE);
    this.aside ??= document.createElement('canvas').getContext('2d');
    const { canvas } = this.aside;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    else this.aside.clearRect(0, 0, width, height);
    return this.aside;
  }

  #drawRangeOf(scene, i) {
    const { pen, camera, colours } = this;
    const r = scene.range * camera.scale;
    if (!(r > 0) || r > 1e5) return;
    pen.beginPath();
    disc(pen, this.#px[i], this.#py[i], r);
    pen.setLineDash([2, 5]);
    this.#stroke(colours.picked, 1.2);
    pen.setLineDash([]);
  }

  #drawLinks(scene, all, pickedAt, now) {
    const { pen, colours } = this;
    const links = this.#links;
    if (links.scene !== scene && (Math.abs(now - links.at) > LINKS_EVERY || links.count !== scene.count)) {
      this.#links = { scene, at: now, count: scene.count, ...linksOf(scene) };
    }
    const { both, one } = this.#links;
    if (all) {
      pen.beginPath();
      this.#lines(both, -1);
      this.#stroke(colours.link, 1);
      pen.beginPath();
      this.#lines(one, -1, (from) => scene.role(from) === ROLE.L);
      pen.setLineDash([3, 5]);
      this.#stroke(colours.linkFar, 1);
      pen.setLineDash([]);
    }
    if (pickedAt < 0) return;
    pen.beginPath();
    this.#lines(both, pickedAt);
    this.#stroke(colours.linkPicked, 1.3);
    pen.beginPath();
    this.#lines(one, pickedAt);
    pen.setLineDash([3, 5]);
    this.#stroke(colours.linkPicked, 1.3);
    pen.setLineDash([]);
  }

  #lines(pairs, only, drawn = () => true) {
    const { pen } = this;
    for (let k = 0; k < pairs.length; k += 2) {
      const [i, j] = [pairs[k], pairs[k + 1]];
      if ((only >= 0 && i !== only && j !== only) || !drawn(i)) continue;
      pen.moveTo(this.#px[i], this.#py[i]);
      pen.lineTo(this.#px[j], this.#py[j]);
    }
  }

  #drawTrails(scene, timeline, time, length) {
    const { pen, colours } = this;
    const points = Math.max(6, Math.min(200, Math.floor(TRAIL_POINTS / Math.max(1, scene.count))));
    const past = scenesBefore(timeline, time, length, points).filter((one) => one.count === scene.count);
    pen.lineJoin = 'round';
    for (let band = 0; band < TRAIL_BANDS; band++) {
      pen.globalAlpha = (band + 1) / TRAIL_BANDS * 0.55;
      const from = Math.floor(past.length * band / TRAIL_BANDS);
      const to = Math.floor(past.length * (band + 1) / TRAIL_BANDS);
      for (const [kind, name] of KINDS.entries()) {
        pen.beginPath();
        for (let i = 0; i < scene.count; i++) {
          if (this.#kind[i] === kind) this.#trail(past, i, from, to, band === TRAIL_BANDS - 1, length / points);
        }
        this.#stroke(colours[name], this.crowded ? 1 : 1.6);
      }
    }
    pen.globalAlpha = 1;
  }

  /* From the scene before `from`, so that bands join. */
  #trail(past, i, from, to, last, step) {
    const { pen, camera } = this;
    const leap = (1 + 4 * step) * camera.scale;
    let [x, y] = [0, 0];
    let begun = false;
    const go = (px, py, must) => {
      const far = Math.abs(px - x) + Math.abs(py - y);
      if (begun && far < 2 && !must) return;
      if (!begun || far > leap) pen.moveTo(px, py);
      else pen.lineTo(px, py);
      [x, y, begun] = [px, py, true];
    };
    for (let k = Math.max(0, from - 1); k < to; k++) {
      go(camera.toScreenX(past[k].x(i)), camera.toScreenY(past[k].y(i)), k === to - 1);
    }
    if (last && begun) go(this.#px[i], this.#py[i], true);
  }

  #drawVertices(scene, next, time) {
    const { pen, camera, colours } = this;
    const part = next && next.vertexCount === scene.vertexCount && next.formation === scene.formation
      ? partBetween(scene, next, time) : 0;
    const n = scene.vertexCount;
    const x = new Float64Array(n);
    const y = new Float64Array(n);
    const holder = new Int32Array(n).fill(-1);
    for (let k = 0; k < n; k++) {
      const [vx, vy] = [scene.vertexX(k), scene.vertexY(k)];
      x[k] = camera.toScreenX(part ? vx + part * (next.vertexX(k) - vx) : vx);
      y[k] = camera.toScreenY(part ? vy + part * (next.vertexY(k) - vy) : vy);
    }
    for (let i = 0; i < scene.count; i++) {
      const k = scene.vertex(i) - 1;
      if (k >= 0 && k < n && scene.alive(i)) holder[k] = i;
    }
    this.#drawHoldings(scene, x, y);
    const r = Math.max(3.5, this.radius * 0.55);
    pen.beginPath();
    for (let k = 0; k < n; k++) {
      if (holder[k] < 0) disc(pen, x[k], y[k], r);
    }
    pen.fillStyle = colours.arena;
    pen.fill();
    pen.setLineDash([2.5, 2.5]);
    this.#stroke(colours.vertexFree, 1.6);
    pen.setLineDash([]);
    pen.beginPath();
    for (let k = 0; k < n; k++) {
      if (holder[k] >= 0) disc(pen, x[k], y[k], r);
    }
    this.#stroke(colours.vertex, 1.3);
    this.vertices = { x, y, r };
  }

  #drawHoldings(scene, x, y) {
    const { pen, colours } = this;
    pen.beginPath();
    for (let i = 0; i < scene.count; i++) {
      const k = scene.vertex(i) - 1;
      if (k < 0 || k >= x.length || !scene.alive(i)) continue;
      pen.moveTo(this.#px[i], this.#py[i]);
      pen.lineTo(x[k], y[k]);
    }
    this.#stroke(colours.vertex, 1);
  }

  #vertexNumbers() {
    const { pen, colours } = this;
    const { x, y, r } = this.vertices;
    if (this.crowded && this.camera.scale < 110) return;
    pen.fillStyle = colours.vertexText;
    pen.font = '600 11px system-ui, sans-serif';
    pen.textAlign = 'right';
    pen.textBaseline = 'top';
    const off = Math.max(r, this.radius) + 3;
    for (let k = 0; k < x.length; k++) pen.fillText(`v${k + 1}`, x[k] - off * 0.85, y[k] + off * 0.75);
  }

  /* Where the leader should be. */
  #drawReference(scene, next, time) {
    const { pen, camera, colours } = this;
    const part = partBetween(scene, next, time);
    const at = part ? poseBetween(scene.reference, next.reference, part) : scene.reference;
    const x = camera.toScreenX(at.x);
    const y = camera.toScreenY(at.y);
    const r = Math.max(11, this.radius * 1.9);
    const c = Math.cos(at.theta);
    const s = -Math.sin(at.theta);
    pen.beginPath();
    disc(pen, x, y, r);
    for (const [dx, dy] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) {
      pen.moveTo(x + dx * r * 0.7, y + dy * r * 0.7);
      pen.lineTo(x + dx * r * 1.3, y + dy * r * 1.3);
    }
    pen.moveTo(x + c * r, y + s * r);
    pen.lineTo(x + c * r * 2.2, y + s * r * 2.2);
    pen.lineTo(x + c * r * 1.85 - s * r * 0.2, y + s * r * 1.85 + c * r * 0.2);
    pen.moveTo(x + c * r * 2.2, y + s * r * 2.2);
    pen.lineTo(x + c * r * 1.85 + s * r * 0.2, y + s * r * 1.85 - c * r * 0.2);
    this.#stroke(colours.reference, 1.6);
  }

  #drawBodies(scene, poses) {
    const { pen, colours } = this;
    const r = this.radius;
    this.#rings(scene, r);
    KINDS.forEach((name, kind) => {
      pen.beginPath();
      for (let i = 0; i < this.count; i++) {
        if (this.#kind[i] === kind) this.#body(name, i, poses.theta[i], r);
      }
      pen.fillStyle = name === 'dead' || name === 'absent' ? colours.arena : colours[name];
      pen.fill();
      this.#stroke(name === 'dead' ? colours.dead : name === 'absent' ? colours.follower : colours.outline,
                   name === 'dead' || name === 'absent' ? 1.8 : 1.3);
    });
    this.#noses(poses, r);
    this.#marks(scene, poses, r);
  }

  #body(name, i, theta, r) {
    if (name === 'leader') arrow(this.pen, this.#px[i], this.#py[i], theta, r);
    else if (name === 'electing') diamond(this.pen, this.#px[i], this.#py[i], theta, r);
    else disc(this.pen, this.#px[i], this.#py[i], r);
  }

  #noses(poses, r) {
    const { pen, colours } = this;
    for (const [kind, colour] of [['follower', colours.nose], ['absent', colours.absent]]) {
      pen.beginPath();
      for (let i = 0; i < this.count; i++) {
        if (KINDS[this.#kind[i]] === kind) nose(pen, this.#px[i], this.#py[i], poses.theta[i], r);
      }
      this.#stroke(colour, Math.max(1.6, r / 5));
    }
  }

  /* A candidate has a second outline, one whose beacons are lost a broken one. */
  #rings(scene, r) {
    const { pen, colours } = this;
    pen.beginPath();
    for (let i = 0; i < this.count; i++) {
      if (scene.alive(i) && scene.candidate(i) && scene.role(i) !== ROLE.L) disc(pen, this.#px[i], this.#py[i], r * 1.5);
    }
    this.#stroke(colours.electing, 1.8);
    pen.beginPath();
    for (let i = 0; i < this.count; i++) {
      if (scene.alive(i) && scene.muted(i)) disc(pen, this.#px[i], this.#py[i], r * 1.95);
    }
    pen.setLineDash([4, 4]);
    this.#stroke(colours.trouble, 2);
    pen.setLineDash([]);
  }

  #marks(scene, poses, r) {
    const { pen, colours } = this;
    pen.beginPath();
    for (let i = 0; i < this.count; i++) {
      if (!scene.alive(i)) cross(pen, this.#px[i], this.#py[i], r);
    }
    this.#stroke(colours.dead, 2);
    pen.beginPath();
    for (let i = 0; i < this.count; i++) {
      if (scene.alive(i) && scene.stalled(i)) wheels(pen, this.#px[i], this.#py[i], poses.theta[i], r);
    }
    this.#stroke(colours.trouble, Math.max(2.5, r / 3.2));
    this.#warnings(scene, r);
  }

  #warnings(scene, r) {
    const { pen, colours } = this;
    pen.fillStyle = colours.trouble;
    pen.font = `800 ${this.crowded ? 13 : 16}px system-ui, sans-serif`;
    pen.textAlign = 'center';
    pen.textBaseline = 'bottom';
    for (let i = 0; i < this.count; i++) {
      if (scene.alive(i) && troubled(scene, i)) pen.fillText('!', this.#px[i], this.#py[i] - r * 1.6);
    }
  }

  #drawIds(scene, all, pickedAt) {
    const { pen, colours, camera } = this;
    const r = this.radius;
    const every = all && (!this.crowded || camera.scale > 75);
    pen.fillStyle = colours.ink;
    pen.font = `600 ${this.crowded ? 11 : 13}px system-ui, sans-serif`;
    pen.textAlign = 'left';
    pen.textBaseline = 'bottom';
    for (let i = 0; i < this.count; i++) {
      if (every || i === pickedAt || (all && this.#kind[i] === 1)) {
        pen.fillText(String(scene.id(i)), this.#px[i] + r + 3, this.#py[i] - r * 0.5);
      }
    }
  }

  #drawPicked(i) {
    const { pen, colours } = this;
    const r = this.radius * 2.2 + 3;
    pen.beginPath();
    for (let k = 0; k < 4; k++) {
      const from = k * Math.PI / 2 + 0.35;
      const to = from + Math.PI / 2 - 0.7;
      pen.moveTo(this.#px[i] + r * Math.cos(from), this.#py[i] + r * Math.sin(from));
      pen.arc(this.#px[i], this.#py[i], r, from, to);
    }
    this.#stroke(colours.picked, 2.5);
  }

  #drawGhost(ghost, pickedAt) {
    const { pen, camera, colours } = this;
    const x = camera.toScreenX(ghost.x);
    const y = camera.toScreenY(ghost.y);
    pen.setLineDash([4, 4]);
    pen.beginPath();
    if (pickedAt >= 0) {
      pen.moveTo(this.#px[pickedAt], this.#py[pickedAt]);
      pen.lineTo(x, y);
    }
    disc(pen, x, y, this.radius);
    this.#stroke(colours.picked, 2);
    pen.setLineDash([]);
    pen.beginPath();
    nose(pen, x, y, ghost.theta, this.radius);
    this.#stroke(colours.picked, 2);
  }
}

function kindOf(scene, i) {
  if (!scene.alive(i)) return 4;
  if (!scene.linked(i)) return 3;
  if (scene.role(i) === ROLE.L) return 1;
  return scene.role(i) === ROLE.C ? 2 : 0;
}

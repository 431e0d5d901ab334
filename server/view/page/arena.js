/* arena.js: the picture of the arena from above. Robots of a kind are drawn as one path: a hundred of them
 * cost little more than one, also where a processor does the drawing. */

import { ROLE } from './fleet.js';
import { arrow, cross, diamond, disc, nose, wheels } from './bodies.js';
import { drawGrid, drawScale } from './grid.js';
import { linksOf } from './links.js';
import { partBetween, poseBetween } from './poses.js';
import { BANDS, Trails } from './trails.js';
import { troubled } from './words.js';

const BODY = 0.08; /* m: about what a robot's radius is */
const TRAIL_PALE = 0.55; /* its newest part */
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
    this.#clear(colours);
    this.#place(scene, poses);
    const pickedAt = picked === 0 ? -1 : scene.indexOf(picked);
    if (show.range) this.#drawRange(scene);
    drawGrid(pen, camera, colours);
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
    drawScale(pen, camera, colours);
  }

  drawNothing(colours) {
    const { pen, camera } = this;
    this.#clear(colours);
    drawGrid(pen, camera, colours);
    drawScale(pen, camera, colours);
  }

  #clear(colours) {
    const { pen, camera } = this;
    this.colours = colours;
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.fillStyle = colours.arena;
    pen.fillRect(0, 0, camera.width, camera.height);
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
    const { pen, camera, colours } = this;
    const trails = new Trails(scene, timeline, time, length);
    pen.lineJoin = 'round';
    for (let band = 0; band < BANDS; band++) {
      pen.globalAlpha = (band + 1) / BANDS * TRAIL_PALE;
      KINDS.forEach((name, kind) => {
        pen.beginPath();
        for (let i = 0; i < scene.count; i++) {
          if (this.#kind[i] === kind) trails.add(pen, camera, i, band, this.#px[i], this.#py[i]);
        }
        this.#stroke(colours[name], this.crowded ? 1 : 1.6);
      });
    }
    pen.globalAlpha = 1;
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

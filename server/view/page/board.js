/* board.js: the board on which vertices are placed by mouse, finger or arrow keys: the leader in the
 * middle, ahead is up. Places are in the leader's frame, x ahead, y to its left, m. */

import { arrow, disc, nose } from './bodies.js';
import { Camera, niceStep } from './camera.js';
import { gridLines, lengthWords } from './grid.js';

const REACH = { mouse: 14, pen: 16, touch: 24 }; /* px about a vertex that still mean it */
const ROBOT = 7; /* px */
const VERTEX = 12;

export class Board {
  places = [];
  chosen = -1; /* index of a place */
  step = 0; /* of the grid, m; 0: none */
  #held = -1;
  #pan = null;
  #camera = new Camera();

  /* `told` has push(place), put(k, place), choose(k), remove(k). */
  constructor(canvas, told) {
    this.canvas = canvas;
    this.told = told;
    this.pen = canvas.getContext('2d');
    canvas.addEventListener('pointerdown', (event) => this.#down(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    canvas.addEventListener('pointerup', () => this.#letGo());
    canvas.addEventListener('pointercancel', () => this.#letGo());
    canvas.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener('keydown', (event) => this.#key(event));
  }

  /* So that all places are seen. */
  fit() {
    this.#resize();
    const box = { left: -1, right: 1, bottom: -1.2, top: 0.8 };
    for (const { x, y } of this.places) {
      box.left = Math.min(box.left, -y);
      box.right = Math.max(box.right, -y);
      box.bottom = Math.min(box.bottom, x);
      box.top = Math.max(box.top, x);
    }
    this.#camera.approach(this.#camera.fitting(box), 1);
  }

  draw(scene, colours) {
    this.#resize();
    this.colours = colours;
    this.pen.fillStyle = colours.arena;
    this.pen.fillRect(0, 0, this.#camera.width, this.#camera.height);
    this.#drawGrid();
    this.#drawRobots(scene);
    this.#drawVertices();
  }

  /* ---- hands ---- */

  #at(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #down(event) {
    if (event.button > 1) return;
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.#at(event);
    if (event.button === 1 || event.shiftKey) {
      this.#pan = at;
      return;
    }
    const k = this.#vertexAt(at, REACH[event.pointerType] ?? REACH.mouse);
    if (k < 0) this.told.push(this.#toPlace(at));
    else this.told.choose(k);
    this.#held = this.chosen;
  }

  #move(event) {
    const at = this.#at(event);
    if (this.#pan) {
      this.#camera.pan(at.x - this.#pan.x, at.y - this.#pan.y);
      this.#pan = at;
      this.told.choose(this.chosen);
    } else if (this.#held > 0) this.told.put(this.#held, this.#toPlace(at));
  }

  #letGo() {
    this.#held = -1;
    this.#pan = null;
  }

  #wheel(event) {
    event.preventDefault();
    const { x, y } = this.#at(event);
    this.#camera.zoom(Math.exp(-event.deltaY * 0.0015), x, y);
    this.told.choose(this.chosen);
  }

  #key(event) {
    const step = this.step || 0.01;
    const ways = { ArrowUp: [step, 0], ArrowDown: [-step, 0], ArrowLeft: [0, step], ArrowRight: [0, -step] };
    const place = this.chosen > 0 ? this.places[this.chosen] : null;
    if (place && event.key in ways) {
      const [dx, dy] = ways[event.key];
      this.told.put(this.chosen, { x: place.x + dx, y: place.y + dy });
    } else if (place && (event.key === 'Delete' || event.key === 'Backspace')) this.told.remove(this.chosen);
    else if (event.key === '+' || event.key === '-') {
      this.#camera.zoom(event.key === '+' ? 1.25 : 0.8);
      this.told.choose(this.chosen);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #vertexAt(at, reach) {
    const distances = this.places.map((place) => {
      const { x, y } = this.#toScreen(place);
      return Number.isFinite(x + y) ? Math.hypot(x - at.x, y - at.y) : Infinity;
    });
    const least = Math.min(...distances);
    return least <= reach ? distances.indexOf(least) : -1;
  }

  /* ---- the picture ---- */

  #toScreen({ x, y }) {
    return { x: this.#camera.toScreenX(-y), y: this.#camera.toScreenY(x) };
  }

  #toPlace({ x, y }) {
    return { x: this.#camera.toArenaY(y), y: -this.#camera.toArenaX(x) };
  }

  #resize() {
    const ratio = window.devicePixelRatio || 1;
    const { canvas } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
    if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    Object.assign(this.#camera, { width, height });
  }

  #stroke(colour, width) {
    this.pen.strokeStyle = colour;
    this.pen.lineWidth = width;
    this.pen.stroke();
  }

  #drawGrid() {
    const { pen, colours } = this;
    const { scale, height } = this.#camera;
    const wide = niceStep(scale, 60);
    for (const [step, colour] of [[Math.max(this.step, niceStep(scale, 9)), colours.gridFine], [wide, colours.grid]]) {
      pen.beginPath();
      gridLines(pen, this.#camera, step);
      this.#stroke(colour, 1);
    }
    pen.fillStyle = colours.faint;
    pen.font = '12px system-ui, sans-serif';
    pen.textAlign = 'left';
    pen.textBaseline = 'bottom';
    pen.fillText(`wide squares: ${lengthWords(wide)}`, 10, height - 8);
  }

  /* Pale: where the robots are about their leader. */
  #drawRobots(scene) {
    const { pen, colours } = this;
    const { about } = scene;
    const c = Math.cos(about.theta);
    const s = Math.sin(about.theta);
    pen.beginPath();
    for (let i = 0; i < scene.count; i++) {
      if (!scene.alive(i)) continue;
      const [dx, dy] = [scene.x(i) - about.x, scene.y(i) - about.y];
      const { x, y } = this.#toScreen({ x: c * dx + s * dy, y: c * dy - s * dx });
      disc(pen, x, y, ROBOT);
      nose(pen, x, y, scene.theta(i) - about.theta + Math.PI / 2, ROBOT * 1.7);
    }
    pen.globalAlpha = 0.35;
    this.#stroke(colours.follower, 1.5);
    pen.globalAlpha = 1;
  }

  #drawVertices() {
    const { pen, colours } = this;
    const at = this.places.map((place) => this.#toScreen(place));
    const [leader, ...others] = at;
    pen.beginPath();
    for (const { x, y } of others) {
      pen.moveTo(leader.x, leader.y);
      pen.lineTo(x, y);
    }
    this.#stroke(colours.vertex, 1);
    pen.beginPath();
    arrow(pen, leader.x, leader.y, Math.PI / 2, VERTEX + 1);
    pen.fillStyle = colours.leader;
    pen.fill();
    this.#stroke(colours.outline, 1.5);
    pen.font = '650 13px system-ui, sans-serif';
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    others.forEach((place, k) => this.#drawVertex(place, k + 1));
  }

  #drawVertex({ x, y }, k) {
    const { pen, colours } = this;
    const chosen = k === this.chosen;
    if (!Number.isFinite(x + y)) return;
    pen.beginPath();
    disc(pen, x, y, VERTEX);
    pen.fillStyle = colours.card;
    pen.fill();
    this.#stroke(chosen ? colours.picked : colours.accent, chosen ? 3 : 1.8);
    pen.fillStyle = colours.ink;
    pen.fillText(String(k + 1), x, y + 0.5);
  }
}

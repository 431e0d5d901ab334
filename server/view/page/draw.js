/* draw.js: the board on which a formation is drawn: the leader in the middle, ahead is up. */

import { markHindered } from './acts.js';
import { arrow, disc, nose } from './bodies.js';
import { Camera, niceStep } from './camera.js';
import { fixed } from './words.js';
import { flawOf, freeName, placesOf, snap, toPolar } from './formation.js';

const REACH = 14; /* px about a vertex that still mean it; more for fingers */
const FINGER = 24;

export class Drawing {
  #places = [{ x: 0, y: 0 }];
  #chosen = -1;
  #held = -1;
  #pan = null;
  #camera = new Camera();
  #scene = null;
  #rows = [];

  /* `known()` returns the names there are; `closed()` is called when it is over. */
  constructor(section, acts, { known, closed }) {
    this.section = section;
    this.acts = acts;
    this.known = known;
    this.closed = closed;
    this.canvas = section.querySelector('canvas');
    this.pen = this.canvas.getContext('2d');
    this.list = section.querySelector('tbody');
    for (const name of ['name', 'grid', 'send', 'from', 'add', 'clear', 'flaw']) this[name] = document.getElementById(`draw-${name}`);
    this.#listen();
  }

  get isOpen() { return !this.section.hidden; }

  open(scene) {
    if (this.isOpen || !scene) return;
    this.#scene = scene;
    this.section.hidden = false;
    this.name.value = freeName(this.known());
    this.#set([{ x: 0, y: 0 }]);
    this.#fit();
    this.canvas.focus();
  }

  close() {
    this.section.hidden = true;
    this.closed();
  }

  /* What is so now: how many robots, which formation, and where they are about their leader. */
  show(scene, colours) {
    this.#scene = scene;
    this.colours = colours;
    if (!this.isOpen) return;
    const from = `Begin with ${scene.formation}`;
    if (this.from.textContent !== from) this.from.textContent = from;
    this.#judge();
    this.#draw();
  }

  #listen() {
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => this.#down(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    for (const name of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(name, () => { [this.#held, this.#pan] = [-1, null]; });
    }
    canvas.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener('keydown', (event) => this.#key(event));
    this.list.addEventListener('input', (event) => this.#type(event.target));
    this.list.addEventListener('focusin', (event) => this.#choose(Number(event.target.closest('tr').dataset.k)));
    this.list.addEventListener('click', (event) => {
      if (event.target.matches('button')) this.#remove(Number(event.target.closest('tr').dataset.k));
    });
    this.name.addEventListener('input', () => this.#judge());
    this.add.addEventListener('click', () => this.#addByKey());
    this.clear.addEventListener('click', () => this.#set([{ x: 0, y: 0 }]));
    document.getElementById('draw-close').addEventListener('click', () => this.close());
    this.from.addEventListener('click', () => {
      this.#set(placesOf(this.#scene));
      this.#fit();
    });
    this.section.querySelector('form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.#send();
    });
  }

  get #step() { return Number(this.grid.value); }

  async #send() {
    const name = this.name.value;
    const flaw = flawOf(name, this.#places, this.#scene.count);
    if (flaw !== null) return;
    const polar = this.#places.map(toPolar);
    const done = await this.acts.ask('draw', { name, L: polar.map(({ L }) => L), psi: polar.map(({ psi }) => psi) },
                                     `The formation ${name} was not taken`);
    if (done) this.close();
  }

  /* Says what is wrong, or how many vertices there are. */
  #judge() {
    const flaw = flawOf(this.name.value, this.#places, this.#scene.count);
    const count = this.#places.length;
    const words = flaw ?? `${count} ${count === 1 ? 'vertex' : 'vertices'} for ${this.#scene.count} robots.`;
    if (this.flaw.textContent !== words) this.flaw.textContent = words;
    this.flaw.classList.toggle('bad', flaw !== null);
    markHindered(this.send, this.acts.hindrance('draw') ?? flaw);
  }

  /* ---- vertices ---- */

  #set(places) {
    this.#places = places;
    this.#chosen = -1;
    this.#list();
  }

  #put(k, place) {
    this.#places[k] = snap(place, this.#step);
    this.#fill(k);
    this.#refresh();
  }

  #push(place) {
    this.#places.push(snap(place, this.#step));
    this.#list();
    this.#choose(this.#places.length - 1);
  }

  #remove(k) {
    if (k < 1) return;
    this.#places.splice(k, 1);
    this.#list();
    this.#choose(Math.min(k, this.#places.length - 1));
  }

  #choose(k) {
    this.#chosen = k;
    this.#rows.forEach(({ row }, i) => row.classList.toggle('chosen', i === k));
    this.#draw();
  }

  /* A place for those who have no pointer: behind the last one. */
  #addByKey() {
    const step = this.#step || 0.5;
    const last = this.#places[this.#places.length - 1];
    this.#push({ x: last.x - Math.max(step, 0.5), y: last.y });
    this.#rows[this.#chosen].fields.x.focus();
  }

  #refresh() {
    this.#judge();
    this.#draw();
  }

  /* ---- the list ---- */

  #list() {
    this.list.replaceChildren();
    this.#rows = this.#places.map((_, k) => this.#makeRow(k));
    this.#places.forEach((_, k) => this.#fill(k));
    this.#refresh();
  }

  #makeRow(k) {
    const row = this.list.insertRow();
    row.dataset.k = k;
    const head = document.createElement('th');
    head.scope = 'row';
    head.textContent = k === 0 ? '1, leader' : String(k + 1);
    row.append(head);
    const fields = {};
    for (const [name, about] of [['x', 'ahead'], ['y', 'to the left']]) {
      const field = Object.assign(document.createElement('input'),
                                  { type: 'number', step: 'any', disabled: k === 0, ariaLabel: `Vertex ${k + 1}, m ${about}` });
      field.dataset.axis = name;
      row.insertCell().append(field);
      fields[name] = field;
    }
    const polar = row.insertCell();
    const last = row.insertCell();
    if (k > 0) last.append(Object.assign(document.createElement('button'), { type: 'button', textContent: '×', ariaLabel: `Remove vertex ${k + 1}` }));
    return { row, fields, polar };
  }

  #fill(k) {
    const { fields, polar } = this.#rows[k];
    const place = this.#places[k];
    for (const name of ['x', 'y']) {
      if (document.activeElement !== fields[name]) fields[name].value = Number.isFinite(place[name]) ? place[name] : '';
    }
    const { L, psi } = toPolar(place);
    polar.textContent = Number.isFinite(L) ? `${L.toFixed(2)} m, ${fixed(psi * 180 / Math.PI, 0)}°` : '–';
  }

  #type(field) {
    const k = Number(field.closest('tr').dataset.k);
    this.#places[k] = { ...this.#places[k], [field.dataset.axis]: field.valueAsNumber };
    this.#fill(k);
    this.#refresh();
  }

  /* ---- the board ---- */

  /* Ahead is up. */
  #toScreen({ x, y }) {
    return { x: this.#camera.toScreenX(-y), y: this.#camera.toScreenY(x) };
  }

  #toPlace({ x, y }) {
    return { x: this.#camera.toArenaY(y), y: -this.#camera.toArenaX(x) };
  }

  #fit() {
    this.#resize();
    const box = { left: -1, right: 1, bottom: -1.2, top: 0.8 };
    for (const { x, y } of this.#places) {
      box.left = Math.min(box.left, -y);
      box.right = Math.max(box.right, -y);
      box.bottom = Math.min(box.bottom, x);
      box.top = Math.max(box.top, x);
    }
    this.#camera.approach(this.#camera.fitting(box), 1);
    this.#draw();
  }

  #at(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #vertexAt(at, reach) {
    const distances = this.#places.map((place) => {
      const { x, y } = this.#toScreen(place);
      return Math.hypot(x - at.x, y - at.y);
    });
    const k = distances.indexOf(Math.min(...distances));
    return distances[k] <= reach ? k : -1;
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
    const k = this.#vertexAt(at, event.pointerType === 'touch' ? FINGER : REACH);
    if (k < 0) this.#push(this.#toPlace(at));
    else this.#choose(k);
    this.#held = this.#chosen;
  }

  #move(event) {
    const at = this.#at(event);
    if (this.#pan) {
      this.#camera.pan(at.x - this.#pan.x, at.y - this.#pan.y);
      this.#pan = at;
      this.#draw();
    } else if (this.#held > 0) this.#put(this.#held, this.#toPlace(at));
  }

  #wheel(event) {
    event.preventDefault();
    const { x, y } = this.#at(event);
    this.#camera.zoom(Math.exp(-event.deltaY * 0.0015), x, y);
    this.#draw();
  }

  #key(event) {
    const step = this.#step || 0.01;
    const ways = { ArrowUp: [step, 0], ArrowDown: [-step, 0], ArrowLeft: [0, step], ArrowRight: [0, -step] };
    const k = this.#chosen;
    if (event.key in ways && k > 0) {
      const [dx, dy] = ways[event.key];
      this.#put(k, { x: this.#places[k].x + dx, y: this.#places[k].y + dy });
    } else if ((event.key === 'Delete' || event.key === 'Backspace') && k > 0) this.#remove(k);
    else if (event.key === '+' || event.key === '-') {
      this.#camera.zoom(event.key === '+' ? 1.25 : 0.8);
      this.#draw();
    } else return;
    event.preventDefault();
    event.stopPropagation();
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

  #draw() {
    if (!this.isOpen || !this.colours) return;
    this.#resize();
    const { pen, colours } = this;
    pen.fillStyle = colours.arena;
    pen.fillRect(0, 0, this.#camera.width, this.#camera.height);
    this.#drawGrid();
    this.#drawRobots();
    this.#drawVertices();
  }

  #stroke(colour, width) {
    this.pen.strokeStyle = colour;
    this.pen.lineWidth = width;
    this.pen.stroke();
  }

  #drawGrid() {
    const { pen, colours } = this;
    const camera = this.#camera;
    const wide = niceStep(camera.scale, 60);
    for (const [step, colour] of [[Math.max(this.#step, niceStep(camera.scale, 9)), colours.gridFine], [wide, colours.grid]]) {
      pen.beginPath();
      for (let k = Math.ceil(camera.toArenaX(0) / step); camera.toScreenX(k * step) < camera.width; k++) {
        const x = Math.round(camera.toScreenX(k * step)) + 0.5;
        pen.moveTo(x, 0);
        pen.lineTo(x, camera.height);
      }
      for (let k = Math.ceil(camera.toArenaY(camera.height) / step); camera.toScreenY(k * step) > 0; k++) {
        const y = Math.round(camera.toScreenY(k * step)) + 0.5;
        pen.moveTo(0, y);
        pen.lineTo(camera.width, y);
      }
      this.#stroke(colour, 1);
    }
    pen.fillStyle = colours.faint;
    pen.font = '12px system-ui, sans-serif';
    pen.textAlign = 'left';
    pen.textBaseline = 'bottom';
    pen.fillText(`wide squares: ${wide < 1 ? `${Math.round(wide * 100)} cm` : `${wide} m`}`, 10, camera.height - 8);
  }

  /* Pale: where the robots are about their leader. */
  #drawRobots() {
    const { pen, colours } = this;
    const scene = this.#scene;
    const { about } = scene;
    const c = Math.cos(about.theta);
    const s = Math.sin(about.theta);
    pen.beginPath();
    for (let i = 0; i < scene.count; i++) {
      if (!scene.alive(i)) continue;
      const [dx, dy] = [scene.x(i) - about.x, scene.y(i) - about.y];
      const { x, y } = this.#toScreen({ x: c * dx + s * dy, y: c * dy - s * dx });
      disc(pen, x, y, 7);
      nose(pen, x, y, scene.theta(i) - about.theta + Math.PI / 2, 12);
    }
    pen.globalAlpha = 0.35;
    this.#stroke(colours.follower, 1.5);
    pen.globalAlpha = 1;
  }

  #drawVertices() {
    const { pen, colours } = this;
    const places = this.#places.map((place) => this.#toScreen(place));
    const [leader] = places;
    pen.beginPath();
    for (const { x, y } of places.slice(1)) {
      pen.moveTo(leader.x, leader.y);
      pen.lineTo(x, y);
    }
    this.#stroke(colours.vertex, 1);
    pen.beginPath();
    arrow(pen, leader.x, leader.y, Math.PI / 2, 13);
    pen.fillStyle = colours.leader;
    pen.fill();
    this.#stroke(colours.outline, 1.5);
    pen.font = '650 13px system-ui, sans-serif';
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    places.forEach(({ x, y }, k) => {
      if (k === 0 || !Number.isFinite(x + y)) return;
      pen.beginPath();
      disc(pen, x, y, 12);
      pen.fillStyle = colours.card;
      pen.fill();
      this.#stroke(k === this.#chosen ? colours.picked : colours.accent, k === this.#chosen ? 3 : 1.8);
      pen.fillStyle = colours.ink;
      pen.fillText(String(k + 1), x, y + 0.5);
    });
  }
}

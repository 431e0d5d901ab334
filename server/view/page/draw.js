/* draw.js: a new formation: its vertices on the board and as numbers beside it, until it is sent. */

import { markHindered } from './acts.js';
import { Board } from './board.js';
import { flawOf, freeName, placesOf, snap, toPolar } from './formation.js';
import { fixed } from './words.js';

const LEADER = { x: 0, y: 0 };
const BEHIND = 0.5; /* m: where a vertex comes that is added without a pointer */

export class Drawing {
  #rows = [];
  #scene = null;
  #colours = null;

  /* `known()` returns the names there are; `closed()` is called when it is over. */
  constructor(section, acts, { known, closed }) {
    this.section = section;
    this.acts = acts;
    this.known = known;
    this.closed = closed;
    this.list = section.querySelector('tbody');
    for (const name of ['name', 'grid', 'send', 'from', 'flaw']) this[name] = document.getElementById(`draw-${name}`);
    this.board = new Board(section.querySelector('canvas'), {
      push: (place) => this.#push(place),
      put: (k, place) => this.#put(k, place),
      choose: (k) => this.#choose(k),
      remove: (k) => this.#remove(k),
    });
    this.#listen();
  }

  get isOpen() { return !this.section.hidden; }

  open(scene) {
    if (this.isOpen) return;
    this.#scene = scene;
    this.section.hidden = false;
    this.name.value = freeName(this.known());
    this.board.step = Number(this.grid.value);
    this.#begin([LEADER]);
    this.board.canvas.focus();
  }

  close() {
    this.section.hidden = true;
    this.closed();
  }

  /* What is so now: how many robots, which formation, and where they are about their leader. */
  show(scene, colours) {
    this.#scene = scene;
    this.#colours = colours;
    if (!this.isOpen) return;
    const words = `Begin with ${scene.formation}`;
    if (this.from.textContent !== words) this.from.textContent = words;
    this.#refresh();
  }

  #listen() {
    const on = (name, event, does) => document.getElementById(`draw-${name}`).addEventListener(event, does);
    on('name', 'input', () => this.#judge());
    on('grid', 'change', () => { this.board.step = Number(this.grid.value); });
    on('add', 'click', () => this.#addBehind());
    on('clear', 'click', () => this.#begin([LEADER]));
    on('from', 'click', () => this.#begin(placesOf(this.#scene)));
    on('close', 'click', () => this.close());
    this.section.querySelector('form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.#send();
    });
    const indexOf = ({ target }) => Number(target.closest('tr').dataset.k);
    this.list.addEventListener('input', (event) => this.#type(indexOf(event), event.target));
    this.list.addEventListener('focusin', (event) => this.#choose(indexOf(event)));
    this.list.addEventListener('click', (event) => {
      if (event.target.matches('button')) this.#remove(indexOf(event));
    });
  }

  async #send() {
    const name = this.name.value;
    if (flawOf(name, this.board.places, this.#scene.count) !== null) return;
    const polar = this.board.places.map(toPolar);
    const done = await this.acts.ask('draw', { name, L: polar.map(({ L }) => L), psi: polar.map(({ psi }) => psi) },
                                     `The formation ${name} was not taken`);
    if (done) this.close();
  }

  /* Says what is wrong, or how many vertices there are. */
  #judge() {
    const { places } = this.board;
    const flaw = flawOf(this.name.value, places, this.#scene.count);
    const words = flaw ?? `${places.length} ${places.length === 1 ? 'vertex' : 'vertices'} for ${this.#scene.count} robots.`;
    if (this.flaw.textContent !== words) this.flaw.textContent = words;
    this.flaw.classList.toggle('bad', flaw !== null);
    markHindered(this.send, this.acts.hindrance('draw') ?? flaw);
  }

  #refresh() {
    this.#judge();
    if (this.isOpen && this.#colours) this.board.draw(this.#scene, this.#colours);
  }

  /* ---- vertices ---- */

  #begin(places) {
    this.board.places = places;
    this.board.chosen = -1;
    this.board.fit();
    this.#makeRows();
  }

  #put(k, place) {
    this.board.places[k] = snap(place, this.board.step);
    this.#fill(k);
    this.#refresh();
  }

  #push(place) {
    this.board.places.push(snap(place, this.board.step));
    this.#makeRows();
    this.#choose(this.board.places.length - 1);
  }

  #remove(k) {
    if (k < 1) return;
    this.board.places.splice(k, 1);
    this.#makeRows();
    this.#choose(Math.min(k, this.board.places.length - 1));
  }

  #choose(k) {
    this.board.chosen = k;
    this.#rows.forEach(({ row }, i) => row.classList.toggle('chosen', i === k));
    this.#refresh();
  }

  #addBehind() {
    const { x, y } = this.board.places[this.board.places.length - 1];
    this.#push({ x: x - BEHIND, y });
    this.#rows[this.board.chosen].fields.x.focus();
  }

  /* ---- the list ---- */

  #makeRows() {
    this.list.replaceChildren();
    this.#rows = this.board.places.map((_, k) => this.#makeRow(k));
    this.#rows.forEach((_, k) => this.#fill(k));
    this.#refresh();
  }

  #makeRow(k) {
    const row = this.list.insertRow();
    row.dataset.k = k;
    row.append(make('th', { scope: 'row', textContent: k === 0 ? '1, leader' : String(k + 1) }));
    const fields = {};
    for (const [axis, about] of [['x', 'ahead'], ['y', 'to the left']]) {
      fields[axis] = make('input', { type: 'number', step: 'any', disabled: k === 0, ariaLabel: `Vertex ${k + 1}, m ${about}` });
      fields[axis].dataset.axis = axis;
      row.insertCell().append(fields[axis]);
    }
    const polar = row.insertCell();
    const last = row.insertCell();
    if (k > 0) last.append(make('button', { type: 'button', textContent: '×', ariaLabel: `Remove vertex ${k + 1}` }));
    return { row, fields, polar };
  }

  #fill(k) {
    const { fields, polar } = this.#rows[k];
    const place = this.board.places[k];
    for (const axis of ['x', 'y']) {
      if (document.activeElement !== fields[axis]) fields[axis].value = Number.isFinite(place[axis]) ? place[axis] : '';
    }
    const { L, psi } = toPolar(place);
    polar.textContent = Number.isFinite(L) ? `${L.toFixed(2)} m, ${fixed(psi * 180 / Math.PI, 0)}°` : '–';
  }

  #type(k, field) {
    this.board.places[k] = { ...this.board.places[k], [field.dataset.axis]: field.valueAsNumber };
    this.#fill(k);
    this.#refresh();
  }
}

function make(name, properties) {
  return Object.assign(document.createElement(name), properties);
}

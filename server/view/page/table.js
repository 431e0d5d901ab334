/* table.js: the robots as rows. Rows are made once and filled anew; those out of sight are left alone. */

import { ROLE } from './fleet.js';
import { conditionWords, metres, roleWord, troubled } from './words.js';

const COLUMNS = [
  { name: 'id', title: 'Id', about: 'Robot', of: (s, i) => s.id(i), say: String },
  { name: 'role', title: 'Role', about: 'Role in the fleet', words: true, of: (s, i) => ROLE_ORDER[s.role(i)] ?? 9 },
  { name: 'vertex', title: 'Vertex', about: 'Vertex that it holds', of: (s, i) => s.vertex(i) || Infinity,
    say: (v) => (v === Infinity ? '–' : String(v)) },
  { name: 'error', title: 'Error', unit: 'm', about: 'Distance from where it should be, m', of: (s, i) => s.error(i), say: metres },
  { name: 'age', title: 'Pose', unit: 'ms', about: 'Age of the pose that it has, ms', of: (s, i) => s.poseAge(i),
    say: (v) => (Number.isFinite(v) ? (v * 1000).toFixed(0) : '–') },
  { name: 'loss', title: 'Loss', unit: '%', about: 'Frames lost on its link in the last second, %', of: (s, i) => s.robotLoss(i),
    say: (v) => (Number.isFinite(v) ? (v * 100).toFixed(0) : '–') },
  { name: 'battery', title: 'Batt.', unit: 'V', about: 'Battery, V', of: (s, i) => s.battery(i) || NaN,
    say: (v) => (Number.isFinite(v) ? v.toFixed(2) : '–') },
  { name: 'load', title: 'Load', unit: '%', about: 'Part of its processor in use, %', of: (s, i) => s.load(i),
    say: (v) => (Number.isFinite(v) ? (v * 100).toFixed(0) : '–') },
  { name: 'state', title: 'State', about: 'What it does, or what is wrong', words: true, of: (s, i) => conditionWords(s, i) },
];
const ROLE_ORDER = { [ROLE.L]: 0, [ROLE.C]: 1, [ROLE.F]: 2 };
const ROW = 28; /* px: css has it too */

/* Indices of robots in the order of a column; ties by id. NaN is last either way. */
export function orderOf(scene, column, descending) {
  const of = COLUMNS.find(({ name }) => name === column).of;
  const keys = Array.from({ length: scene.count }, (_, i) => of(scene, i));
  const side = descending ? -1 : 1;
  return keys.map((_, i) => i).sort((a, b) => {
    const [p, q] = [keys[a], keys[b]];
    if (Number.isNaN(p) || Number.isNaN(q)) return Number.isNaN(p) - Number.isNaN(q) || scene.id(a) - scene.id(b);
    return (p < q ? -side : p > q ? side : 0) || scene.id(a) - scene.id(b);
  });
}

export class Table {
  #rows = [];
  #order = [];
  #column = 'id';
  #descending = false;
  #picked = 0;
  #scene = null;

  /* `pick(id)` is called for the robot whose row somebody chose. */
  constructor(table, pick) {
    this.table = table;
    this.scroller = table.parentElement;
    this.pick = pick;
    this.#makeHead();
    this.body = table.createTBody();
    this.body.addEventListener('click', (event) => this.#choose(event.target.closest('tr')));
    this.body.addEventListener('keydown', (event) => this.#key(event));
    this.scroller.addEventListener('scroll', () => this.#fill());
  }

  get picked() { return this.#picked; }

  set picked(id) {
    this.#picked = id;
    this.#fill();
    const at = this.#order.findIndex((i) => this.#scene.id(i) === id);
    if (at >= 0 && !this.body.contains(document.activeElement)) this.#show(at);
  }

  /* Shows a scene. While somebody points at the rows they keep their order. */
  show(scene) {
    const before = this.#scene;
    this.#scene = scene;
    this.#makeRows(scene.count);
    const still = this.body.matches(':hover') || this.body.contains(document.activeElement);
    if (!still || !before || before.count !== scene.count) this.#sort();
    this.#fill();
  }

  #sort() {
    if (this.#scene) this.#order = orderOf(this.#scene, this.#column, this.#descending);
  }

  #makeHead() {
    const row = this.table.createTHead().insertRow();
    for (const { name, title, unit, about, words } of COLUMNS) {
      const head = document.createElement('th');
      const button = document.createElement('button');
      head.scope = 'col';
      head.classList.toggle('words', Boolean(words));
      button.type = 'button';
      button.textContent = title;
      button.append(Object.assign(document.createElement('small'), { textContent: unit ?? '' }));
      button.title = about;
      button.addEventListener('click', () => this.#sortBy(name));
      head.append(button);
      row.append(head);
    }
    this.#markSorted();
  }

  #sortBy(name) {
    this.#descending = name === this.#column && !this.#descending;
    this.#column = name;
    this.#markSorted();
    this.#sort();
    this.#fill();
  }

  #markSorted() {
    [...this.table.tHead.rows[0].cells].forEach((head, k) => {
      if (COLUMNS[k].name === this.#column) head.ariaSort = this.#descending ? 'descending' : 'ascending';
      else head.removeAttribute('aria-sort');
    });
  }

  #makeRows(count) {
    while (this.#rows.length > count) this.#rows.pop().row.remove();
    while (this.#rows.length < count) {
      const row = this.body.insertRow();
      row.tabIndex = this.#rows.length === 0 ? 0 : -1;
      const cells = COLUMNS.map(({ words }) => {
        const cell = row.insertCell();
        const place = words ? document.createElement('span') : cell;
        if (words) {
          cell.className = 'words';
          cell.append(place);
        }
        return { cell, place, said: null };
      });
      this.#rows.push({ row, cells, id: 0 });
    }
  }

  /* The rows in sight. */
  #fill() {
    const scene = this.#scene;
    if (!scene || this.#order.length !== this.#rows.length) return;
    const first = Math.max(0, Math.floor(this.scroller.scrollTop / ROW) - 2);
    const last = Math.min(this.#rows.length, first + Math.ceil(this.scroller.clientHeight / ROW) + 5);
    for (let k = first; k < last; k++) this.#fillRow(this.#rows[k], scene, this.#order[k]);
  }

  #fillRow(line, scene, i) {
    const id = scene.id(i);
    if (line.id !== id) {
      line.id = id;
      line.row.dataset.robot = id;
    }
    mark(line.row, 'aria-selected', String(id === this.#picked));
    line.row.classList.toggle('dead', !scene.alive(i));
    COLUMNS.forEach((column, k) => {
      const cell = line.cells[k];
      const value = column.of(scene, i);
      const said = column.name === 'role' ? scene.alive(i) ? roleWord(scene.role(i)) : '–' : column.say ? column.say(value) : value;
      if (cell.said !== said) cell.place.textContent = cell.said = said;
      if (column.name === 'role') mark(cell.place, 'class', roleClass(scene, i));
      if (column.name === 'state') {
        cell.cell.classList.toggle('trouble', troubled(scene, i));
        if (cell.cell.title !== said) cell.cell.title = said;
      }
    });
  }

  #choose(row) {
    if (!row) return;
    this.#focus(this.#rows.findIndex((line) => line.row === row));
    this.pick(Number(row.dataset.robot));
  }

  #key(event) {
    const at = this.#rows.findIndex(({ row }) => row === event.target);
    const page = Math.max(1, Math.floor(this.scroller.clientHeight / ROW) - 2);
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
    if (event.key === 'Enter' || event.key === ' ') this.#choose(event.target);
    else if (event.key in steps) this.#focus(Math.max(0, Math.min(this.#rows.length - 1, at + steps[event.key])));
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #focus(at) {
    this.#rows.forEach(({ row }, k) => { row.tabIndex = k === at ? 0 : -1; });
    this.#show(at);
    this.#rows[at].row.focus({ preventScroll: true });
  }

  #show(at) {
    const top = at * ROW;
    const room = this.scroller.clientHeight - 2 * ROW;
    if (top < this.scroller.scrollTop) this.scroller.scrollTop = top;
    else if (top > this.scroller.scrollTop + room) this.scroller.scrollTop = top - room;
    this.#fill();
  }
}

function roleClass(scene, i) {
  const role = `role ${roleWord(scene.role(i))}`;
  return scene.candidate(i) && scene.role(i) !== ROLE.L ? `${role} may` : role;
}

function mark(element, name, value) {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

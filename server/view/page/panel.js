/* panel.js: what is known of the robot that was picked, and what may be done to it. */

import { markHindered } from './acts.js';
import { ROLE } from './fleet.js';
import { conditionWords, fixed, metres, roleWord } from './words.js';

const DEGREE = Math.PI / 180;

const BUTTONS = [
  { act: 'kill', title: 'Kill', done: 'killed', when: (s, i) => s.alive(i), className: 'kill' },
  { act: 'revive', title: 'Revive', done: 'revived', when: (s, i) => !s.alive(i) },
  { act: 'stall', title: 'Stall', done: 'stalled', when: (s, i) => s.alive(i) },
  { act: 'mute', title: 'Mute', done: 'muted', when: (s, i) => s.alive(i) && !s.muted(i) },
  { act: 'unmute', title: 'Unmute', done: 'unmuted', when: (s, i) => s.muted(i) },
  { act: 'drain', title: 'Drain battery', done: 'drained', when: (s, i) => s.alive(i) },
];

export class Panel {
  #id = 0;
  #facts = new Map();

  /* `close()` is called when nobody is to be picked any more. */
  constructor(element, acts, close) {
    this.element = element;
    this.acts = acts;
    this.close = close;
    this.#make();
  }

  /* A robot's id, 0: none. */
  set id(id) {
    this.#id = id;
    this.element.hidden = id === 0;
    this.fresh = true;
  }

  /* Says what is so in this scene. */
  show(scene) {
    const i = this.#id ? scene.indexOf(this.#id) : -1;
    if (i < 0) {
      this.element.hidden = true;
      return;
    }
    this.element.hidden = false;
    this.#say('title', `Robot ${this.#id}, ${scene.alive(i) ? roleWord(scene.role(i)) : 'dead'}`);
    this.#say('state', conditionWords(scene, i));
    this.#say('pose', `${fixed(scene.x(i), 2)}, ${fixed(scene.y(i), 2)} m, ${fixed(scene.theta(i) / DEGREE, 0)}°`);
    this.#say('speed', `${fixed(scene.v(i), 2)} m/s, ${fixed(scene.omega(i), 2)} rad/s`);
    this.#say('vertex', scene.vertex(i) ? `${scene.vertex(i)}, off by ${metres(scene.error(i))} m` : 'none');
    this.#say('term', `${scene.term(i)}${scene.group(i) ? `, group ${scene.group(i)}` : ''}`);
    this.#say('may', scene.candidate(i) ? (scene.role(i) === ROLE.L ? 'yes, and does' : 'yes') : 'no');
    this.#showActs(scene, i);
    if (this.fresh) this.#fillPose(scene, i);
    this.fresh = false;
  }

  #showActs(scene, i) {
    let hindrance = null;
    for (const { button, act, when } of this.buttons) {
      button.hidden = !this.acts.has(act) || !when(scene, i);
      if (button.hidden) continue;
      hindrance = this.acts.hindrance(act);
      markHindered(button, hindrance);
    }
    this.moving.hidden = !this.acts.has('move');
    if (!this.moving.hidden) markHindered(this.moveButton, this.acts.hindrance('move'));
    this.note.hidden = hindrance === null;
    if (this.note.textContent !== (hindrance ?? '')) this.note.textContent = hindrance ?? '';
  }

  #fillPose(scene, i) {
    this.fields.x.value = scene.x(i).toFixed(2);
    this.fields.y.value = scene.y(i).toFixed(2);
    this.fields.theta.value = (scene.theta(i) / DEGREE).toFixed(0);
  }

  #say(name, words) {
    const place = this.#facts.get(name);
    if (place.textContent !== words) place.textContent = words;
  }

  #make() {
    const head = make('div', { className: 'head' });
    const title = make('h2', { id: 'panel-title' });
    const close = make('button', { type: 'button', className: 'close', textContent: '×', title: 'Close (Esc)', ariaLabel: 'Close' });
    close.addEventListener('click', () => this.close());
    head.append(title, close);
    this.#facts.set('title', title);
    this.element.append(head, this.#makeFacts(), this.#makeButtons(), this.#makeMoving());
    this.note = make('p', { className: 'note', hidden: true });
    this.element.append(this.note);
  }

  #makeFacts() {
    const list = make('dl', { className: 'facts' });
    const names = { state: 'state', vertex: 'vertex', pose: 'pose', speed: 'speed', term: 'term', may: 'may lead' };
    for (const [name, title] of Object.entries(names)) {
      const pair = make('div');
      const value = make('dd');
      pair.append(make('dt', { textContent: title }), value);
      list.append(pair);
      this.#facts.set(name, value);
    }
    return list;
  }

  #makeButtons() {
    const row = make('div', { className: 'choices' });
    this.buttons = BUTTONS.map((kind) => {
      const button = make('button', { type: 'button', textContent: kind.title, className: kind.className ?? '' });
      button.dataset.act = kind.act;
      button.addEventListener('click', () => {
        const id = this.#id;
        this.acts.ask(kind.act, { robot: id }, `Robot ${id} was not ${kind.done}`);
      });
      row.append(button);
      return { ...kind, button };
    });
    return row;
  }

  #makeMoving() {
    this.moving = make('form', { className: 'moving' });
    this.fields = {};
    for (const [name, title] of [['x', 'x, m'], ['y', 'y, m'], ['theta', 'heading, °']]) {
      const label = make('label', { textContent: title });
      this.fields[name] = make('input', { type: 'number', step: 'any', required: true });
      label.append(this.fields[name]);
      this.moving.append(label);
    }
    this.moveButton = make('button', { textContent: 'Put there', title: 'Or drag the robot in the arena' });
    this.moving.append(this.moveButton);
    this.moving.addEventListener('submit', (event) => {
      event.preventDefault();
      const { x, y, theta } = this.fields;
      this.move({ x: x.valueAsNumber, y: y.valueAsNumber, theta: theta.valueAsNumber * DEGREE });
    });
    return this.moving;
  }

  move(pose) {
    return this.acts.ask('move', { robot: this.#id, ...pose }, `Robot ${this.#id} was not put elsewhere`);
  }
}

function make(name, properties = {}) {
  return Object.assign(document.createElement(name), properties);
}

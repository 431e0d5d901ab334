/* instruments.js: the figures at the top, the words below the arena, the title of the window. */

import { clockTime, metres, roleWord } from './words.js';

const IDS = ['title', 'phase', 'clock', 'mean', 'leader', 'alive', 'formation', 'summary', 'stopped'];

export class Instruments {
  constructor() {
    this.place = Object.fromEntries(IDS.map((id) => [id, document.getElementById(id)]));
  }

  name(title) {
    this.title = title;
    this.#say('title', title);
  }

  /* `phase` in a word, `manner` of '', 'runs', 'bad'. */
  tellPhase(phase, manner) {
    this.#say('phase', phase);
    this.place.phase.className = `phase ${manner}`;
    const words = [phase, this.title, 'Muster'].filter(Boolean).join(' · ');
    if (document.title !== words) document.title = words;
  }

  show(scene, time) {
    const alive = countAlive(scene);
    this.#say('clock', clockTime(time));
    this.#say('mean', `${metres(scene.meanError)} m`);
    this.#say('leader', scene.leader ? `robot ${scene.leader}` : 'none');
    this.#say('alive', `${alive} of ${scene.count}`);
    this.#say('formation', scene.formation + (scene.complete ? ' ✓' : ''));
    this.place.formation.title = scene.complete ? 'Allocation is complete' : '';
    this.place.stopped.hidden = !scene.estopped;
    document.body.classList.toggle('stopped', scene.estopped);
    this.#say('summary', summaryOf(scene, time, alive));
  }

  #say(name, words) {
    if (this.place[name].textContent !== words) this.place[name].textContent = words;
  }
}

/* The picture in words. */
export function summaryOf(scene, time, alive = countAlive(scene)) {
  const leader = scene.leader ? `robot ${scene.leader} leads` : 'nobody leads';
  const place = scene.complete ? 'allocation complete' : 'allocation not complete';
  const stop = scene.estopped ? ', emergency stop' : '';
  return `At ${clockTime(time, 1)} ${leader}, ${alive} of ${scene.count} are alive, formation ${scene.formation}, ${place}, ` +
    `mean error ${metres(scene.meanError)} m${stop}.${electing(scene)}`;
}

function electing(scene) {
  const ids = [];
  for (let i = 0; i < scene.count && ids.length < 4; i++) {
    if (scene.alive(i) && roleWord(scene.role(i)) === 'electing') ids.push(scene.id(i));
  }
  return ids.length ? ` Electing: ${ids.join(', ')}.` : '';
}

function countAlive(scene) {
  let alive = 0;
  for (let i = 0; i < scene.count; i++) alive += scene.alive(i) ? 1 : 0;
  return alive;
}

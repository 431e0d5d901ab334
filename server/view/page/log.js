/* log.js: the events, newest last, of all robots or of one. */

import { clockTime, eventWeight, eventWords } from './words.js';

const LINES_MAX = 500;

export class Log {
  #only = 0;
  #shown = [];

  /* `go(time)` is called for the event that somebody clicked. */
  constructor(list, go) {
    this.list = list;
    list.addEventListener('click', (event) => {
      const line = event.target.closest('li');
      if (line) go(Number(line.dataset.time));
    });
  }

  /* A robot's id, 0: all. */
  set only(id) {
    if (id === this.#only) return;
    this.#only = id;
    this.#shown = [];
    this.list.replaceChildren();
  }

  /* What had not happened at `time` is paler. */
  show(events, time) {
    const wanted = (this.#only ? events.filter(({ robot }) => robot === this.#only || robot === 0) : events).slice(-LINES_MAX);
    const stays = this.list.scrollTop + this.list.clientHeight >= this.list.scrollHeight - 40;
    const same = this.#shown.every((event, k) => event === wanted[k]);
    if (!same) {
      this.list.replaceChildren();
      this.#shown = [];
    }
    const fresh = wanted.slice(this.#shown.length).map(line);
    if (fresh.length > 0) this.list.append(...fresh);
    this.#shown = wanted;
    this.#fade(time);
    if (fresh.length > 0 && stays) this.list.scrollTop = this.list.scrollHeight;
  }

  #fade(time) {
    this.#shown.forEach((event, k) => {
      const later = event.time > time + 1e-6;
      const element = this.list.children[k];
      if (element.classList.contains('later') !== later) element.classList.toggle('later', later);
    });
  }
}

function line(event) {
  const item = document.createElement('li');
  const time = document.createElement('time');
  const who = document.createElement('span');
  const what = document.createElement('span');
  time.textContent = clockTime(event.time);
  who.textContent = event.robot ? `robot ${event.robot}` : 'fleet';
  what.textContent = eventWords(event);
  item.className = `w${eventWeight(event)}`;
  item.dataset.time = event.time;
  item.append(time, who, what);
  return item;
}

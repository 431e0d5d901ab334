/* log.js: the events, newest last, of all robots or of one. */

import { clockTime, eventWeight, eventWords } from './words.js';

const LINES_MAX = 500;

export class Log {
  #only = 0;
  #shown = [];
  #known = -1;
  #faded = 0;

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
    this.#known = -1;
  }

  /* `changes` is another number when the events are others. What had not happened at `time` is paler. */
  show(events, changes, time) {
    if (changes !== this.#known) this.#update(events);
    this.#known = changes;
    this.#fade(time);
  }

  #update(events) {
    const { list } = this;
    const wanted = (this.#only ? events.filter(({ robot }) => robot === this.#only || robot === 0) : events).slice(-LINES_MAX);
    const gone = Math.max(0, this.#shown.indexOf(wanted[0]));
    const stays = this.#shown.slice(gone).every((event, k) => event === wanted[k]);
    const kept = stays ? this.#shown.length - gone : 0;
    if (stays && kept === wanted.length) return;
    const atEnd = list.scrollTop + list.clientHeight >= list.scrollHeight - 40;
    if (!stays) list.replaceChildren();
    else for (let k = 0; k < gone; k++) list.firstChild.remove();
    list.append(...wanted.slice(kept).map(line));
    this.#shown = wanted;
    this.#faded = wanted.length;
    if (atEnd) list.scrollTop = list.scrollHeight;
  }

  /* Those from `later` on are pale, and were so from #faded on. */
  #fade(time) {
    let later = this.#shown.findIndex((event) => event.time > time + 1e-6);
    if (later < 0) later = this.#shown.length;
    for (let k = Math.min(later, this.#faded); k < Math.max(later, this.#faded); k++) {
      this.list.children[k].classList.toggle('later', k >= later);
    }
    this.#faded = later;
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

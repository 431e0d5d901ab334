/* log.js: the events, newest last, of all robots or of one. */

import { clockTime, eventWeight, eventWords } from './words.js';

const LINES_MAX = 500;
const NEAR = 24; /* px from the end that are as good as there */

export class Log {
  #only = 0;
  #shown = [];
  #known = -1;
  #faded = 0;
  #top = 0;
  #follows = true; /* nobody has scrolled back */

  /* `go(time)` is called for the event that somebody clicked. */
  constructor(list, go) {
    this.list = list;
    this.news = document.getElementById('news');
    list.addEventListener('scroll', () => this.#scrolled());
    list.addEventListener('click', (event) => {
      const line = event.target.closest('#log > div');
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

  /* Back by hand, it stays there; at the end, it goes on with the end. */
  #scrolled() {
    const { scrollTop, clientHeight, scrollHeight } = this.list;
    if (scrollTop + clientHeight >= scrollHeight - NEAR) this.#follows = true;
    else if (scrollTop < this.#top) this.#follows = false;
    this.#top = scrollTop;
  }

  #update(events) {
    const { list } = this;
    const wanted = (this.#only ? events.filter(({ robot }) => robot === this.#only || robot === 0) : events).slice(-LINES_MAX);
    const gone = Math.max(0, this.#shown.indexOf(wanted[0]));
    const stays = this.#shown.slice(gone).every((event, k) => event === wanted[k]);
    const kept = stays ? this.#shown.length - gone : 0;
    if (stays && kept === wanted.length) return;
    if (!stays) list.replaceChildren();
    else for (let k = 0; k < gone; k++) list.firstChild.remove();
    list.append(...wanted.slice(kept).map(line));
    if (kept > 0) this.#announce(wanted.slice(kept));
    this.#shown = wanted;
    this.#faded = stays ? Math.max(0, this.#faded - gone) : 0;
    if (this.#follows) list.scrollTop = list.scrollHeight;
  }

  /* To those who listen, the grave ones: what a hundred robots do would never end. */
  #announce(events) {
    const words = events.filter((event) => eventWeight(event) > 0)
      .map((event) => `${whoOf(event)} ${eventWords(event)}`);
    if (words.length > 0) this.news.textContent = words.join('; ');
  }

  /* Those from `later` on are pale, and were so from #faded on; a new line is pale. */
  #fade(time) {
    let later = this.#shown.findIndex((event) => event.time > time + 1e-6);
    if (later < 0) later = this.#shown.length;
    for (let k = Math.min(later, this.#faded); k < Math.max(later, this.#faded); k++) {
      this.list.children[k].classList.toggle('later', k >= later);
    }
    this.#faded = later;
  }
}

function whoOf({ robot }) {
  return robot ? `robot ${robot}` : 'fleet';
}

function line(event) {
  const item = document.createElement('div');
  const time = document.createElement('time');
  const who = document.createElement('span');
  const what = document.createElement('span');
  time.textContent = clockTime(event.time);
  who.textContent = whoOf(event);
  what.textContent = eventWords(event);
  item.className = `w${eventWeight(event)} later`;
  item.dataset.time = event.time;
  item.append(time, who, what);
  return item;
}

/* frames.js: how many pictures a second there are. */

const OVER = 3; /* s */

export class Frames {
  #times = [];

  drawn(now) {
    this.#times.push(now);
    while (this.#times[0] < now - OVER) this.#times.shift();
  }

  /* Over the last seconds; 0 when there were none. */
  rate(now) {
    const counted = this.#times.filter((time) => time >= now - OVER);
    if (counted.length < 2) return 0;
    return (counted.length - 1) / (now - counted[0]);
  }
}

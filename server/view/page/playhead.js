/* playhead.js: the time that is looked at.
 *
 * Live, it runs just behind the newest scene at the pace at which scenes come, so that there is
 * always a next one to move towards. Times of the mission in s, of the wall in s. */

const LAG = 0.06;      /* wall time behind the newest scene */
const PACE_OVER = 0.5; /* wall time over which the pace is measured */
const QUIET = 0.3;     /* without a scene for longer, none is waited for */
const CLOSE = 0.005;   /* of the mission: as good as there */

export class Playhead {
  time = 0;
  mode = 'live'; /* 'live', 'held', 'playing' */
  speed = 1;     /* of 'playing' */
  atEnd = 'live'; /* the mode when 'playing' has come to the newest scene */
  #heard = [];   /* newest times and when they came */

  hold(time) {
    this.mode = 'held';
    this.time = time;
  }

  play() { this.mode = 'playing'; }
  goLive() { this.mode = 'live'; }

  /* A scene that is newer than all others came at `now`. */
  hear(time, now) {
    const last = this.#heard[this.#heard.length - 1];
    if (last && time < last.time) this.#heard.length = 0; /* another run */
    this.#heard.push({ time, now });
    while (this.#heard[0].now < now - PACE_OVER) this.#heard.shift();
  }

  /* Times real time at which scenes come; 0 while none do. */
  pace(now) {
    const first = this.#heard[0];
    const last = this.#heard[this.#heard.length - 1];
    if (!first || now - last.now > QUIET || last.now - first.now < 0.05) return 0;
    return (last.time - first.time) / (last.now - first.now);
  }

  /* `passed` of wall time later, with scenes from `first` to `newest`. */
  advance(passed, now, first, newest) {
    if (this.mode === 'live') this.#follow(passed, now, newest);
    if (this.mode === 'playing') this.time += passed * this.speed;
    if (this.mode === 'playing' && this.time >= newest) {
      this.mode = this.atEnd;
      this.time = newest;
    }
    this.time = Math.min(newest, Math.max(first, this.time));
  }

  #follow(passed, now, newest) {
    const pace = this.pace(now);
    const target = newest - pace * LAG;
    const next = this.time + pace * passed;
    const gap = target - next;
    const jumps = Math.abs(gap) > Math.max(0.3, pace * 0.3);

    if (jumps || (pace === 0 && gap < CLOSE)) this.time = target;
    else this.time = Math.max(this.time, next + gap * Math.min(1, 5 * passed));
  }
}

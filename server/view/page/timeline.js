/* timeline.js: what is known of a run, in the order in which it happened.
 *
 * Scenes and events come in any order, some twice, some never. Past `room` bytes the older ones are
 * thinned, so that a long run keeps its whole length at half the resolution. */

const ROOM = 256 << 20;
const KEPT_WHOLE = 0.1; /* of the scenes, the newest */

export class Timeline {
  scenes = [];
  events = [];
  bytes = 0;
  eventChanges = 0; /* grows whenever the events are others */

  constructor(room = ROOM) {
    this.room = room;
  }

  get first() { return this.scenes[0]; }
  get newest() { return this.scenes[this.scenes.length - 1]; }

  clear() {
    this.scenes = [];
    this.events = [];
    this.bytes = 0;
    this.eventChanges++;
  }

  addScene(scene) {
    const at = place(this.scenes, scene.number);
    if (this.scenes[at]?.number === scene.number) return;
    if (this.scenes[at] && scene.time >= this.scenes[at].time) return; /* of a run before this one */
    let from = at;
    while (from > 0 && this.scenes[from - 1].time >= scene.time) from--;
    for (let i = from; i < at; i++) this.bytes -= this.scenes[i].bytes;
    this.scenes.splice(from, at - from, scene);
    this.bytes += scene.bytes;
    if (this.bytes > this.room) this.#thin();
  }

  addEvent(event) {
    const at = place(this.events, event.number);
    if (this.events[at]?.number === event.number) return;
    this.events.splice(at, 0, event);
    this.eventChanges++;
  }

  /* The last scene that is not after `time`; -1: none. */
  indexAt(time) {
    let low = 0;
    let high = this.scenes.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.scenes[middle].time <= time) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  #thin() {
    const whole = Math.floor(this.scenes.length * (1 - KEPT_WHOLE));
    this.scenes = this.scenes.filter((_, i) => i === 0 || i > whole || i % 2 === 1);
    this.bytes = this.scenes.reduce((sum, scene) => sum + scene.bytes, 0);
  }
}

/* Where a thing of this number is or belongs. Most belong at the end. */
function place(things, number) {
  let low = 0;
  let high = things.length;
  if (high > 0 && things[high - 1].number < number) return high;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (things[middle].number < number) low = middle + 1;
    else high = middle;
  }
  return low;
}

/* transport.js: pause, speed and the way back to now.
 *
 * A simulation is asked to pause and to go faster; a real fleet waits for nobody, so there it is only the
 * picture that is held; what is over, a recording or a run, is played by the page itself. Whoever looks at
 * the past plays that, whatever it is the past of. */

import { markHindered } from './acts.js';
import { clockTime } from './words.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];
const AS_FAST = 0;

export class Transport {
  status = { phase: 'connecting', paused: false, over: false, speed: 1, formations: [] };
  kind = 'sim';

  constructor(playhead, timeline, acts) {
    this.playhead = playhead;
    this.timeline = timeline;
    this.acts = acts;
    for (const name of ['play', 'step', 'speed', 'live', 'past']) this[name] = document.getElementById(name);
    this.words = document.getElementById('past-words');
    this.play.addEventListener('click', () => this.toggle());
    this.step.addEventListener('click', () => this.stepOn());
    this.speed.addEventListener('change', () => this.#setSpeed(Number(this.speed.value)));
    this.live.addEventListener('click', () => this.goLive());
    this.back = document.getElementById('past-live');
    this.back.addEventListener('click', () => this.goLive());
    this.#offerSpeeds();
  }

  begin(kind) {
    this.kind = kind;
    this.playhead.mode = kind === 'replay' ? 'held' : 'live';
    this.playhead.atEnd = kind === 'replay' ? 'held' : 'live';
    this.#offerSpeeds();
    this.update();
  }

  get isOver() { return this.kind === 'replay' || this.status.over; }

  get steersRun() { return this.kind === 'sim' && !this.isOver && this.playhead.mode === 'live'; }

  /* Looks at the end, behind which nothing comes. */
  get atEnd() { return this.isOver && this.playhead.mode !== 'playing' && this.playhead.time >= this.timeline.newest?.time; }

  get still() {
    if (this.steersRun) return this.status.paused;
    return this.playhead.mode === 'held' || this.atEnd;
  }

  toggle() {
    const { playhead, timeline } = this;
    if (!timeline.newest) return;
    if (this.steersRun) this.#pauseRun();
    else if (this.atEnd) this.#playFrom(timeline.first.time);
    else if (playhead.mode !== 'held') playhead.hold(playhead.time);
    else playhead.play();
    this.update();
  }

  /* To the next scene, or a tick of the simulation. */
  stepOn() {
    const { playhead, timeline } = this;
    if (!timeline.newest) return;
    if (this.steersRun) {
      if (this.status.paused) this.acts.ask('step', {}, 'The simulation did no tick');
      else this.#pauseRun();
      return;
    }
    const next = timeline.scenes[timeline.indexAt(playhead.time) + 1];
    playhead.hold(next ? next.time : playhead.time);
    this.update();
  }

  scrub(time) {
    this.playhead.hold(time);
    this.update();
  }

  goLive() {
    if (this.kind === 'replay') this.playhead.hold(this.timeline.newest?.time ?? 0);
    else this.playhead.goLive();
    this.update();
  }

  /* What buttons and the notice say. */
  update() {
    const { playhead, timeline, kind } = this;
    const live = playhead.mode === 'live';
    const past = !live && kind !== 'replay' && timeline.newest !== undefined;
    this.live.hidden = this.isOver;
    document.getElementById('over').hidden = !this.status.over || kind === 'replay' || !live;
    this.play.classList.toggle('paused', this.still);
    label(this.play, `${this.#playWord()} (space)`);
    this.step.hidden = live && kind === 'serve';
    this.speed.parentElement.hidden = kind === 'serve' && !this.isOver;
    this.live.ariaPressed = String(live && this.acts.connection.isOpen);
    this.past.hidden = !past;
    if (past) this.#sayPast();
    if (this.steersRun) {
      markHindered(this.play, this.acts.hindrance(this.status.paused ? 'resume' : 'pause'));
      markHindered(this.step, this.acts.hindrance('step'));
    } else {
      for (const button of [this.play, this.step]) button.ariaDisabled = 'false';
    }
    this.speed.disabled = !this.isOver && this.acts.hindrance('speed') !== null;
    if (this.speed.value !== String(this.#speedNow) || this.offered !== this.isOver) this.#offerSpeeds();
  }

  #sayPast() {
    const words = `You are looking at t = ${clockTime(this.playhead.time)}; ` +
      `${this.status.over ? 'the end' : 'live'} is ${clockTime(this.timeline.newest.time)}.` +
      (this.kind === 'serve' && !this.status.over ? ' What you ask for is done to the fleet as it is now.' : '');
    if (this.words.textContent !== words) this.words.textContent = words;
    this.back.textContent = this.status.over ? 'To the end' : 'Go live';
  }

  #playWord() {
    if (this.steersRun) return this.status.paused ? 'Go on' : 'Pause the simulation';
    if (this.playhead.mode === 'held' || this.atEnd) return 'Play';
    return this.kind === 'serve' && this.playhead.mode === 'live' ? 'Hold the picture' : 'Pause';
  }

  #pauseRun() {
    if (this.status.paused) this.acts.ask('resume', {}, 'The simulation does not go on');
    else this.acts.ask('pause', {}, 'The simulation was not paused');
  }

  #playFrom(time) {
    this.playhead.time = time;
    this.playhead.play();
  }

  #setSpeed(speed) {
    if (this.isOver) this.playhead.speed = speed;
    else this.acts.ask('speed', { speed }, 'The speed was not changed');
  }

  get #speedNow() { return this.isOver ? this.playhead.speed : this.status.speed; }

  /* Those of the list, and the one in force if it is another one. */
  #offerSpeeds() {
    const now = this.#speedNow;
    const speeds = [...new Set([...SPEEDS, ...(now > 0 ? [now] : [])])].sort((a, b) => a - b);
    const options = speeds.map((speed) => new Option(`${speed} ×`, String(speed)));
    if (!this.isOver) options.push(new Option('as fast as it goes', String(AS_FAST)));
    this.speed.replaceChildren(...options);
    this.speed.value = String(now);
    this.offered = this.isOver;
  }
}

function label(button, words) {
  if (button.ariaLabel === words) return;
  button.ariaLabel = words;
  button.title = words;
  button.dataset.title = words;
}

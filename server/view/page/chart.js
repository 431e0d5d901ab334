/* chart.js: the mean error over the run, with events; it is also what time is chosen by. Errors are metres
 * when a leader is lost and millimetres when all is well, so their axis is logarithmic. */

import { clockTime, eventWeight, eventWords, metres } from './words.js';

const FOOT = 18; /* px for the times below */
const HEAD = 12; /* px for events above */
const SIDE = 42; /* px for metres at the left */
const FLOOR = 0.001; /* m */
const DECADES = [[0.001, '1 mm'], [0.01, '1 cm'], [0.1, '10 cm'], [1, '1 m'], [10, '10 m'], [100, '100 m'], [1000, '1 km']];
const STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 43200];
const LONGER = [30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400, 28800, 43200, 86400];
const SHORT = 120; /* s of a run whose whole length is shown from the beginning */
const TICK = 0.02; /* s */

/* The end of the axis: the run's when it is near, else something round. */
export function axisEnd(newest, duration, whole) {
  if (whole) return Math.max(newest, 1);
  if (duration > 0 && duration <= SHORT) return Math.max(newest, duration);
  const round = LONGER.find((end) => end >= newest * 1.05) ?? newest * 1.1;
  return Math.max(newest, duration > 0 ? Math.min(round, duration) : round);
}

/* Least and greatest of values that fall into each of `columns` of the axis; NaN where none does. */
export function columnsOf(scenes, begin, end, columns) {
  const low = new Float64Array(columns).fill(NaN);
  const high = new Float64Array(columns).fill(NaN);
  for (const scene of scenes) {
    const k = Math.floor((scene.time - begin) / (end - begin) * columns);
    const value = scene.meanError;
    if (k < 0 || k >= columns || !Number.isFinite(value)) continue;
    if (!(low[k] <= value)) low[k] = value;
    if (!(high[k] >= value)) high[k] = value;
  }
  return { low, high };
}

export class Chart {
  #begin = 0;
  #end = 1;
  #timeline = null;
  #held = false; /* a pointer holds the playhead */

  /* `scrub(time)` and `live()` are called for what somebody asks. */
  constructor(element, { scrub, live }) {
    this.element = element;
    this.canvas = element.querySelector('canvas');
    this.playhead = element.querySelector('.playhead');
    this.readout = element.querySelector('.readout');
    this.pen = this.canvas.getContext('2d');
    this.scrub = scrub;
    this.live = live;
    element.addEventListener('pointerdown', (event) => this.#press(event));
    element.addEventListener('pointermove', (event) => this.#move(event));
    element.addEventListener('pointerup', () => { this.#held = false; });
    element.addEventListener('pointercancel', () => { this.#held = false; });
    element.addEventListener('pointerleave', () => { this.readout.hidden = true; });
    element.addEventListener('keydown', (event) => this.#key(event));
  }

  /* Draws it all; a few times a second is enough. */
  draw(timeline, duration, whole, colours) {
    if (!timeline.newest) return;
    const ratio = window.devicePixelRatio || 1;
    this.width = this.element.clientWidth;
    this.height = this.element.clientHeight;
    fit(this.canvas, this.width * ratio, this.height * ratio);
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.pen.clearRect(0, 0, this.width, this.height);
    this.#timeline = timeline;
    this.#begin = Math.max(timeline.first.time, Math.min(-1, timeline.newest.time - 1));
    this.#end = axisEnd(timeline.newest.time, duration, whole);
    this.colours = colours;
    const columns = columnsOf(timeline.scenes, this.#begin, this.#end, Math.max(1, Math.floor(this.width - SIDE)));
    const top = topOf(columns.high);
    this.#drawAxes(top);
    this.#drawCurve(columns, top);
    this.#drawEvents(timeline.events);
    this.#say('ariaValueMin', this.#begin.toFixed(2));
    this.#say('ariaValueMax', timeline.newest.time.toFixed(2));
  }

  /* Where the playhead is; every picture. */
  point(time) {
    this.time = time;
    if (this.width === undefined) return;
    this.playhead.hidden = false;
    this.playhead.style.transform = `translateX(${this.#x(time).toFixed(1)}px)`;
  }

  /* For those who cannot see it; seldom. */
  tell(time) {
    this.#say('ariaValueNow', time.toFixed(2));
    this.#say('ariaValueText', clockTime(time));
  }

  #say(name, value) {
    if (this.element[name] !== value) this.element[name] = value;
  }

  #x(time) { return SIDE + (time - this.#begin) / (this.#end - this.#begin) * (this.width - SIDE); }
  #time(x) { return this.#begin + (x - SIDE) / (this.width - SIDE) * (this.#end - this.#begin); }
  #y(value, top) {
    const part = Math.log(Math.max(value, FLOOR) / FLOOR) / Math.log(top / FLOOR);
    return this.height - FOOT - part * (this.height - FOOT - HEAD);
  }

  #drawAxes(top) {
    const { pen, colours, width, height } = this;
    const newest = this.#x(this.#timeline.newest.time);
    pen.fillStyle = colours.chartRest;
    pen.fillRect(SIDE, HEAD, width - SIDE, height - FOOT - HEAD);
    pen.font = '11px system-ui, sans-serif';
    pen.textBaseline = 'alphabetic';
    pen.textAlign = 'left';
    const perStep = (step) => step * (width - SIDE) / (this.#end - this.#begin);
    const step = STEPS.find((one) => perStep(one) >= 60) ?? STEPS[STEPS.length - 1];
    for (let k = Math.ceil(this.#begin / step); k * step <= this.#end; k++) {
      const x = Math.round(this.#x(k * step)) + 0.5;
      this.#line(x, HEAD, x, height - FOOT, colours.grid);
      if (x > width - 30) continue;
      pen.fillStyle = colours.soft;
      pen.fillText(clockTime(k * step, step < 1 ? 1 : 0), x + 1, height - 5);
    }
    pen.textAlign = 'right';
    for (const [value, words] of DECADES.filter(([one]) => one <= top)) {
      const y = Math.round(this.#y(value, top)) + 0.5;
      this.#line(SIDE, y, width, y, colours.grid);
      pen.fillStyle = colours.soft;
      pen.fillText(words, SIDE - 5, y + 3.5);
    }
    this.#line(newest, HEAD, newest, height - FOOT, colours.soft);
    this.#line(SIDE, height - FOOT + 0.5, width, height - FOOT + 0.5, colours.soft);
    pen.fillStyle = colours.soft;
    pen.fillText('mean error', width - 4, HEAD + 12);
  }

  #line(x, y, toX, toY, colour) {
    const { pen } = this;
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(toX, toY);
    pen.strokeStyle = colour;
    pen.lineWidth = 1;
    pen.stroke();
  }

  #drawCurve({ low, high }, top) {
    const { pen, colours, height } = this;
    pen.beginPath();
    let [from, last] = [0, -1];
    for (let k = 0; k < high.length; k++) {
      if (Number.isNaN(high[k])) continue;
      if (last < 0) pen.moveTo(SIDE + k + 0.5, this.#y(high[k], top));
      else pen.lineTo(SIDE + k + 0.5, this.#y(high[k], top));
      if (low[k] !== high[k]) pen.lineTo(SIDE + k + 0.5, this.#y(low[k], top));
      if (last < 0) from = k;
      last = k;
    }
    if (last < 0) return;
    pen.strokeStyle = colours.chartLine;
    pen.lineWidth = 1.6;
    pen.lineJoin = 'round';
    pen.stroke();
    pen.lineTo(SIDE + last + 0.5, height - FOOT);
    pen.lineTo(SIDE + from + 0.5, height - FOOT);
    pen.closePath();
    pen.fillStyle = colours.chartFill;
    pen.fill();
  }

  /* Grave ones are taller and of another colour. */
  #drawEvents(events) {
    const { pen, colours } = this;
    for (const weight of [0, 1, 2]) {
      pen.beginPath();
      for (const event of events) {
        if (eventWeight(event) !== weight || event.time < this.#begin) continue;
        const x = Math.round(this.#x(event.time)) + 0.5;
        pen.moveTo(x, HEAD);
        pen.lineTo(x, HEAD - [4, 8, 11][weight]);
      }
      pen.strokeStyle = [colours.vertex, colours.accent, colours.trouble][weight];
      pen.lineWidth = [1, 1.5, 2.5][weight];
      pen.stroke();
    }
  }

  #press(event) {
    if (!this.#timeline) return;
    this.#held = true;
    this.element.setPointerCapture(event.pointerId);
    this.#ask(this.#time(this.#at(event)));
  }

  #move(event) {
    if (!this.#timeline) return;
    const x = this.#at(event);
    if (this.#held) this.#ask(this.#time(x));
    this.#read(x);
  }

  #at(event) { return event.clientX - this.element.getBoundingClientRect().left; }

  /* What is under the pointer, in words. */
  #read(x) {
    const { readout } = this;
    const scene = this.#timeline.scenes[this.#timeline.indexAt(this.#time(x))];
    readout.hidden = !scene || this.#time(x) > this.#timeline.newest.time;
    if (readout.hidden) return;
    const near = this.#timeline.events.filter(({ time }) => Math.abs(this.#x(time) - x) < 4)
      .sort((a, b) => eventWeight(b) - eventWeight(a))[0];
    const said = near ? ` · ${near.robot ? `robot ${near.robot}` : 'fleet'} ${eventWords(near)}` : '';
    readout.textContent = `${clockTime(scene.time)} · ${metres(scene.meanError)} m${said}`;
    readout.style.transform = `translateX(${Math.max(0, Math.min(this.width - readout.offsetWidth, x + 10))}px)`;
  }

  #ask(time) {
    const { first, newest } = this.#timeline;
    if (time >= newest.time) this.live();
    else this.scrub(Math.max(first.time, time));
  }

  #key(event) {
    if (!this.#timeline || event.ctrlKey || event.altKey || event.metaKey) return;
    const little = event.shiftKey ? 1 : TICK;
    const steps = { ArrowLeft: -little, ArrowRight: little, ArrowDown: -little, ArrowUp: little, PageDown: -5, PageUp: 5 };
    if (event.key === 'Home') this.scrub(this.#timeline.first.time);
    else if (event.key === 'End') this.live();
    else if (event.key in steps) this.#ask(this.time + steps[event.key]);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

/* A little above the greatest, and 10 cm at least. */
function topOf(values) {
  let top = 0.1;
  for (const value of values) top = Math.max(top, 1.3 * value || 0);
  return top;
}

function fit(canvas, width, height) {
  if (canvas.width !== Math.round(width)) canvas.width = Math.round(width);
  if (canvas.height !== Math.round(height)) canvas.height = Math.round(height);
}

/* page.js: puts the page together, and draws a picture whenever the browser is ready for one. */

import { Acts, markHindered } from './acts.js';
import { Arena } from './arena.js';
import { Camera } from './camera.js';
import { Chart } from './chart.js';
import { Connection } from './connection.js';
import { Scene, readEvent } from './fleet.js';
import { Drawing } from './draw.js';
import { Formations } from './formations.js';
import { Frames } from './frames.js';
import { Hand } from './hand.js';
import { Instruments } from './instruments.js';
import { Log } from './log.js';
import { drawLegend } from './legend.js';
import { Look } from './look.js';
import { Panel } from './panel.js';
import { Playhead } from './playhead.js';
import { Poses } from './poses.js';
import { Table } from './table.js';
import { Timeline } from './timeline.js';
import { takeToken } from './token.js';
import { toast } from './toast.js';
import { Transport } from './transport.js';
import { colours, startTheme } from './theme.js';
import { listenToKeys } from './keys.js';
import { clockTime } from './words.js';

const SLOWLY = 0.22; /* s between two updates of what is read, not watched */
const LOADED = 1; /* s without anything new: all of a recording is here */

const at = (id) => document.getElementById(id);

const timeline = new Timeline();
const playhead = new Playhead();
const camera = new Camera();
const poses = new Poses();
const frames = new Frames();
const instruments = new Instruments();
const arena = new Arena(at('arena'), camera);
const look = new Look(camera);
const token = takeToken();

let hello = null;
let connected = false;
let fresh = true; /* nothing has come by this connection yet */
let heardAt = 0; /* when the last scene came, s */
let waits = false; /* a recording that is still coming */
let picked = 0;
let ghost = null;
let drawn = { key: '' };
let scene = null;
let lastFrame = 0;
let lastSlow = 0;
let themeChanges = 0;
let misread = false;

const now = () => performance.now() / 1000;

const connection = new Connection(`${location.protocol.replace('http', 'ws')}//${location.host}/`, token, {
  opened() {
    connected = true;
    fresh = true;
    at('lost').hidden = true;
  },
  hello(words) {
    hello = words;
    acts.hello = words;
    instruments.name(words.title);
    transport.begin(words.kind);
    waits = words.kind === 'replay';
    at('stop').hidden = !acts.has('estop');
    at('looking').hidden = Boolean(token) || words.acts.length === 0;
  },
  status(words) {
    transport.status = words;
    acts.over = words.over;
    transport.update();
    tellPhase();
  },
  scene: (bytes, number) => take(() => takeScene(new Scene(bytes, number))),
  event: (bytes, number) => take(() => timeline.addEvent(readEvent(bytes, number))),
  lost() {
    connected = false;
    tellLost();
    tellPhase();
  },
});
const acts = new Acts(connection, token, toast);
const transport = new Transport(playhead, timeline, acts);
const panel = new Panel(at('panel'), acts, () => pick(0));
const table = new Table(at('table'), pick);
const log = new Log(at('log'), (time) => transport.scrub(time));
const chart = new Chart(at('chart'), { scrub: (time) => transport.scrub(time), live: () => transport.goLive() });
const formations = new Formations(at('formations'), acts, () => draws());
const drawing = new Drawing(at('drawing'), acts, {
  known: () => transport.status.formations,
  closed() {
    document.querySelector('section.arena').hidden = false;
    arena.canvas.focus({ preventScroll: true }); /* keys are for the page again, at once */
  },
});
const changeTheme = startTheme(() => { themeChanges++; });

const hand = new Hand(at('arena'), {
  robotAt: (px, py, slack) => idAt(arena.robotAt(px, py, slack)),
  pick,
  pan: (dx, dy) => look.pan(dx, dy),
  zoom: (factor, px, py) => look.zoom(factor, px, py),
  mayMove: (id) => acts.hindrance('move') === null && playhead.mode === 'live' && id !== 0,
  drag(id, px, py) {
    if (picked !== id) pick(id);
    const i = scene.indexOf(id);
    ghost = { x: camera.toArenaX(px), y: camera.toArenaY(py), theta: scene.theta(i) };
  },
  drop() {
    panel.move(ghost);
    ghost = null;
  },
  stay() { ghost = null; },
});

function take(read) {
  try {
    if (fresh) timeline.clear();
    fresh = false;
    read();
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    if (!misread) toast('Some of what comes cannot be read: the page is of another age than the program. Reload it.');
    misread = true;
  }
}

function takeScene(one) {
  const newest = timeline.newest;
  timeline.addScene(one);
  heardAt = now();
  if (timeline.newest !== newest) playhead.hear(timeline.newest.time, heardAt);
}

function idAt(i) {
  return i >= 0 && scene ? scene.id(i) : 0;
}

/* A robot's id, 0: none. */
function pick(id) {
  picked = id;
  panel.id = id;
  table.picked = id;
  log.only = id;
  at('events-of').textContent = id ? `of robot ${id} and of all` : '';
  at('robots-hint').hidden = id !== 0;
  lastSlow = 0;
}

function pickNext(step) {
  if (!scene) return;
  const i = picked ? scene.indexOf(picked) : step > 0 ? -1 : 0;
  pick(idAt((i + step + scene.count) % scene.count));
}

function draws() {
  if (!scene || !acts.has('draw')) return;
  if (drawing.isOpen) {
    drawing.close();
    return;
  }
  pick(0); /* on a phone its panel lies over the board's list */
  document.querySelector('section.arena').hidden = true;
  drawing.open(scene);
}

function showSigns(shown) {
  const sheet = at('signs');
  sheet.hidden = !shown;
  if (!shown) return at('help').focus();
  drawLegend(at('legend'), colours);
  return sheet.focus();
}

function stop() {
  if (!hello || !acts.has('estop')) return;
  acts.ask('estop', {}, 'The fleet was not stopped');
}

function tellPhase() {
  if (!connected) instruments.tellPhase(transport.status.over ? 'over' : 'not connected', transport.status.over ? '' : 'bad');
  else if (waits) instruments.tellPhase('loading', '');
  else if (scene?.estopped) instruments.tellPhase('stopped', 'bad');
  else instruments.tellPhase(transport.status.phase, transport.status.over || transport.status.paused ? '' : 'runs');
}

function tellLost() {
  at('lost').hidden = false;
  sayLost();
}

function sayLost() {
  if (connected || at('lost').hidden) return;
  const words = transport.status.over ? 'The program has ended. What it sent can still be looked at.'
    : timeline.newest ? `The connection is lost; the last that is known is of ${clockTime(timeline.newest.time)}. Trying again …`
      : 'There is no connection to muster. Trying again …';
  if (at('lost').textContent !== words) at('lost').textContent = words;
  at('lost').classList.toggle('bad', !transport.status.over);
}

/* A recording is played once it is here; it comes from its end. */
function startReplay() {
  if (!waits || !timeline.newest) return;
  if (timeline.first.time > 0 && now() - heardAt < LOADED) {
    playhead.hold(timeline.first.time);
    return;
  }
  waits = false;
  playhead.time = Math.max(timeline.first.time, 0);
  playhead.play();
  transport.update();
}

function picture(milliseconds) {
  requestAnimationFrame(picture);
  const time = milliseconds / 1000;
  const passed = Math.min(0.25, time - lastFrame);
  lastFrame = time;
  const resized = arena.resize();
  if (!timeline.newest) {
    if (resized || drawn.key !== themeChanges) arena.drawNothing(colours);
    drawn.key = themeChanges;
    return;
  }
  startReplay();
  playhead.advance(passed, now(), timeline.first.time, timeline.newest.time);
  const index = Math.max(0, timeline.indexAt(playhead.time));
  scene = timeline.scenes[index];
  draw(timeline.scenes[index + 1], passed);
  chart.point(playhead.time);
  if (time - lastSlow < SLOWLY) return;
  lastSlow = time;
  readings();
}

function draw(next, passed) {
  poses.set(scene, next, playhead.time);
  look.steer(scene, poses, passed);
  const key = [scene.number, next?.number, playhead.time, camera.x, camera.y, camera.scale, camera.width, camera.height,
               look.changes, themeChanges, picked, ghost?.x, ghost?.y, ghost?.theta].join();
  if (key === drawn.key) return;
  drawn = { key };
  arena.draw({ scene, next, poses, time: playhead.time, timeline, show: look.show, picked, ghost, colours, now: now() });
  frames.drawn(now());
}

/* What is read, a few times a second. */
function readings() {
  instruments.show(scene, playhead.time);
  table.show(scene);
  panel.show(scene);
  drawing.show(timeline.newest, colours);
  log.show(timeline.events, timeline.eventChanges, playhead.time);
  formations.show(transport.status.formations, scene.formation);
  transport.update();
  chart.draw(timeline, hello?.duration ?? 0, hello?.kind === 'replay', colours);
  chart.tell(playhead.time);
  tellPhase();
  sayLost();
  showStop();
  showEnds();
}

function showStop() {
  const button = at('stop');
  const done = timeline.newest.estopped;
  button.classList.toggle('done', done);
  const words = done ? 'STOPPED' : 'STOP';
  if (button.textContent !== words) button.textContent = words;
  markHindered(button, acts.hindrance('estop'));
}

/* Of real robots; a simulation begins by itself. */
function showEnds() {
  at('begin').hidden = !acts.has('begin') || transport.status.phase !== 'gathering';
  at('end').hidden = !acts.has('end') || transport.status.over;
  for (const act of ['begin', 'end']) markHindered(at(act), acts.hindrance(act));
}

/* What lies below it goes by its height. */
new ResizeObserver(([{ target }]) => {
  document.documentElement.style.setProperty('--bar', `${target.offsetHeight}px`);
}).observe(document.querySelector('.bar'));

at('stop').addEventListener('click', stop);
at('begin').addEventListener('click', () => acts.ask('begin', {}, 'The mission was not begun'));
at('end').addEventListener('click', () => acts.ask('end', {}, 'The run was not ended'));
at('theme').addEventListener('click', changeTheme);
at('help').addEventListener('click', () => showSigns(at('signs').hidden));
at('signs-close').addEventListener('click', () => showSigns(false));

listenToKeys({
  stop,
  pickNext,
  /* Whether there is such a robot. */
  pick(id) {
    const found = scene !== null && scene.indexOf(id) >= 0;
    if (found) pick(id);
    return found;
  },
  play: () => transport.toggle(),
  step: () => transport.stepOn(),
  live: () => transport.goLive(),
  fit: () => look.go('fit'),
  follow: () => look.go('follow'),
  zoom: (factor) => look.zoom(factor),
  pan: (dx, dy) => look.pan(dx, dy),
  toggle: (name) => look.toggle(name),
  trails: () => look.nextTrails(),
  draws,
  signs: () => showSigns(at('signs').hidden),
  back() {
    if (!at('signs').hidden) showSigns(false);
    else if (drawing.isOpen) drawing.close();
    else if (hand.drags) hand.giveUp();
    else pick(0);
  },
});

/* For tests and tinkerers: what is on the screen. Reading only. */
window.muster = Object.freeze({
  get fps() { return frames.rate(now()); },
  get hello() { return structuredClone(hello); },
  get status() { return structuredClone(transport.status); },
  get time() { return playhead.time; },
  get newest() { return timeline.newest?.time; },
  /* Where in the window a place of the arena is. */
  place(x, y) {
    const box = arena.canvas.getBoundingClientRect();
    return { x: box.left + camera.toScreenX(x), y: box.top + camera.toScreenY(y) };
  },
  get scene() { return scene && scene.toObject(); },
});

requestAnimationFrame(picture);

/* look.js: what of the arena is looked at, and with what drawn in. */

import { boxOf } from './camera.js';

const CALM = matchMedia('(prefers-reduced-motion: reduce)');
const GROWS = 1.3;  /* how much too small the fleet may look before the view comes closer */
const HEAD = 46; /* px at the top where the tools are */
const TRAILS = ['0', '3', '10', '30'];

export class Look {
  mode = 'fit'; /* 'fit', 'follow', 'free' */
  show = { ids: true, links: false, range: false, trails: 10 };
  changes = 0;
  #goal = null;

  constructor(camera) {
    this.camera = camera;
    this.fit = document.getElementById('fit');
    this.follow = document.getElementById('follow');
    this.trails = document.getElementById('trails');
    this.fit.addEventListener('click', () => this.go('fit'));
    this.follow.addEventListener('click', () => this.go('follow'));
    document.getElementById('zoom-in').addEventListener('click', () => this.zoom(1.4));
    document.getElementById('zoom-out').addEventListener('click', () => this.zoom(1 / 1.4));
    for (const name of ['ids', 'links', 'range']) {
      document.getElementById(name).addEventListener('click', () => this.toggle(name));
    }
    this.trails.addEventListener('change', () => this.#setTrails(this.trails.value));
  }

  /* Asked for again, it lets go. */
  go(mode) {
    this.mode = mode === this.mode ? 'free' : mode;
    this.#goal = null;
    this.#mark();
  }

  toggle(name, on = !this.show[name]) {
    this.show[name] = on;
    this.#mark();
  }

  nextTrails() {
    this.#setTrails(TRAILS[(TRAILS.indexOf(this.trails.value) + 1) % TRAILS.length]);
  }

  pan(dx, dy) {
    this.mode = 'free';
    this.camera.pan(dx, dy);
    this.#mark();
  }

  /* While a leader is followed it stays in the middle. */
  zoom(factor, px, py) {
    if (this.mode === 'follow') this.camera.zoom(factor);
    else {
      this.mode = 'free';
      this.camera.zoom(factor, px, py);
    }
    this.#mark();
  }

  /* Moves the camera; `passed` s of wall time since the last picture. */
  steer(scene, poses, passed) {
    if (this.mode === 'free') return;
    const part = CALM.matches ? 1 : 1 - Math.exp(-passed * 4);
    if (this.mode === 'follow') this.camera.approach({ ...leaderAt(scene, poses), scale: this.camera.scale }, Math.min(1, part * 2));
    else this.#keepAll(scene, part);
  }

  #keepAll(scene, part) {
    const { camera } = this;
    const wanted = camera.fitting(boxOf(scene), HEAD);
    const first = this.#goal === null;
    this.#goal ??= wanted;
    const stays = !first && wanted.scale > this.#goal.scale * 0.97 && wanted.scale < this.#goal.scale * GROWS;
    this.#goal = { ...wanted, scale: stays ? this.#goal.scale : wanted.scale };
    camera.approach(this.#goal, this.begun && !isFar(camera, this.#goal) ? part : 1);
    this.begun = true;
  }

  #setTrails(value) {
    this.trails.value = value;
    this.show.trails = Number(value);
    this.#mark();
  }

  #mark() {
    this.changes++;
    press(this.fit, this.mode === 'fit');
    press(this.follow, this.mode === 'follow');
    for (const name of ['ids', 'links', 'range']) press(document.getElementById(name), this.show[name]);
  }
}

/* After a leap in time nobody waits until the fleet comes into sight. */
function isFar(camera, { x, y }) {
  return Math.abs(x - camera.x) * camera.scale > camera.width / 2 || Math.abs(y - camera.y) * camera.scale > camera.height / 2;
}

function leaderAt(scene, poses) {
  const i = scene.leader ? scene.indexOf(scene.leader) : -1;
  return i < 0 ? scene.about : { x: poses.x[i], y: poses.y[i] };
}

function press(button, pressed) {
  button.ariaPressed = String(pressed);
}

/* hand.js: mouse, fingers and wheel on the arena. */

const FAR = 6; /* px that make a drag of a click */
const SLACK = { mouse: 5, pen: 8, touch: 16 }; /* px beside a robot that still mean it */

export class Hand {
  #pointers = new Map();
  #from = null; /* where a press began */
  #spread = 0;  /* of two fingers, px */

  /* `told` has robotAt(px, py, slack) to an id or 0, pick(id), pan(dx, dy), zoom(factor, px, py), mayMove(id),
   * drag(id, px, py), drop(id, px, py), stay(): a drag that is given up. */
  constructor(canvas, told) {
    this.canvas = canvas;
    this.told = told;
    canvas.addEventListener('pointerdown', (event) => this.#down(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    canvas.addEventListener('pointerup', (event) => this.#up(event, true));
    canvas.addEventListener('pointercancel', (event) => this.#up(event, false));
    canvas.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
  }

  get drags() { return Boolean(this.#from?.dragged); }

  giveUp() {
    if (this.#from?.robot && this.#from.dragged) this.told.stay();
    this.#from = null;
  }

  #down(event) {
    if (event.button > 1) return;
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.#at(event);
    this.#pointers.set(event.pointerId, at);
    if (this.#pointers.size === 2) {
      this.giveUp();
      this.#spread = this.#fingers().spread;
      return;
    }
    const robot = event.button === 0 ? this.told.robotAt(at.x, at.y, SLACK[event.pointerType] ?? 6) : 0;
    this.#from = { ...at, robot, dragged: false };
  }

  #move(event) {
    const at = this.#at(event);
    const before = this.#pointers.get(event.pointerId);
    if (!before) {
      this.canvas.classList.toggle('over', this.told.robotAt(at.x, at.y, SLACK.mouse) !== 0);
      return;
    }
    if (this.#pointers.size === 2) {
      this.#pinch(event.pointerId, at);
      return;
    }
    this.#pointers.set(event.pointerId, at);
    const from = this.#from;
    if (!from) return;
    if (!from.dragged && Math.hypot(at.x - from.x, at.y - from.y) < FAR) return;
    if (!from.dragged) from.moves = from.robot !== 0 && this.told.mayMove(from.robot);
    from.dragged = true;
    this.canvas.classList.add('drags');
    if (from.moves) this.told.drag(from.robot, at.x, at.y);
    else this.told.pan(at.x - before.x, at.y - before.y);
  }

  #up(event, done) {
    const at = this.#at(event);
    this.#pointers.delete(event.pointerId);
    this.canvas.classList.remove('drags');
    const from = this.#from;
    this.#from = null;
    if (!from) return;
    if (from.moves && done) this.told.drop(from.robot, at.x, at.y);
    else if (from.moves) this.told.stay();
    else if (!from.dragged && done) this.told.pick(from.robot);
  }

  #pinch(id, at) {
    const before = this.#fingers();
    this.#pointers.set(id, at);
    const after = this.#fingers();
    this.told.pan(after.x - before.x, after.y - before.y);
    if (this.#spread > 0 && after.spread > 0) this.told.zoom(after.spread / this.#spread, after.x, after.y);
    this.#spread = after.spread;
  }

  #fingers() {
    const [a, b] = [...this.#pointers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.hypot(a.x - b.x, a.y - b.y) };
  }

  #wheel(event) {
    event.preventDefault();
    const at = this.#at(event);
    const lines = event.deltaMode === 1 ? event.deltaY * 16 : event.deltaY;
    this.told.zoom(Math.exp(-lines * (event.ctrlKey ? 0.01 : 0.0015)), at.x, at.y);
  }

  #at(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
}

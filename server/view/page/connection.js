/* connection.js: the page's end of muster.view.v1 (docs/VIEWING.md). It connects again when it is cut off. */

const PROTOCOL = 'muster.view.v1';
const RETRY_FIRST = 0.5; /* s; doubles up to the last */
const RETRY_LAST = 10;
const RECORD_HEAD = 12;
const SCENE = 1;
const EVENT = 2;

export class Connection {
  #socket = null;
  #token;
  #number = 0;
  #waiting = new Map(); /* answers, by the request's number */
  #retry = RETRY_FIRST;
  #timer = 0;

  /* `told` has hello, status, scene(bytes, number), event(bytes, number), opened, lost. */
  constructor(url, token, told) {
    this.url = url;
    this.#token = token;
    this.told = told;
    this.open();
  }

  get isOpen() { return this.#socket?.readyState === WebSocket.OPEN; }

  open() {
    clearTimeout(this.#timer);
    if (this.#socket && this.#socket.readyState <= WebSocket.OPEN) return;
    const socket = new WebSocket(this.url, PROTOCOL);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.#retry = RETRY_FIRST;
      this.told.opened();
    };
    socket.onmessage = ({ data }) => {
      if (typeof data === 'string') this.#hear(JSON.parse(data));
      else this.#take(new Uint8Array(data));
    };
    socket.onclose = () => this.#lose();
    this.#socket = socket;
  }

  /* Resolves to null when it was done, to words when it was not. */
  ask(act, further = {}) {
    if (!this.isOpen) return Promise.resolve('there is no connection');
    const number = ++this.#number;
    this.#socket.send(JSON.stringify({ number, token: this.#token, act, ...further }));
    return new Promise((resolve) => this.#waiting.set(number, resolve));
  }

  #hear({ hello, status, answer }) {
    if (hello) this.told.hello(hello);
    if (status) this.told.status(status);
    if (!answer) return;
    this.#waiting.get(answer.number)?.(answer.refused);
    this.#waiting.delete(answer.number);
  }

  #take(bytes) {
    const view = new DataView(bytes.buffer);
    for (let at = 0; at + RECORD_HEAD <= bytes.length;) {
      const number = view.getUint32(at + 4, true);
      const begin = at + RECORD_HEAD;
      const end = begin + view.getUint32(at + 8, true);
      if (end > bytes.length) return;
      if (bytes[at] === SCENE) this.told.scene(bytes.subarray(begin, end), number);
      if (bytes[at] === EVENT) this.told.event(bytes.subarray(begin, end), number);
      at = Math.ceil(end / 8) * 8;
    }
  }

  #lose() {
    for (const resolve of this.#waiting.values()) resolve('the connection was lost before it was answered');
    this.#waiting.clear();
    this.#timer = setTimeout(() => this.open(), this.#retry * 1000);
    this.told.lost();
    this.#retry = Math.min(RETRY_LAST, this.#retry * 2);
  }
}

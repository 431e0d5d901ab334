/* fleet.js: the two messages that a run consists of, out of little-endian CDR.
 *
 * muster_msgs/msg/Fleet is read in place: of a hundred robots, fifty times a second, most values are
 * never asked for. server/scene/scene.h says what they mean; SI units. */

const HEAD = 4; /* 00 01 00 00: little-endian */
const ROBOTS = 96;
const ROBOT_BYTES = 80;

export const ROLE = { C: 0, L: 1, F: 2 };

export class Scene {
  /* Of the message's bytes. Throws RangeError when they are no such message. */
  constructor(bytes, number = 0) {
    this.number = number;
    this.view = body(bytes);
    this.time = seconds(this.view);
    this.count = this.view.getUint32(92, true);
    const after = ROBOTS + this.count * ROBOT_BYTES;
    this.vertexCount = this.view.getUint32(after, true);
    this.vertexStart = after + 8;
    const name = this.vertexCount ? this.vertexStart + 16 * this.vertexCount : after + 4;
    this.formation = text(this.view, name).value;
  }

  get bytes() { return this.view.byteLength; }
  get meanError() { return this.view.getFloat64(8, true); }
  get range() { return this.view.getFloat64(16, true); }
  get loss() { return this.view.getFloat64(24, true); }
  get delay() { return this.view.getFloat64(32, true); }
  get reference() { return this.#pose(40); }
  get about() { return this.#pose(64); }
  get leader() { return this.view.getUint16(88, true); }
  get complete() { return this.view.getUint8(90) !== 0; }
  get estopped() { return this.view.getUint8(91) !== 0; }

  /* Of the robot with this index, in the scenario's order. */
  x(i) { return this.view.getFloat64(ROBOTS + ROBOT_BYTES * i, true); }
  y(i) { return this.view.getFloat64(ROBOTS + ROBOT_BYTES * i + 8, true); }
  theta(i) { return this.view.getFloat64(ROBOTS + ROBOT_BYTES * i + 16, true); }
  v(i) { return this.view.getFloat64(ROBOTS + ROBOT_BYTES * i + 24, true); }
  omega(i) { return this.view.getFloat64(ROBOTS + ROBOT_BYTES * i + 32, true); }
  error(i) { return this.view.getFloat64(ROBOTS + ROBOT_BYTES * i + 40, true); }
  poseAge(i) { return this.view.getFloat32(ROBOTS + ROBOT_BYTES * i + 48, true); }
  robotLoss(i) { return this.view.getFloat32(ROBOTS + ROBOT_BYTES * i + 52, true); }
  battery(i) { return this.view.getFloat32(ROBOTS + ROBOT_BYTES * i + 56, true); }
  load(i) { return this.view.getFloat32(ROBOTS + ROBOT_BYTES * i + 60, true); }
  id(i) { return this.view.getUint16(ROBOTS + ROBOT_BYTES * i + 64, true); }
  vertex(i) { return this.view.getUint16(ROBOTS + ROBOT_BYTES * i + 66, true); }
  term(i) { return this.view.getUint16(ROBOTS + ROBOT_BYTES * i + 68, true); }
  group(i) { return this.view.getUint16(ROBOTS + ROBOT_BYTES * i + 70, true); }
  role(i) { return this.view.getUint8(ROBOTS + ROBOT_BYTES * i + 72); }
  state(i) { return this.view.getUint8(ROBOTS + ROBOT_BYTES * i + 73); }
  faults(i) { return this.view.getUint8(ROBOTS + ROBOT_BYTES * i + 74); }
  candidate(i) { return this.view.getUint8(ROBOTS + ROBOT_BYTES * i + 75) !== 0; }
  alive(i) { return this.view.getUint8(ROBOTS + ROBOT_BYTES * i + 76) !== 0; }
  linked(i) { return this.view.getUint8(ROBOTS + ROBOT_BYTES * i + 77) !== 0; }
  muted(i) { return this.view.getUint8(ROBOTS + ROBOT_BYTES * i + 78) !== 0; }
  stalled(i) { return this.view.getUint8(ROBOTS + ROBOT_BYTES * i + 79) !== 0; }

  /* Of vertex k + 1. */
  vertexX(k) { return this.view.getFloat64(this.vertexStart + 16 * k, true); }
  vertexY(k) { return this.view.getFloat64(this.vertexStart + 16 * k + 8, true); }

  /* The index of the robot with this id, -1 when there is none. */
  indexOf(id) {
    for (let i = 0; i < this.count; i++) {
      if (this.id(i) === id) return i;
    }
    return -1;
  }

  /* All of a robot's values by their names. */
  robot(i) {
    return {
      id: this.id(i), x: this.x(i), y: this.y(i), theta: this.theta(i), v: this.v(i), omega: this.omega(i),
      distance_error: this.error(i), pose_age: this.poseAge(i), loss: this.robotLoss(i),
      battery: this.battery(i), load: this.load(i), vertex: this.vertex(i), term: this.term(i),
      group: this.group(i), role: this.role(i), state: this.state(i), faults: this.faults(i),
      candidate: this.candidate(i), alive: this.alive(i), linked: this.linked(i), muted: this.muted(i),
      stalled: this.stalled(i),
    };
  }

  /* All of it. */
  toObject() {
    return {
      time: this.time, mean_distance_error: this.meanError, range: this.range, loss: this.loss, delay: this.delay,
      reference: this.reference, about: this.about, leader: this.leader, complete: this.complete,
      estopped: this.estopped, formation: this.formation,
      robots: Array.from({ length: this.count }, (_, i) => this.robot(i)),
      vertices: Array.from({ length: this.vertexCount }, (_, k) => ({ x: this.vertexX(k), y: this.vertexY(k) })),
    };
  }

  #pose(at) {
    const { view } = this;
    return { x: view.getFloat64(at, true), y: view.getFloat64(at + 8, true), theta: view.getFloat64(at + 16, true) };
  }
}

/* A row of events.csv, of rcl_interfaces/msg/Log. Throws RangeError as above. */
export function readEvent(bytes, number = 0) {
  const view = body(bytes);
  const name = text(view, 12);
  const message = text(view, align(name.end, 4));
  const detail = text(view, align(message.end, 4));
  const event = text(view, align(detail.end, 4));

  return {
    number, time: seconds(view), robot: view.getUint32(align(event.end, 4), true),
    event: event.value, detail: detail.value,
  };
}

function body(bytes) {
  if (bytes.length < HEAD || bytes[0] !== 0 || bytes[1] !== 1) throw new RangeError('not little-endian CDR');
  return new DataView(bytes.buffer, bytes.byteOffset + HEAD, bytes.length - HEAD);
}

/* builtin_interfaces/Time at the beginning, which all messages have. */
function seconds(view) {
  return (view.getInt32(0, true) * 1000 + Math.round(view.getUint32(4, true) / 1e6)) / 1000;
}

const utf8 = new TextDecoder();

function text(view, at) {
  const length = view.getUint32(at, true);
  const end = at + 4 + length;
  if (length === 0 || end > view.byteLength) throw new RangeError('a string that does not end');
  return { value: utf8.decode(new Uint8Array(view.buffer, view.byteOffset + at + 4, length - 1)), end };
}

function align(at, size) {
  return Math.ceil(at / size) * size;
}

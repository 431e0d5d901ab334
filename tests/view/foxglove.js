// Foxglove's own client of its WebSocket protocol, and its own reader of messages, look at a run: what
// every topic says is what trace.csv and events.csv have of the same tick. One by the protocol's younger
// name, one by the older; a third one sends what is no request, which is refused and changes nothing.
'use strict';

const assert = require('node:assert');
const path = require('node:path');
const { test } = require('node:test');
const { FoxgloveClient } = require('@foxglove/ws-protocol');
const { parse } = require('@foxglove/rosmsg');
const { MessageReader } = require('@foxglove/rosmsg2-serialization');
const WebSocket = require('ws');
const { SCENARIOS, file, rows, seen } = require('./browser');

const SCENARIO = path.join(SCENARIOS, 'paper-exp-leader-fault.yaml');
const TOPICS = [
    '/muster/events', '/muster/fleet', '/muster/leader', '/muster/links', '/muster/markers',
    '/muster/mean_distance_error', '/muster/poses', '/tf',
];
const DELETE = 2;
const DELETEALL = 3;

// trace.csv and events.csv have six and two digits behind the point.
const same = (value, written, what) => assert.ok(Math.abs(value - written) <= 5.1e-7, `${what}: ${value}, not ${written}`);
const angle = (a, b, what) => same(Math.sin((a - b) / 2), 0, what);
const ticks = time => Math.round(time * 50);
const ms_of = stamp => stamp.sec * 1000 + stamp.nsec / 1e6;

// ---- the client ----------------------------------------------------------------------------

// Subscribes to all that there is. What it hears is {topic, time in ms, message}, in its order.
class Viewer {
    constructor(address, protocol) {
        this.socket = new WebSocket(address.replace(/^http/, 'ws').replace(/#.*/, ''), [protocol]);
        this.client = new FoxgloveClient({ ws: this.socket });
        this.readers = new Map();
        this.heard = [];
        this.statuses = [];
        this.clock = -1;
        this.waiting = [];
        this.closed = new Promise((resolve, reject) => {
            this.client.on('close', resolve);
            this.client.on('error', reject);
        });
        this.info = new Promise(resolve => this.client.on('serverInfo', resolve));
        this.client.on('status', status => { this.statuses.push(status); this.listen(); });
        this.client.on('advertise', channels => channels.forEach(channel => this.subscribe(channel)));
        this.client.on('time', event => this.follow(Number(event.timestamp) / 1e6));
        this.client.on('message', event => this.take(event));
    }

    subscribe(channel) {
        const reader = new MessageReader(parse(channel.schema, { ros2: true }));

        assert.deepStrictEqual([channel.encoding, channel.schemaEncoding], ['cdr', 'ros2msg']);
        this.readers.set(this.client.subscribe(channel.id), { topic: channel.topic, reader });
    }

    follow(ms) {
        assert.ok(ms >= this.clock, 'time goes back');
        this.clock = ms;
    }

    take(event) {
        const { topic, reader } = this.readers.get(event.subscriptionId);
        const ms = Number(event.timestamp) / 1e6;

        this.heard.push({ topic, ms, clock: this.clock, message: reader.readMessage(event.data) });
        this.listen();
    }

    listen() {
        this.waiting = this.waiting.filter(listener => !listener());
    }

    // When what it has heard is so. Else the test's time is over.
    until(so) {
        return new Promise(resolve => {
            this.waiting.push(() => so() && (resolve(), true));
            this.listen();
        });
    }

    async leave() {
        this.client.close();
        await this.closed;
    }

    of(topic) {
        return this.heard.filter(heard => heard.topic === topic);
    }
}

// ---- the run's files -----------------------------------------------------------------------

const number = row => Object.fromEntries(Object.entries(row).map(([key, value]) =>
    [key, value === '' || isNaN(value) ? value : Number(value)]));

// Tick: rows of robots, in the scenario's order.
function trace(folder) {
    const by_tick = new Map();

    for (const row of rows(folder, 'trace.csv').map(number))
        by_tick.set(ticks(row.t), [...by_tick.get(ticks(row.t)) ?? [], row]);
    return by_tick;
}

const events = folder => rows(folder, 'events.csv');

function check_place(position, orientation, row, what) {
    same(position.x, row.x, what);
    same(position.y, row.y, what);
    angle(2 * Math.atan2(orientation.z, orientation.w), row.theta, what);
}

const CHECKS = {
    '/muster/fleet'(fleet, rows) {
        assert.strictEqual(fleet.robots.length, rows.length);
        rows.forEach((row, i) => {
            const robot = fleet.robots[i];

            for (const name of ['x', 'y', 'v', 'omega', 'distance_error'])
                same(robot[name], row[name], name);
            angle(robot.theta, row.theta, 'theta');
            assert.deepStrictEqual([robot.id, robot.vertex, robot.alive, 'CLF'[robot.role]],
                                   [row.robot, row.vertex, row.alive === 1, row.role]);
        });
    },
    '/tf'({ transforms }, rows) {
        const frames = new Map(transforms.map(one => [one.child_frame_id, one.transform]));

        assert.strictEqual(frames.size, rows.length + 1);
        assert.ok(frames.has('reference') && transforms.every(one => one.header.frame_id === 'map'));
        for (const row of rows) {
            const { translation, rotation } = frames.get(`robot_${row.robot}`);

            check_place(translation, rotation, row, `robot ${row.robot}`);
        }
    },
    '/muster/poses'({ poses }, rows) {
        assert.strictEqual(poses.length, rows.length);
        rows.forEach((row, i) => check_place(poses[i].position, poses[i].orientation, row, `robot ${row.robot}`));
    },
    '/muster/markers'({ markers }, rows) {
        assert.ok(markers[0].action === DELETEALL && markers[0].ns === 'vertices');
        for (const row of rows) {
            const [body] = markers.filter(marker => marker.ns === 'bodies' && marker.id === row.robot);
            const [id] = markers.filter(marker => marker.ns === 'ids' && marker.id === row.robot);

            check_place(body.pose.position, body.pose.orientation, row, `robot ${row.robot}`);
            assert.strictEqual(id.text, String(row.robot));
        }
        assert.strictEqual(markers.filter(marker => marker.ns === 'vertices').length, 1 + rows.length);
    },
    '/muster/links'(links, rows) {
        assert.ok(links.points.length > 0 || links.action === DELETE);
        assert.strictEqual(links.points.length, links.colors.length);
        for (const point of links.points)
            assert.ok(rows.some(row => row.alive && Math.hypot(row.x - point.x, row.y - point.y) < 1e-6));
    },
    '/muster/mean_distance_error'({ data }, rows) {
        const live = rows.filter(row => row.alive);

        same(data, live.reduce((sum, row) => sum + row.distance_error, 0) / live.length, 'mean');
    },
    '/muster/leader'({ data }, rows) {
        const leaders = rows.filter(row => row.alive && row.role === 'L').map(row => row.robot);

        assert.ok(data === 0 ? leaders.length === 0 : leaders.includes(data), `${data}, not ${leaders}`);
    },
};

function check_events(viewer, folder) {
    const heard = viewer.of('/muster/events').map(({ message }) => ({
        t: (ms_of(message.stamp) / 1000).toFixed(2),
        robot: String(message.line),
        event: message.function,
        detail: message.file,
    }));

    assert.deepStrictEqual(heard, events(folder));
}

function check_stamp(heard) {
    const stamp = heard.message.stamp ?? heard.message.header?.stamp ?? heard.message.markers?.[0].header.stamp;

    assert.ok(Number.isInteger(heard.ms / 20), `${heard.ms} is no tick`);
    if (stamp !== undefined)
        assert.strictEqual(Math.max(ms_of(stamp), 0), heard.ms);
    if (heard.topic !== '/muster/events')
        assert.strictEqual(heard.clock, heard.ms);
}

// ---- tests ---------------------------------------------------------------------------------

const NONSENSE = [
    '', '{', '[]', '{"op":"kill","robot":1}', '{"op":"getParameters","parameterNames":[]}',
    '{"op":"subscribe","subscriptions":[{"id":0,"channelId":99}]}', Buffer.from([1, 0, 0, 0, 0]), Buffer.alloc(0),
];

// Returns how many messages there were to compare.
function compare(viewer, folder) {
    const robots = trace(folder);
    let count = 0;

    for (const heard of viewer.heard) {
        check_stamp(heard);
        if (heard.topic in CHECKS && heard.ms > 0) { // 0 may stand for earlier
            CHECKS[heard.topic](heard.message, robots.get(ticks(heard.ms / 1000)));
            count++;
        }
    }
    return count;
}

// All that happened, and the last tick.
async function hear_the_end(viewer, folder) {
    const count = events(folder).length;
    const last = Math.max(...trace(folder).keys());

    await viewer.until(() => viewer.of('/muster/events').length >= count &&
                             viewer.heard.some(heard => ticks(heard.ms / 1000) === last));
    await viewer.leave();
}

test('every topic is as the run\'s files are', { timeout: 100000 }, async () => {
    const folder = file('run');
    const run = await seen('sim', SCENARIO, '--robots=native', '--speed=3', `--out=${folder}`);
    const viewers = ['foxglove.sdk.v1', 'foxglove.websocket.v1', 'foxglove.sdk.v1'].map(
        protocol => new Viewer(run.address, protocol));
    const [younger, older, talker] = viewers;

    for (const viewer of viewers)
        assert.ok((await viewer.info).name.length > 0);
    assert.deepStrictEqual(viewers.map(viewer => viewer.socket.protocol),
                           ['foxglove.sdk.v1', 'foxglove.websocket.v1', 'foxglove.sdk.v1']);
    for (const message of NONSENSE)
        talker.socket.send(message);
    await talker.until(() => talker.statuses.length > 0);
    await run.says(/^muster sim: the run is over/m);
    for (const viewer of viewers)
        await hear_the_end(viewer, folder);
    await run.ends();
    assert.strictEqual(run.code, 0, run.output);

    assert.deepStrictEqual([...younger.statuses, ...older.statuses], []);
    assert.ok(talker.statuses.every(status => status.level === 2 && status.message.length > 10));
    for (const viewer of viewers) {
        assert.deepStrictEqual([...new Set(viewer.heard.map(heard => heard.topic))].sort(), TOPICS);
        check_events(viewer, folder);
        const count = compare(viewer, folder);
        assert.ok(count > 7 * 10, `${count} messages`);
        console.log(`${viewer.socket.protocol}: ${count} messages beside trace.csv`);
    }
    // The scenario's own, and nobody else's.
    assert.strictEqual(events(folder).filter(row => row.event === 'kill').length, 1);
});

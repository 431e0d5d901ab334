'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const { ROBOT, fleet, log } = require('./messages');
const page = require('./page');

const robots = [
    { id: 7, x: -1.5, y: 2.25, theta: 3, v: 0.5, omega: -2, distance_error: 0.125, pose_age: 0.5, loss: 0.25,
      battery: 7.5, load: 0.75, vertex: 300, term: 4, group: 5, role: 1, state: 3, faults: 130, candidate: true },
    { id: 65534, alive: false, linked: false, muted: true, stalled: true },
];

test('every value of a scene is read', async () => {
    const { Scene } = await page('fleet.js');
    const scene = new Scene(fleet(12.34, {
        mean_distance_error: 0.5, range: 3, loss: 0.1, delay: 0.02, reference: { x: 1, y: 2, theta: 3 },
        about: { x: 4, y: 5, theta: 6 }, leader: 7, complete: true, estopped: true, robots,
        vertices: [{ x: 8, y: 9 }, { x: 10, y: 11 }], formation: 'wedge',
    }), 99);

    assert.deepStrictEqual(
        [scene.number, scene.time, scene.meanError, scene.range, scene.loss, scene.delay, scene.leader,
         scene.complete, scene.estopped, scene.formation, scene.count, scene.vertexCount],
        [99, 12.34, 0.5, 3, 0.1, 0.02, 7, true, true, 'wedge', 2, 2]);
    assert.deepStrictEqual([scene.reference, scene.about], [{ x: 1, y: 2, theta: 3 }, { x: 4, y: 5, theta: 6 }]);
    assert.deepStrictEqual([0, 1].map(k => [scene.vertexX(k), scene.vertexY(k)]), [[8, 9], [10, 11]]);
    robots.forEach((robot, i) => assert.deepStrictEqual(scene.robot(i), { ...ROBOT, ...robot }));
    assert.deepStrictEqual([7, 65534, 1].map(id => scene.indexOf(id)), [0, 1, -1]);
});

test('a scene needs neither robots nor vertices, and may lie anywhere in a message', async () => {
    const { Scene } = await page('fleet.js');
    const bytes = fleet(-0.48, { formation: 'alone' });
    const message = new Uint8Array(bytes.length + 24);
    message.set(bytes, 12);
    const scene = new Scene(message.subarray(12, 12 + bytes.length));

    assert.deepStrictEqual([scene.time, scene.count, scene.vertexCount, scene.formation], [-0.48, 0, 0, 'alone']);
});

test('what is cut short is no scene', async () => {
    const { Scene } = await page('fleet.js');
    const bytes = fleet(1, { robots, vertices: [{ x: 1, y: 2 }] });

    for (let count = 0; count < bytes.length; count++)
        assert.throws(() => new Scene(bytes.subarray(0, count)), RangeError, `${count} bytes`);
});

test('an event is read', async () => {
    const { readEvent } = await page('fleet.js');

    assert.deepStrictEqual(readEvent(log(3.5, 4, 'vertex_won', '2'), 8),
                           { number: 8, time: 3.5, robot: 4, event: 'vertex_won', detail: '2' });
    assert.deepStrictEqual(readEvent(log(0, 0, 'estop', '')), { number: 0, time: 0, robot: 0, event: 'estop', detail: '' });
});

test('who hears whom goes by range, group, mutes and rank', async () => {
    const { Scene } = await page('fleet.js');
    const { linksOf } = await page('links.js');
    const scene = new Scene(fleet(0, { range: 1, robots: [
        { id: 1, role: 1 },                              // the leader
        { id: 2, x: 5, candidate: true },                // heard everywhere
        { id: 3, x: 5.5 },                               // hears 2, and is heard by it
        { id: 4, x: 9 },                                 // too far from all
        { id: 5, x: 5, y: 0.5, muted: true },
        { id: 6, x: 5, y: 0.5, alive: false },
        { id: 7, x: 5, y: 0.5, group: 1 },
        { id: 8, x: 5, y: 0.5, linked: false },
    ] }));
    const { both, one } = linksOf(scene);
    const found = [];
    for (let k = 0; k < both.length; k += 2)
        found.push(`${both[k]}>${both[k + 1]}`, `${both[k + 1]}>${both[k]}`);
    for (let k = 0; k < one.length; k += 2)
        found.push(`${one[k]}>${one[k + 1]}`);
    assert.deepStrictEqual(found.sort(), ['0>1', '0>2', '0>3', '1>0', '1>2', '1>3', '2>1']);
});

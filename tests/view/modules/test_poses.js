'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const { fleet } = require('./messages');
const page = require('./page');

async function between(from, to, time) {
    const { Scene } = await page('fleet.js');
    const { Poses } = await page('poses.js');
    const poses = new Poses();

    poses.set(new Scene(fleet(1, { robots: from })), to && new Scene(fleet(2, { robots: to })), time);
    return { x: poses.x[0], y: poses.y[0], theta: poses.theta[0] };
}

const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not ${b}`);

test('between two scenes robots are on the way, and turn the shorter way', async () => {
    const at = await between([{ id: 1, x: 0, y: 4, theta: 3 }], [{ id: 1, x: 1, y: 2, theta: -3 }], 1.25);

    near(at.x, 0.25);
    near(at.y, 3.5);
    near(at.theta, 3 + 0.25 * (2 * Math.PI - 6));
});

test('with no next scene, or another robot in it, they stay', async () => {
    const from = [{ id: 1, x: 1 }];

    assert.strictEqual((await between(from, undefined, 1.5)).x, 1);
    assert.strictEqual((await between(from, [{ id: 2, x: 2 }], 1.5)).x, 1);
    assert.strictEqual((await between(from, [{ id: 1, x: 2 }, { id: 2 }], 1.5)).x, 1);
});

test('a robot that is put elsewhere does not glide there', async () => {
    assert.strictEqual((await between([{ id: 1 }], [{ id: 1, x: 40 }], 1.5)).x, 0);
});

test('a trail is made of the same scenes from picture to picture', async () => {
    const { scenesBefore } = await page('poses.js');
    const { Timeline } = await page('timeline.js');
    const timeline = new Timeline();
    for (let number = 0; number <= 500; number++)
        timeline.addScene({ number, time: number / 50, bytes: 1 });

    const once = scenesBefore(timeline, 9.001, 5, 20).map(({ time }) => time);
    const again = scenesBefore(timeline, 9.101, 5, 20).map(({ time }) => time);
    assert.ok(once.length >= 19 && once.length <= 21);
    assert.ok(once[0] >= 3.7 && once[once.length - 1] < 9.001);
    assert.deepStrictEqual(again, once);
});

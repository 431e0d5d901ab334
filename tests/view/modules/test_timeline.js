'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const page = require('./page');

const scene = (number, bytes = 1000) => ({ number, time: number / 50, bytes });
const numbers = things => things.map(thing => thing.number);

test('scenes and events that come in any order, and twice, are in order once', async () => {
    const { Timeline } = await page('timeline.js');
    const timeline = new Timeline();

    for (const number of [9, 3, 4, 9, 5, 3, 1, 10, 2, 10]) {
        timeline.addScene(scene(number));
        timeline.addEvent({ number, time: number / 50 });
    }
    assert.deepStrictEqual(numbers(timeline.scenes), [1, 2, 3, 4, 5, 9, 10]);
    assert.deepStrictEqual(numbers(timeline.events), [1, 2, 3, 4, 5, 9, 10]);
    assert.deepStrictEqual([timeline.first.number, timeline.newest.number], [1, 10]);
});

test('the scene at a time is the last one that is not after it', async () => {
    const { Timeline } = await page('timeline.js');
    const timeline = new Timeline();

    assert.strictEqual(timeline.indexAt(1), -1);
    for (const number of [50, 100, 150])
        timeline.addScene(scene(number));
    assert.deepStrictEqual([0.99, 1, 1.99, 2, 99].map(time => timeline.indexAt(time)), [-1, 0, 0, 1, 2]);
});

test('a long run stays within its memory, with its beginning and end', async () => {
    const { Timeline } = await page('timeline.js');
    const timeline = new Timeline(100000);

    for (let number = 1; number <= 5000; number++) {
        timeline.addScene(scene(number));
        assert.ok(timeline.bytes <= 100000);
    }
    assert.deepStrictEqual([timeline.first.number, timeline.newest.number], [1, 5000]);
    assert.strictEqual(timeline.bytes, 1000 * timeline.scenes.length);
    assert.ok(timeline.scenes.length > 30);
});

test('scenes of the same mission time are one, the newest', async () => {
    const { Timeline } = await page('timeline.js');
    const timeline = new Timeline();

    for (const number of [1, 2, 3])
        timeline.addScene({ number, time: -1, bytes: 10 });
    assert.deepStrictEqual([numbers(timeline.scenes), timeline.bytes], [[3], 10]);
});

test('when time begins anew, what it did before is gone', async () => {
    const { Timeline } = await page('timeline.js');
    const timeline = new Timeline();

    for (const [number, time] of [[1, 0], [2, 1], [3, 2], [4, 0.5], [5, 1.5]])
        timeline.addScene({ number, time, bytes: 10 });
    timeline.addScene({ number: 2, time: 1, bytes: 10 });
    assert.deepStrictEqual([numbers(timeline.scenes), timeline.bytes], [[1, 4, 5], 30]);
});

// What is read: words, the order of the table, the axis and the curve of the chart.
'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const { fleet } = require('./messages');
const page = require('./page');

const scene_of = async robots => new (await page('fleet.js')).Scene(fleet(0, { robots }));

test('what is wrong with a robot is said, worst first', async () => {
    const { conditionWords, troubled } = await page('words.js');
    const scene = await scene_of([
        { id: 1, state: 3 },
        { id: 2, state: 3, faults: 128 },
        { id: 3, state: 4, faults: 2 },
        { id: 4, state: 5, faults: 16 },
        { id: 5, state: 3, muted: true, stalled: true },
        { id: 6, state: 3, linked: false },
        { id: 7, state: 3, alive: false, faults: 8 },
    ]);
    const said = Array.from({ length: scene.count }, (_, i) => conditionWords(scene, i));

    assert.deepStrictEqual(said, ['run', 'battery low', 'hold, pose stale', 'emergency stop', 'muted, stalled', 'not linked', 'dead']);
    assert.deepStrictEqual(said.map((_, i) => troubled(scene, i)), [false, false, true, true, true, true, true]);
});

test('times and figures are written as people write them', async () => {
    const { clockTime, fixed, metres } = await page('words.js');

    assert.deepStrictEqual([0, 12.345, -0.5, 61.2, 3725].map(time => clockTime(time)),
                           ['0.00 s', '12.35 s', '−0.50 s', '1:01.20', '1:02:05.00']);
    assert.deepStrictEqual([-0.001, -1.5, 2].map(value => fixed(value, 2)), ['0.00', '−1.50', '2.00']);
    assert.deepStrictEqual([0.0123, 12.34, NaN].map(metres), ['0.012', '12.3', '–']);
});

test('the table sorts by any column, what is unknown last', async () => {
    const { orderOf } = await page('table.js');
    const scene = await scene_of([
        { id: 4, role: 2, pose_age: 0.2, vertex: 2 }, { id: 2, role: 1, pose_age: NaN, vertex: 1 },
        { id: 9, role: 2, pose_age: 0.1, vertex: 0 }, { id: 3, role: 0, pose_age: 0.2, vertex: 3 },
    ]);
    const ids = (column, descending) => orderOf(scene, column, descending).map(i => scene.id(i));

    assert.deepStrictEqual(ids('id', false), [2, 3, 4, 9]);
    assert.deepStrictEqual(ids('id', true), [9, 4, 3, 2]);
    assert.deepStrictEqual(ids('role', false), [2, 3, 4, 9]);
    assert.deepStrictEqual(ids('age', false), [9, 3, 4, 2]);
    assert.deepStrictEqual(ids('age', true), [3, 4, 9, 2]);
    assert.deepStrictEqual(ids('vertex', false), [2, 4, 3, 9]);
});

test('the axis of time ends with a short run, and somewhere round with a long one', async () => {
    const { axisEnd } = await page('chart.js');

    assert.strictEqual(axisEnd(3, 60, false), 60);
    assert.strictEqual(axisEnd(70, 60, false), 70);
    assert.strictEqual(axisEnd(100, 86400, false), 120);
    assert.strictEqual(axisEnd(3000, 3100, false), 3100);
    assert.strictEqual(axisEnd(42, 3600, true), 42);
});

test('a column of the chart has the least and the greatest of its scenes', async () => {
    const { columnsOf } = await page('chart.js');
    const scenes = [[0, 5], [0.4, 1], [0.9, 3], [2, NaN], [3.1, 4], [9, 7]].map(([time, meanError]) => ({ time, meanError }));
    const { low, high } = columnsOf(scenes, 0, 4, 4);

    assert.deepStrictEqual([...low], [1, NaN, NaN, 4]);
    assert.deepStrictEqual([...high], [5, NaN, NaN, 4]);
});

'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const { fleet } = require('./messages');
const page = require('./page');

test('times are written as clocks do, also before the mission', async () => {
    const { clockTime } = await page('words.js');

    assert.deepStrictEqual([0, 9.5, -0.28, 59.99, 60, 75.5, 3600, 3725].map(time => clockTime(time)),
                           ['0.00 s', '9.50 s', '−0.28 s', '59.99 s', '1:00.00', '1:15.50', '1:00:00.00', '1:02:05.00']);
    assert.deepStrictEqual([59.98, 119.98].map(time => clockTime(time, 1)), ['1:00.0', '2:00.0']);
});

test('figures have a true minus, and no minus before zero', async () => {
    const { fixed, metres } = await page('words.js');

    assert.deepStrictEqual([-0.001, -1.5, 2].map(value => fixed(value, 2)), ['0.00', '−1.50', '2.00']);
    assert.deepStrictEqual([0.0123, 12.34, NaN].map(metres), ['0.012', '12.3', '–']);
});

test('what is wrong with a robot is said in words', async () => {
    const { Scene } = await page('fleet.js');
    const { conditionWords, troubled } = await page('words.js');
    const cases = [
        [{}, 'run', false],
        [{ faults: 128 }, /battery low/, false],
        [{ faults: 4 }, /link lost/, true],
        [{ stalled: true }, /stalled/, true],
        [{ muted: true }, /muted/, true],
        [{ linked: false }, /not linked|link lost/, true],
        [{ state: 5, faults: 16 }, /emergency stop/, true],
        [{ alive: false, faults: 4 }, 'dead', true],
    ];

    for (const [robot, words, trouble] of cases) {
        const scene = new Scene(fleet(0, { robots: [robot] }));
        if (typeof words === 'string')
            assert.strictEqual(conditionWords(scene, 0), words);
        else
            assert.match(conditionWords(scene, 0), words);
        assert.strictEqual(troubled(scene, 0), trouble, JSON.stringify(robot));
    }
});

test('rows are sorted by any column, with robots that have no value last', async () => {
    const { Scene } = await page('fleet.js');
    const { orderOf } = await page('table.js');
    const scene = new Scene(fleet(0, { robots: [
        { id: 3, battery: 7 }, { id: 1, battery: 0 }, { id: 2, battery: 6 }, { id: 4, battery: 7, role: 1 },
    ] }));
    const ids = (column, descending) => orderOf(scene, column, descending).map(i => scene.id(i));

    assert.deepStrictEqual(ids('id', false), [1, 2, 3, 4]);
    assert.deepStrictEqual(ids('id', true), [4, 3, 2, 1]);
    assert.deepStrictEqual(ids('battery', false), [2, 3, 4, 1]);
    assert.deepStrictEqual(ids('battery', true), [3, 4, 2, 1]);
    assert.deepStrictEqual(ids('role', false), [4, 1, 2, 3]);
});

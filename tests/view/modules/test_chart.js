'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const page = require('./page');

test('the axis goes somewhat farther than what is known, and never beyond the run', async () => {
    const { axisEnd } = await page('chart.js');

    assert.strictEqual(axisEnd(3, 300, false), 30);
    assert.strictEqual(axisEnd(3, 10, false), 10);
    assert.strictEqual(axisEnd(29.5, 300, false), 60);
    assert.strictEqual(axisEnd(29.5, 30, true), 29.5);
    assert.ok(axisEnd(200000, 0, false) > 200000);
});

test('no peak gets lost in columns', async () => {
    const { columnsOf } = await page('chart.js');
    const scenes = Array.from({ length: 1000 }, (_, k) => ({ time: k / 100, meanError: k === 555 ? 9 : 1 }));
    const { low, high } = columnsOf(scenes, 0, 20, 40);

    assert.deepStrictEqual([...high.slice(0, 20)], Array.from({ length: 20 }, (_, k) => (k === 11 ? 9 : 1)));
    assert.deepStrictEqual([...low.slice(0, 20)], Array(20).fill(1));
    assert.ok(high.slice(20).every(Number.isNaN));
});

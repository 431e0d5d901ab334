'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const { fleet } = require('./messages');
const page = require('./page');

test('a vertex is sent as the paper has it: distance and direction from the heading', async () => {
    const { toPolar } = await page('formation.js');

    assert.deepStrictEqual(toPolar({ x: 0, y: 0 }), { L: 0, psi: 0 });
    assert.deepStrictEqual(toPolar({ x: -1, y: 0 }), { L: 1, psi: 3.141593 });
    assert.deepStrictEqual(toPolar({ x: 0, y: -2 }), { L: 2, psi: -1.570796 });
});

test('what begins with the formation in force has its vertices, the leader first', async () => {
    const { placesOf } = await page('formation.js');
    const { Scene } = await page('fleet.js');
    const scene = new Scene(fleet(0, {
        about: { x: 5, y: 3, theta: Math.PI / 2 }, vertices: [{ x: 4, y: 2 }, { x: 5, y: 3 }, { x: 6, y: 2 }],
    }));

    assert.deepStrictEqual(placesOf(scene), [{ x: 0, y: 0 }, { x: -1, y: 1 }, { x: -1, y: -1 }]);
});

test('what cannot be sent is told why', async () => {
    const { flawOf } = await page('formation.js');
    const three = [{ x: 0, y: 0 }, { x: 1, y: 0 }, { x: 0, y: 1 }];

    assert.strictEqual(flawOf('wedge-2', three, 3), null);
    assert.match(flawOf('', three, 3), /name/);
    assert.match(flawOf('a b', three, 3), /name/);
    assert.match(flawOf('x'.repeat(64), three, 3), /name/);
    assert.match(flawOf('wedge', three, 2), /3 vertices for 2 robots/);
    assert.match(flawOf('wedge', [...three, { x: 1, y: 0.005 }], 4), /Vertices 2 and 4/);
    assert.match(flawOf('wedge', [{ x: 0, y: 0 }, { x: NaN, y: 0 }], 4), /Vertex 2/);
});

test('a new formation has a name that is free', async () => {
    const { freeName } = await page('formation.js');

    assert.strictEqual(freeName(['G1', 'drawn-1', 'drawn-3']), 'drawn-2');
});

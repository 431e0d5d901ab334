'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const { fleet } = require('./messages');
const page = require('./page');

const near = (a, b) => assert.ok(Math.abs(a - b) < 2e-6, `${a} is not ${b}`);

test('a vertex is sent as its distance and its direction from the heading', async () => {
    const { toPolar } = await page('formation.js');

    for (const [x, y, L, psi] of [[0, 0, 0, 0], [2, 0, 2, 0], [0, 0.5, 0.5, Math.PI / 2], [0, -0.5, 0.5, -Math.PI / 2],
                                  [-1, 0, 1, Math.PI], [-1, 1, Math.SQRT2, 3 * Math.PI / 4]]) {
        const polar = toPolar({ x, y });
        near(polar.L, L);
        near(polar.psi, psi);
    }
    assert.strictEqual(toPolar({ x: 0, y: 0 }).L, 0);
});

test('vertices snap to the grid there is', async () => {
    const { snap } = await page('formation.js');

    assert.deepStrictEqual(snap({ x: 0.26, y: -0.33 }, 0.1), { x: 0.3, y: -0.3 });
    assert.deepStrictEqual(snap({ x: 0.26, y: -0.33 }, 0.25), { x: 0.25, y: -0.25 });
    assert.deepStrictEqual(snap({ x: 0.26, y: -0.33 }, 0), { x: 0.26, y: -0.33 });
});

test('the formation in force is drawn as its leader sees it, the leader first', async () => {
    const { Scene } = await page('fleet.js');
    const { placesOf } = await page('formation.js');
    const about = { x: 5, y: -3, theta: Math.PI / 2 };
    const scene = new Scene(fleet(0, { about, vertices: [{ x: 4, y: -3 }, { x: 5, y: -3 }, { x: 5, y: -1 }] }));

    assert.deepStrictEqual(placesOf(scene), [{ x: 0, y: 0 }, { x: 0, y: 1 }, { x: 2, y: 0 }]);
});

test('what cannot be sent is said', async () => {
    const { flawOf } = await page('formation.js');
    const two = [{ x: 0, y: 0 }, { x: 1, y: 0 }];

    assert.strictEqual(flawOf('A.b_c-9', two, 2), null);
    for (const name of ['', 'a b', 'ä', 'x'.repeat(64)])
        assert.match(flawOf(name, two, 2), /name/);
    assert.match(flawOf('a', two, 1), /2 vertices for 1 robots/);
    assert.match(flawOf('a', [...two, { x: 1.005, y: 0 }], 9), /Vertices 2 and 3 are in one place/);
    assert.match(flawOf('a', [...two, { x: NaN, y: 0 }], 9), /Vertex 3 needs/);
});

test('a new formation gets a name that is free', async () => {
    const { freeName } = await page('formation.js');

    assert.strictEqual(freeName(['drawn-1', 'diamond', 'drawn-3']), 'drawn-2');
});

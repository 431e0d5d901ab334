'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const { fleet } = require('./messages');
const page = require('./page');

const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not ${b}`);

async function camera() {
    const { Camera } = await page('camera.js');
    return Object.assign(new Camera(), { x: 3, y: -2, scale: 50, width: 800, height: 600 });
}

test('the arena has y upwards, and the way there leads back', async () => {
    const it = await camera();

    assert.ok(it.toScreenY(1) < it.toScreenY(0));
    near(it.toArenaX(it.toScreenX(7.5)), 7.5);
    near(it.toArenaY(it.toScreenY(-4.25)), -4.25);
});

test('zooming leaves what is under the pointer there, panning takes it along', async () => {
    const it = await camera();
    const [x, y] = [it.toArenaX(100), it.toArenaY(50)];

    it.zoom(3, 100, 50);
    near(it.toScreenX(x), 100);
    near(it.toScreenY(y), 50);
    it.pan(40, -30);
    near(it.toScreenX(x), 140);
    near(it.toScreenY(y), 20);
});

test('what fits is seen whole, but for the dead that were left behind', async () => {
    const { boxOf } = await page('camera.js');
    const { Scene } = await page('fleet.js');
    const scene = new Scene(fleet(0, { robots: [
        { id: 1, x: -2, y: 1 }, { id: 2, x: 4, y: 6 }, { id: 3, x: 0, y: 0.5, alive: false },
        { id: 4, x: 90, y: 90, alive: false },
    ] }));
    const it = await camera();

    Object.assign(it, it.fitting(boxOf(scene)));
    for (let i = 0; i < 3; i++) {
        const [px, py] = [it.toScreenX(scene.x(i)), it.toScreenY(scene.y(i))];
        assert.ok(px > 0 && px < 800 && py > 0 && py < 600, `robot ${i + 1} is at ${px}, ${py}`);
    }
    assert.ok(it.toScreenX(90) > 800);
});

test('grid lines are at round numbers, far enough apart', async () => {
    const { niceStep } = await page('camera.js');

    for (let scale = 0.2; scale < 4000; scale *= 1.37) {
        const step = niceStep(scale, 70);
        assert.ok(step * scale >= 69 && step * scale <= 176, `${step} m at ${scale} px/m`);
        assert.match(step.toExponential(9), /^[125]\.0*e/);
    }
});

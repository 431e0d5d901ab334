// A recording in the page: it plays, it is looked through, what it shows is what trace.csv has, and
// nobody can act.
'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const { test } = require('node:test');
const { SCENARIOS, file, look, muster, rows, seen, shot, until } = require('./browser');

// As trace.csv has them, of six decimals and the like.
const same = (a, b, what) =>
    assert.ok(Math.abs(a - b) <= 1e-6 * Math.max(1, Math.abs(b)), `${what}: ${a}, not ${b}`);

test('a recording is played and looked through', async () => {
    const run = file('run');
    const recorded = muster(
        'sim',
        path.join(SCENARIOS, 'paper-sim-leader-fault.yaml'),
        '--robots=native',
        '--quiet',
        `--out=${run}`
    );
    assert.strictEqual(await recorded.ends(), 0);
    const program = await seen('replay', run);
    const page = await look(program.address);
    const trace = rows(run, 'trace.csv');

    // It plays by itself.
    await until(page, () => window.muster.scene.time > 0.5);
    assert.deepStrictEqual(await page.evaluate(() => window.muster.hello.acts), []);
    await page.locator('#table tr[data-robot="1"]').click();
    await page.getByRole('heading', { name: 'Robot 1,' }).waitFor();
    for (const name of ['STOP', 'Kill', 'Put there', 'diamond'])
        assert.strictEqual(await page.getByRole('button', { name }).count(), 0, name);

    const chart = page.getByRole('slider');
    const box = await chart.boundingBox();
    for (const part of [0.9, 0.1, 0.5, 0.33, 0.7]) {
        const before = await page.evaluate(() => window.muster.time);
        await page.mouse.click(box.x + part * box.width, box.y + box.height / 2);
        await until(
            page,
            before =>
                window.muster.time !== before && window.muster.scene.time <= window.muster.time,
            before
        );
        const scene = await page.evaluate(() => window.muster.scene);
        const now = trace.filter(row => Math.abs(Number(row.t) - scene.time) < 0.001);
        assert.strictEqual(now.length, 4);
        for (const row of now) {
            const robot = scene.robots.find(robot => robot.id === Number(row.robot));
            for (const name of ['x', 'y', 'theta', 'v', 'omega', 'distance_error'])
                same(robot[name], Number(row[name]), `${name} of ${row.robot} at ${row.t}`);
            assert.deepStrictEqual(
                [robot.vertex, robot.alive],
                [Number(row.vertex), row.alive === '1'],
                `robot ${row.robot} at ${row.t}`
            );
        }
    }
    await shot(page, 'replay');
    assert.deepStrictEqual(page.complaints, []);
});

// A hundred robots in the page: how many pictures a second it draws. What is measured is kept, not
// judged: it is this machine's.
'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const { test } = require('node:test');
const { KEPT, SCENARIOS, file, look, press, seen, shot, until } = require('./browser');

// Pictures a second that the page has drawn by then, mission time and the clock on the wall.
const measure = page =>
    page.evaluate(() => ({
        fps: window.muster.fps,
        time: window.muster.newest,
        wall: performance.now() / 1000,
    }));

test('a hundred robots are drawn', async () => {
    const program = await seen(
        'sim',
        path.join(SCENARIOS, 'paper-sim-100-v-mirrored.yaml'),
        '--robots=native',
        '--no-trace',
        `--out=${file('run')}`
    );
    const page = await look(program.address);
    const measured = [];

    for (const what of ['robots and trails', 'links and ranges as well']) {
        const begin = await measure(page);
        await until(page, then => performance.now() / 1000 > then, begin.wall + 3);
        const end = await measure(page);
        const pace = (end.time - begin.time) / (end.wall - begin.wall);
        measured.push(
            `${what}: ${end.fps.toFixed(0)} pictures a second, at ${pace.toFixed(2)} times real time`
        );
        assert.ok(end.fps > 1);
        await shot(page, what === 'robots and trails' ? 'hundred' : 'hundred-links');
        await press(page, 'Links');
        await press(page, 'Range');
    }
    const { robots } = await page.evaluate(() => window.muster.scene);
    assert.strictEqual(robots.length, 100);
    assert.deepStrictEqual(page.complaints, []);
    console.log(measured.join('\n'));
    fs.writeFileSync(path.join(KEPT, 'hundred.txt'), `${measured.join('\n')}\n`);
});

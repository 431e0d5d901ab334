// Somebody looks at four simulated chips, and does with mouse and page all that can be done.
'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const { test } = require('node:test');
const { file, look, press, rows, seen, shot, until } = require('./browser');

const scene = page => page.evaluate(() => window.muster.scene);
const robot = async (page, id) => (await scene(page)).robots.find(robot => robot.id === id);

// Where in the window a robot is.
const place_of = (page, id) => page.evaluate(id => {
    const { x, y } = window.muster.scene.robots.find(robot => robot.id === id);
    return window.muster.place(x, y);
}, id);

async function click_robot(page, id) {
    const { x, y } = await place_of(page, id);

    await page.mouse.click(x, y);
    await page.getByRole('heading', { name: `Robot ${id},` }).waitFor();
}

async function drag(page, from, to) {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2);
    await page.mouse.move(to.x, to.y);
    await page.mouse.up();
}

// In the page: mission time from the first scene in which the robot is dead to the one that is on the
// screen when the table has another leader.
function succession(dead) {
    return new Promise(resolve => {
        let died = null;
        const look = () => {
            const { scene } = window.muster;
            const row = [...document.querySelectorAll('#table tbody tr')].find(row => / ?leader/.test(row.innerText));

            if (died === null && !scene.robots.find(robot => robot.id === dead).alive)
                died = scene.time;
            if (died !== null && row && Number(row.dataset.robot) !== dead)
                resolve({ leader: Number(row.dataset.robot), took: scene.time - died });
            else
                requestAnimationFrame(look);
        };
        look();
    });
}

const alive = (page, id, so) => until(page, ([id, so]) =>
    window.muster.scene.robots.find(robot => robot.id === id).alive === so, [id, so]);

const formed = (page, formation) => until(page, formation =>
    window.muster.scene.formation === formation && window.muster.scene.complete, formation);

// In the page: mission time, once all robots stand. Motors run down.
const standing = () => window.muster.scene.robots.every(
    robot => Math.abs(robot.v) < 0.001 && Math.abs(robot.omega) < 0.01) && window.muster.scene.time;

test('four robots are seen, killed, moved, led and stopped', async t => {
    const run = file('run');
    const program = await seen('sim', path.join(__dirname, 'four.yaml'), `--out=${run}`);
    const page = await look(program.address);
    let failed = false;
    const step = (name, work) => t.test(name, { skip: failed }, async () => {
        failed = true;
        await work();
        failed = false;
    });

    await step('four robots are there', async () => {
        assert.strictEqual((await scene(page)).robots.length, 4);
        for (const id of [1, 2, 3, 4])
            await page.locator(`#table tr[data-robot="${id}"]`).waitFor();
        await formed(page, 'diamond');
        await shot(page, 'four');
    });

    await step('a click kills the leader, and another one leads', async () => {
        assert.strictEqual((await scene(page)).leader, 1);
        await click_robot(page, 1);
        await shot(page, 'picked');
        const succeeded = page.evaluate(succession, 1);
        await press(page, 'Kill');
        const { leader, took } = await succeeded;
        console.log(`robot ${leader} leads in the table ${took.toFixed(2)} s after the leader's death`);
        assert.strictEqual(leader, 2);
        assert.ok(took <= 1);
        await shot(page, 'killed');
    });

    await step('it pauses, and goes on by a tick', async () => {
        await press(page, 'Pause the simulation');
        await until(page, () => window.muster.status.paused && window.muster.time === window.muster.newest);
        const { time } = await scene(page);
        await press(page, 'One tick');
        await until(page, time => window.muster.scene.time > time, time);
        assert.strictEqual((await scene(page)).time.toFixed(2), (time + 0.02).toFixed(2));
        await press(page, 'Go on');
        await until(page, time => window.muster.scene.time > time + 0.5, time);
    });

    await step('it goes faster', async () => {
        const { time } = await scene(page);
        const began = Date.now();
        await page.getByLabel('Speed').selectOption('10');
        await until(page, time => window.muster.scene.time > time + 5, time);
        console.log(`5 s at 10 times real time took ${((Date.now() - began) / 1000).toFixed(2)} s`);
        assert.ok(Date.now() - began < 5000);
        await page.getByLabel('Speed').selectOption('1');
        await until(page, () => window.muster.status.speed === 1);
    });

    await step('the past is seen, and left again', async () => {
        const chart = page.getByRole('slider', { name: 'Time' });
        const box = await chart.boundingBox();
        const { time } = await scene(page);
        await page.mouse.click(box.x + 5, box.y + box.height / 2);
        await until(page, () => window.muster.scene.leader === 1 && window.muster.scene.time < 1);
        await shot(page, 'past');
        await press(page, 'Go live');
        await until(page, time => window.muster.scene.time > time && window.muster.scene.leader === 2, time);
    });

    await step('the dead robot comes back', async () => {
        await press(page, 'Revive');
        await alive(page, 1, true);
    });

    await step('a robot is dragged elsewhere', async () => {
        const from = await place_of(page, 4);
        const to = { x: from.x + 60, y: from.y - 20 };
        await drag(page, from, to);
        const there = await until(page, to => {
            const { x, y } = window.muster.scene.robots.find(robot => robot.id === 4);
            const at = window.muster.place(x, y);
            return Math.hypot(at.x - to.x, at.y - to.y) < 30 && at;
        }, to);
        assert.ok(there);
    });

    await step('another formation is taken', async () => {
        await press(page, 'line');
        await formed(page, 'line');
        await shot(page, 'line');
    });

    await step('a formation is drawn and taken', async () => {
        await press(page, /^Draw a new one/);
        const board = await page.locator('#drawing canvas').boundingBox();
        const middle = { x: board.x + board.width / 2, y: board.y + board.height / 2 };
        for (const [dx, dy] of [[-120, 60], [120, 60], [0, 140]])
            await page.mouse.click(middle.x + dx, middle.y + dy);
        await page.getByLabel('Name').fill('arrow');
        await shot(page, 'drawing');
        await page.locator('#draw-send').click();
        await formed(page, 'arrow');
        assert.strictEqual((await scene(page)).vertices.length, 4);
        await shot(page, 'drawn');
    });

    await step('the red button stops all of them', async () => {
        await press(page, 'STOP');
        const stopped = await until(page, () => window.muster.scene.estopped && window.muster.scene.time);
        const stood = await until(page, standing);
        console.log(`all stand ${(stood - stopped).toFixed(2)} s after the stop`);
        assert.ok(stood - stopped < 1);
        await shot(page, 'stopped');
    });

    await step('it is legible in the dark and on a phone', async () => {
        for (const [name, options] of [
            ['dark', { colorScheme: 'dark' }],
            ['phone', { viewport: { width: 360, height: 740 }, isMobile: true, hasTouch: true }],
        ]) {
            const other = await look(program.address, options);
            await until(other, () => window.muster.scene.estopped);
            assert.ok(await other.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${name} is too wide`);
            await shot(other, name);
            assert.deepStrictEqual(other.complaints, []);
            await other.close();
        }
    });

    await step('nothing was complained of', () => assert.deepStrictEqual(page.complaints, []));

    await step('the program ends by itself, and its files are whole', async () => {
        await press(page, 'End the run');
        await until(page, () => window.muster.status.over);
        await page.reload();
        await until(page, () => window.muster?.scene && window.muster.status.over);
        await page.close();
        await program.ends();
        const done = rows(run, 'events.csv').map(row => row.event);
        for (const act of ['kill', 'revive', 'move', 'formation', 'draw', 'estop'])
            assert.ok(done.includes(act), `${act} is missing`);
        JSON.parse(fs.readFileSync(path.join(run, 'summary.json'), 'utf8'));
    });
});

// A run of `muster serve` in the page: virtual robots behind links, and their arena.
'use strict';

const assert = require('node:assert');
const path = require('node:path');
const { test } = require('node:test');
const { SCENARIOS, file, look, muster, press, rows, seen, shot, until } = require('./browser');

const SCENARIO = path.join(__dirname, 'four.yaml');
const SITE = path.join(SCENARIOS, '../docs/examples/loopback.yaml');
const IDS = [1, 2, 3, 4];

// As README has it, on ports that are free. What `muster serve` has to be told of them.
async function arena() {
    const ground = muster('arena', '--unicast', '--port=0', '--data-port=0', '--robots-port=0', SCENARIO);
    const [, mocap, setpoints] = await ground.says(/natnet 127\.0\.0\.1:(\d+).*robots 127\.0\.0\.1:(\d+)/);
    const team = muster('robot', '--robots=native', '--id=1..4', `--link=pty:${file('robot-%d')}`,
                        `--arena=127.0.0.1:${setpoints}`);

    await Promise.all(IDS.map(id => team.says(new RegExp(`^robot ${id}: `, 'm'))));
    return [`--set=mocap.port=${mocap}`, ...IDS.map((id, i) => `--set=robots.${i}.link=tty:${file(`robot-${id}`)}`)];
}

const at = (page, time) => until(page, time => window.muster.scene.time >= time && window.muster.scene, time);

test('robots that are led by muster serve are seen, and stopped', async () => {
    const run = file('run');
    const program = await seen('serve', SITE, `--scenario=${SCENARIO}`, '--quiet', `--out=${run}`, ...await arena());
    const page = await look(program.address);

    // All of them take part.
    await until(page, () => window.muster.scene.leader !== 0 && window.muster.scene.robots.length === 4 &&
        window.muster.scene.robots.every(robot => robot.linked && robot.alive && robot.v !== 0));
    await shot(page, 'serve');
    await press(page, 'STOP');
    const stopped = await until(page, () => window.muster.scene.estopped && window.muster.scene.time);
    // Speeds are measured here, and never quite 0: places stay.
    const first = await at(page, stopped + 0.5);
    const second = await at(page, stopped + 1);
    first.robots.forEach((robot, i) => {
        const moved = Math.hypot(robot.x - second.robots[i].x, robot.y - second.robots[i].y);
        assert.ok(moved < 0.01, `robot ${robot.id} drove ${moved} m`);
    });
    await shot(page, 'serve-stopped');
    assert.deepStrictEqual(page.complaints, []);
    await press(page, 'End the run');
    await until(page, () => window.muster.status.over);
    await page.close();
    await program.ends();
    assert.ok(rows(run, 'events.csv').some(row => row.event === 'estop'));
});

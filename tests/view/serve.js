// A run of `muster serve` in the page: virtual robots behind links, and their arena.
'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const { test } = require('node:test');
const { SCENARIOS, events, file, look, muster, robots, seen, shot, until } = require('./browser');

const SCENARIO = path.join(SCENARIOS, 'paper-exp-leader-fault.yaml');
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

// What a page of another server's can do with the right token, and a page of this one's without
// any: look at most. The same requests from a page that may do kill a robot.
'use strict';

const assert = require('node:assert');
const http = require('node:http');
const { once } = require('node:events');
const path = require('node:path');
const { after, test } = require('node:test');
const { file, look, open, rows, seen, until } = require('./browser');

// In the browser: asks for a robot's end in every way that a script has, and tells how each of them
// came out. A socket that says nothing to it has been sent scenes enough by then.
async function attack({ host, token }) {
    const request = JSON.stringify({ number: 1, token, act: 'kill', robot: 1 });
    const socket = protocols =>
        new Promise(resolve => {
            const socket = new WebSocket(`ws://${host}/`, protocols);
            let scenes = 0;

            socket.onopen = () => socket.send(request);
            socket.onclose = () => resolve('closed');
            socket.onmessage = ({ data }) => {
                if (typeof data === 'string' && 'answer' in JSON.parse(data))
                    resolve(JSON.parse(data).answer.refused ?? 'done');
                else if (++scenes === 100) resolve('ignored');
            };
        });
    const post = (method, mode) =>
        fetch(`http://${host}/`, { method, mode, body: request }).then(
            answer => `${answer.type} ${answer.status}`,
            error => String(error)
        );

    return Promise.all([
        socket(['muster.view.v1']),
        socket([]),
        post('POST', 'cors'),
        post('POST', 'no-cors'),
        post('PUT', 'cors'),
    ]);
}

// The robot half a second of mission time later.
async function robot_later(page) {
    const then = await page.evaluate(() => window.muster.scene.time + 0.5);

    await until(page, then => window.muster.scene.time > then, then);
    return page.evaluate(() => window.muster.scene.robots.find(robot => robot.id === 1));
}

const elsewhere = http.createServer((request, response) => {
    response.setHeader('Content-Type', 'text/html');
    response.end('<!doctype html><link rel="icon" href="data:,"><title>Elsewhere</title>');
});
after(() => elsewhere.close());

test('only who has the token and the page of this server may act', async () => {
    const run = file('run');
    const program = await seen(
        'sim',
        path.join(__dirname, 'four.yaml'),
        '--robots=native',
        `--out=${run}`
    );
    const { host, hash, origin } = new URL(program.address);
    const token = hash.slice(1);
    const page = await look(program.address);

    elsewhere.listen(0, '127.0.0.1');
    await once(elsewhere, 'listening');
    const stranger = await open();
    await stranger.goto(`http://127.0.0.1:${elsewhere.address().port}/`);
    const outcomes = await stranger.evaluate(attack, { host, token });
    console.log('a page from elsewhere:', outcomes);
    assert.ok(!outcomes.includes('done'));
    assert.ok((await robot_later(page)).alive);

    const looker = await look(`${origin}/`);
    assert.match(await looker.locator('body').innerText(), /look/i);
    const [answer] = await looker.evaluate(attack, { host, token: '' });
    assert.match(answer, /token/);
    const [guessed] = await looker.evaluate(attack, {
        host,
        token: token.replace(/.$/, last => (last === '0' ? '1' : '0')),
    });
    assert.match(guessed, /token/);
    assert.ok((await robot_later(page)).alive);

    assert.strictEqual((await page.evaluate(attack, { host, token }))[0], 'done');
    assert.ok(!(await robot_later(page)).alive);
    program.kill('SIGINT');
    await program.ends();
    assert.strictEqual(rows(run, 'events.csv').filter(row => row.event === 'kill').length, 1);
});

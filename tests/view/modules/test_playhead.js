'use strict';

const assert = require('node:assert');
const { test } = require('node:test');
const page = require('./page');

const FRAME = 1 / 60;

// Scenes every 20 ms of the mission at a pace, pictures 60 times a second of the wall.
function watch(playhead, pace, seconds, from = 0) {
    const shown = [];
    let heard = from;

    for (let now = FRAME; now <= seconds; now += FRAME) {
        while (heard + 0.02 <= from + pace * now)
            playhead.hear(heard += 0.02, now);
        playhead.advance(FRAME, now, from, heard);
        shown.push({ time: playhead.time, newest: heard });
    }
    return shown;
}

test('live, it follows closely and never turns back', async () => {
    const { Playhead } = await page('playhead.js');

    for (const pace of [0.1, 1, 10, 100]) {
        const shown = watch(new Playhead(), pace, 3);
        shown.forEach(({ time, newest }, i) => {
            assert.ok(time <= newest);
            assert.ok(i === 0 || time >= shown[i - 1].time, `${time} after ${shown[i - 1]?.time} at ${pace}`);
        });
        const { time, newest } = shown[shown.length - 1];
        assert.ok(newest - time < 0.2 * Math.max(1, pace), `${newest - time} behind at ${pace}`);
    }
});

test('held, it stays; playing, it runs on and is live again at the end', async () => {
    const { Playhead } = await page('playhead.js');
    const playhead = new Playhead();

    watch(playhead, 1, 2);
    playhead.hold(0.5);
    playhead.advance(1, 3, 0, 2);
    assert.deepStrictEqual([playhead.mode, playhead.time], ['held', 0.5]);
    playhead.play();
    playhead.speed = 2;
    playhead.advance(0.25, 3.25, 0, 2);
    assert.deepStrictEqual([playhead.mode, playhead.time], ['playing', 1]);
    playhead.advance(1, 4.25, 0, 2);
    assert.deepStrictEqual([playhead.mode, playhead.time], ['live', 2]);
});

test('no time is shown that there is no scene of', async () => {
    const { Playhead } = await page('playhead.js');
    const playhead = new Playhead();

    playhead.hold(-5);
    playhead.advance(FRAME, 1, 3, 9);
    assert.strictEqual(playhead.time, 3);
    playhead.hold(50);
    playhead.advance(FRAME, 1, 3, 9);
    assert.strictEqual(playhead.time, 9);
});

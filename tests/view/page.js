// Somebody looks at four simulated chips through the page, and does with the mouse all that it has.
'use strict';

const assert = require('node:assert');
const path = require('node:path');
const { test } = require('node:test');
const { events, file, look, seen, shot } = require('./browser');

const button = (page, name) => page.getByRole('button', { name, exact: true });
const scene = page => page.evaluate(() => window.muster.scene);
const robot = async (page, id) => (await scene(page)).robots.find(robot => robot.id === id);

// Where in the window a place of the arena is.
const place = (page, x, y) => page.evaluate(([x, y]) => window.muster.place(x, y), [x, y]);

async function click_robot(page, id) {
    const { x, y } = await robot(page, id);
    const at = await place(page, x, y);

    await page.mouse.click(at.x, at.y);
}

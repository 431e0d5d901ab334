// The page for everyone: axe's rules of WCAG A and AA, and the keyboard alone.
'use strict';

const assert = require('node:assert');
const path = require('node:path');
const { test } = require('node:test');
const axe = require('axe-core');
const { file, look, seen, until } = require('./browser');

const RULES = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa'];
const PHONE = { viewport: { width: 360, height: 740 }, isMobile: true, hasTouch: true };

// What axe finds wrong, in its words.
async function judge(page) {
    await page.evaluate(axe.source);
    const { violations } = await page.evaluate(values => axe.run({ runOnly: { type: 'tag', values } }), RULES);
    return violations.flatMap(({ id, nodes }) => nodes.map(node => `${id}: ${node.html}: ${node.failureSummary}`));
}

// What has the focus, in words.
const focused = page => page.evaluate(() => {
    const it = document.activeElement;
    return it.id || it.ariaLabel || it.innerText.trim() || it.tagName;
});

test('everyone can read and use it', async t => {
    const run = file('run');
    const program = await seen('sim', path.join(__dirname, 'four.yaml'), '--robots=native', `--out=${run}`);

    for (const [name, options] of [
        ['light', {}], ['dark', { colorScheme: 'dark' }], ['phone', PHONE], ['dark phone', { ...PHONE, colorScheme: 'dark' }],
    ])
        await t.test(`axe finds nothing wrong: ${name}`, async () => {
            const page = await look(program.address, options);
            await until(page, () => window.muster.scene.robots.every(robot => robot.vertex !== 0));
            await page.locator('#table tr[data-robot="2"]').click();
            assert.strictEqual((await judge(page)).join('\n'), '');
            await page.context().close();
        });

    await t.test('everything that can be clicked can be reached by Tab', async () => {
        const page = await look(program.address);
        const wanted = await page.evaluate(() => {
            const all = [...document.querySelectorAll('button, a[href], input, select, [tabindex="0"]')];
            return all.filter(it => it.checkVisibility() && it.tabIndex >= 0 && !it.disabled).length;
        });
        const reached = new Set();
        for (let i = 0; i < wanted; i++) {
            await page.keyboard.press('Tab');
            reached.add(await focused(page));
        }
        console.log('by Tab:', [...reached].join(' | '));
        assert.strictEqual(reached.size, wanted);
        await page.context().close();
    });

    await t.test('a robot is picked and killed by keys', async () => {
        const page = await look(program.address);
        await page.keyboard.press('3');
        const kill = page.getByRole('button', { name: 'Kill' });
        await kill.waitFor();
        while (await focused(page) !== 'Kill')
            await page.keyboard.press('Tab');
        await page.keyboard.press('Enter');
        await until(page, () => !window.muster.scene.robots.find(robot => robot.id === 3).alive);
        await page.keyboard.press('d');
        await page.getByLabel('Name').focus();
        await page.keyboard.press('s');
        await page.keyboard.press('Escape');
        assert.ok(!await page.evaluate(() => window.muster.scene.estopped));
        await page.keyboard.press('s');
        await until(page, () => window.muster.scene.estopped);
        await page.context().close();
    });
});

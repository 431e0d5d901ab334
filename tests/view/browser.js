// A run of muster, a browser that looks at it, and patience. What was started ends with the test.
'use strict';

const { spawn } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const { after } = require('node:test');
const { chromium } = require('playwright-core');

const MUSTER = process.env.MUSTER;
const SCENARIOS = process.env.MUSTER_SCENARIOS;

// Where screenshots and figures are kept.
const KEPT = process.env.MUSTER_VIEW_KEPT;

// Nothing that is waited for takes as long, on whatever machine.
const PATIENCE_MS = 30000;

// Whatever hangs, no program outlives its test: ctest would leave them behind.
const LONGEST_MS = 100000;

const BROWSER = process.env.MUSTER_BROWSER;
if (!fs.existsSync(BROWSER)) {
    console.log('skipped: there is no chromium');
    process.exit(77);
}
const BROWSER_ARGUMENTS = [
    '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync',
];

const work = fs.mkdtempSync(path.join(os.tmpdir(), 'muster-view-'));
const programs = [];
let browser = null;

after(async () => {
    if (browser !== null)
        await browser.close();
    for (const program of programs)
        program.kill('SIGKILL');
    await Promise.all(programs.map(program => program.ended));
    fs.rmSync(work, { recursive: true, force: true });
});

setTimeout(() => {
    console.log('it took too long');
    programs.forEach(program => program.kill('SIGKILL'));
    process.exit(1);
}, LONGEST_MS).unref();

// ---- programs ------------------------------------------------------------------------------

class Program {
    constructor(words) {
        this.words = words;
        this.output = '';
        this.code = undefined;
        this.heard = [];
        this.child = spawn(MUSTER, words, { stdio: ['ignore', 'pipe', 'pipe'] });
        for (const stream of [this.child.stdout, this.child.stderr]) {
            stream.setEncoding('utf8');
            stream.on('data', text => { this.output += text; this.listen(); });
        }
        this.ended = new Promise(resolve => this.child.on('close', code => {
            this.code = code;
            this.listen();
            resolve(code);
        }));
    }

    listen() {
        this.heard = this.heard.filter(listener => !listener());
    }

    // The match of a pattern in what the program says.
    says(pattern) {
        return patience(`muster ${this.words.join(' ')} says ${pattern}`, new Promise((resolve, reject) => {
            const listener = () => {
                const match = this.output.match(pattern);
                if (match)
                    resolve(match);
                else if (this.code !== undefined)
                    reject(new Error(`muster ${this.words.join(' ')} ended with ${this.code}:\n${this.output}`));
                return match || this.code !== undefined;
            };
            if (!listener())
                this.heard.push(listener);
        }));
    }

    kill(signal) {
        if (this.code === undefined)
            this.child.kill(signal);
    }

    async ends() {
        return patience(`muster ${this.words.join(' ')} ends`, this.ended);
    }
}

function patience(what, promise) {
    let timer;
    const late = new Promise((resolve, reject) => {
        timer = setTimeout(() => reject(new Error(`waited in vain: ${what}`)), PATIENCE_MS);
    });
    return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

function muster(...words) {
    const program = new Program(words);
    programs.push(program);
    return program;
}

// `muster ... --view=0`, and the address that it tells.
async function seen(...words) {
    const program = muster(...words, '--view=0');
    program.address = (await program.says(/^view: (http:\S+)$/m))[1];
    return program;
}

function file(name) {
    return path.join(work, name);
}

// The rows of one of a run's tables, as objects.
function rows(folder, name) {
    const [head, ...lines] = fs.readFileSync(path.join(folder, name), 'utf8').trimEnd().split('\n');
    const names = head.split(',');
    return lines.map(line => Object.fromEntries(line.split(',').map((value, i) => [names[i], value])));
}

// ---- pages ---------------------------------------------------------------------------------

async function start() {
    if (browser === null)
        browser = await chromium.launch({ executablePath: BROWSER, args: BROWSER_ARGUMENTS });
    return browser;
}

// A page of its own; `page.complaints` are what a developer would see in red.
async function open(options = {}) {
    const context = await (await start()).newContext({ viewport: { width: 1280, height: 800 }, ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(PATIENCE_MS);
    page.complaints = [];
    page.on('console', message => {
        if (['error', 'warning'].includes(message.type()))
            page.complaints.push(message.text());
    });
    page.on('pageerror', error => page.complaints.push(String(error)));
    page.on('requestfailed', request => page.complaints.push(`${request.url()}: ${request.failure().errorText}`));
    page.on('response', response => {
        if (response.status() >= 400)
            page.complaints.push(`${response.url()}: ${response.status()}`);
    });
    return page;
}

// A page that shows at least one scene.
async function look(address, options) {
    const page = await open(options);
    await page.goto(address);
    await until(page, () => window.muster?.scene);
    return page;
}

// What a function finds in the page, as soon as it finds anything.
async function until(page, seen, what) {
    const deadline = Date.now() + PATIENCE_MS;

    for (;;) {
        const found = await page.evaluate(seen, what);
        if (found)
            return found;
        if (Date.now() > deadline)
            throw new Error(`waited in vain: ${seen} ${JSON.stringify(what)}\n${page.complaints.join('\n')}`);
        await page.evaluate(() => new Promise(requestAnimationFrame));
    }
}

const press = (page, name) => page.getByRole('button', { name }).click();

function shot(page, name) {
    return page.screenshot({ path: path.join(KEPT, `${name}.png`) });
}

module.exports = { KEPT, SCENARIOS, file, look, muster, open, press, rows, seen, shot, until };

// The page's modules. Node takes them for modules where a package says that they are: in a copy.
'use strict';

const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const { pathToFileURL } = require('node:url');

const copy = fs.mkdtempSync(path.join(os.tmpdir(), 'muster-page-'));
fs.cpSync(path.join(__dirname, '../../../server/view/page'), copy, { recursive: true });
fs.writeFileSync(path.join(copy, 'package.json'), '{"type": "module"}');
process.on('exit', () => fs.rmSync(copy, { recursive: true, force: true }));

module.exports = name => import(pathToFileURL(path.join(copy, name)));

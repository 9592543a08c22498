import { chromium } from 'playwright-core';
const [file, out, width = '1280', height = '900', full = ''] = process.argv.slice(2);
const b = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
const p = await (await b.newContext({ viewport: { width: +width, height: +height } })).newPage();
await p.goto('file://' + file);
await p.waitForTimeout(500);
await p.screenshot({ path: out, fullPage: full === 'full' });
if (full === 'pdf') { const pdf = await p.pdf({ preferCSSPageSize: true, path: out + '.pdf' }); console.log('pages', pdf.toString('latin1').match(/\/Type\s*\/Page\b/g).length); }
await b.close();

import { chromium } from 'playwright-core';
const [url, ...files] = process.argv.slice(2);
const b = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
const c = await b.newContext({ viewport: { width: 1280, height: 900 } });
const p = await c.newPage();
await p.goto(url);
await p.click('#tab-inventory');
const t0 = Date.now();
if (files[0] === 'example') await p.click('button:has-text("Try an example")');
else await p.setInputFiles('input[type=file] >> nth=0', files);
await p.waitForTimeout(3000);
await p.screenshot({ path: `/tmp/look/inv-read.png`, fullPage: true });
const buttons = await p.$$eval('#panel-inventory button', (all) => all.map((x) => x.textContent.trim()));
console.log(buttons.join(' | '));
await p.click('#panel-inventory button:has-text("Assess")').catch((e) => console.log(String(e)));
for (let i = 0; i < 120; i++) {
  await p.waitForTimeout(5000);
  const s = await p.evaluate(() => document.querySelector('#panel-inventory progress, #panel-inventory [role=progressbar]')?.parentElement?.textContent ?? '');
  const n = await p.$$eval('#panel-inventory table tr', (all) => all.length);
  console.log(((Date.now()-t0)/1000).toFixed(0), s.slice(0, 160), n);
  if (i === 1) await p.screenshot({ path: `/tmp/look/inv-running.png`, fullPage: true });
  if (!s) break;
}
await p.screenshot({ path: `/tmp/look/inv-done.png`, fullPage: true });
await b.close();

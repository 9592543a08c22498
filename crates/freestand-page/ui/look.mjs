import { chromium } from 'playwright-core';
const url = process.argv[2];
const b = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
for (const width of [1280, 390]) {
  const c = await b.newContext({ viewport: { width, height: width === 390 ? 844 : 900 } });
  const p = await c.newPage();
  await p.goto(url);
  const done = () => p.waitForSelector('#answer[data-state=done]', { timeout: 120000 });
  await done(); await p.waitForTimeout(800);
  await p.screenshot({ path: `/tmp/look/fall-${width}.png` });
  await p.screenshot({ path: `/tmp/look/fall-${width}-full.png`, fullPage: true });
  await p.fill('#place', 'Wellington'); await p.fill('#height', '2 m'); await p.fill('#thickness', '500'); await p.fill('#storeys','3'); await p.locator('#storeys').blur();
  await p.waitForFunction(() => document.querySelector('#answer').textContent.includes('Wellington') && document.querySelector('#answer').dataset.state === 'done', undefined, { timeout: 120000 });
  await p.click('#advanced > summary'); await p.waitForTimeout(500);
  await p.screenshot({ path: `/tmp/look/adv-${width}.png`, fullPage: true });
  for (const tab of ['inventory', 'spectra', 'pads', 'records']) {
    await p.click(`#tab-${tab}`); await p.waitForTimeout(1500);
    await p.screenshot({ path: `/tmp/look/${tab}-${width}.png`, fullPage: true });
  }
  await c.close();
}
await b.close();

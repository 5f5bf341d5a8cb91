// views.mjs PLAYWRIGHT CHROMIUM REPORTS PICTURES [--update]: opens the reports of a folder from disk, goes through their views by hash, by
// keys and by the replay, and compares each with its picture.
import {pathToFileURL} from 'node:url';
import {Browser} from './browser.mjs';

const [, , playwright, chromium, reports, pictures, option] = process.argv;
const browser = await Browser.open(pathToFileURL(playwright).href, chromium), update = option === '--update';

const views = {
    'curve.html': {curve: '', comb: 'show=points+comb+knots', bars: 'show=points+bars&bars=2', zoomed: 'show=points+control+knots&view=0.01,0,12', replay: 'frame=1.5'},
    'space.html': {space: '', space_comb: 'show=points+comb+bars'},
    'surface.html': {shaded: 'mode=shaded', deviation: 'mode=deviation', zebra: 'mode=zebra', isophotes: 'mode=isophotes', gaussian: 'mode=gaussian', mean: 'mode=mean',
        net: 'mode=shaded&show=control+points+knots+met', start: 'mode=deviation&frame=0', between: 'mode=shaded&frame=1.5'},
    'trimmed.html': {trimmed: 'mode=zebra'},
    'parts.html': {parts: ''}};

for (const [file, list] of Object.entries(views)) {
    const page = await browser.report(`${reports}/${file}`);
    console.log(`${file}: ready after ${await page.evaluate(() => document.documentElement.dataset.ready)} ms`);
    for (const [name, hash] of Object.entries(list)) {
        await browser.view(page, hash || 'theme=light');
        await browser.compare(page, `${pictures}/${name}.png`, update);
    }
    await page.context().close();
}

// Dark, and from the first load.
for (const [file, name, hash] of [['curve.html', 'curve_dark', ''], ['surface.html', 'surface_dark', '#mode=mean']]) {
    const page = await browser.report(`${reports}/${file}`, {dark: true, hash});
    await browser.compare(page, `${pictures}/${name}.png`, update);
    await page.context().close();
}

// What the page says, to eyes and to screen readers.
{
    const page = await browser.report(`${reports}/curve.html`), text = selector => page.locator(selector).innerText();
    browser.check(/reached/.test(await text('#verdict')), 'the verdict says that the tolerance is reached');
    browser.check(/19 control points/.test((await text('#words')).replace(/\u00a0/g, ' ')), 'the summary counts the control points');
    browser.check(/pia fit .*--tolerance/.test(await text('#reproduce pre')), 'the command line is shown');
    browser.check(await page.locator('#settings tbody tr').count() > 20, 'all settings are listed');
    browser.check(await page.locator('h1').count() === 1 && await page.locator('main').count() === 1, 'one heading, one main landmark');
    const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input, [role=img], [role=application]')]
        .filter(e => !(e.getAttribute('aria-label') || e.textContent.trim() || e.labels?.length)).map(e => e.outerHTML));
    browser.check(nameless.length === 0, `every control has a name: ${nameless}`);
    await page.locator('#canvas').focus();
    await page.keyboard.press('w');
    await page.waitForFunction(() => /deviation/.test(document.getElementById('readout').textContent));
    browser.check(/Row\u00a053 /.test(await text('#readout')), `W reads the farthest point: ${await text('#readout')}`);
    await page.keyboard.press('+');
    await page.keyboard.press('ArrowLeft');
    await page.waitForTimeout(300);
    const kept = await page.evaluate(() => location.hash);
    browser.check(/row=53/.test(kept) && /view=/.test(kept), `point and camera stand in the address: ${kept}`);
    const again = await browser.report(`${reports}/curve.html`, {hash: kept});
    browser.check(/Row\u00a053 /.test(await again.locator('#readout').innerText()), 'a link shows the same point again');
    await page.locator('#theme').click();
    browser.check(await page.evaluate(() => document.documentElement.dataset.theme) === 'light', 'the theme can be chosen');
    await page.context().close();
    await again.context().close();
}

// A phone: nothing sticks out; a tap reads a point.
{
    const page = await browser.report(`${reports}/surface.html`, {width: 390, height: 844});
    browser.check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing sticks out on a phone');
    await page.locator('#canvas').scrollIntoViewIfNeeded();
    const touch = await page.context().newCDPSession(page), box = await page.locator('#canvas').boundingBox();
    const fingers = (type, apart) => touch.send('Input.dispatchTouchEvent', {type,
        touchPoints: apart === null ? [] : [-1, 1].map((side, id) => ({id, x: box.x + box.width / 2 + side * apart / 2, y: box.y + box.height / 2}))});
    await touch.send('Emulation.setTouchEmulationEnabled', {enabled: true, maxTouchPoints: 2});
    await fingers('touchStart', 60);
    for (const apart of [90, 120, 150]) await fingers('touchMove', apart);
    await fingers('touchEnd', null);
    await page.waitForTimeout(300);
    const [, , distance] = (new URLSearchParams((await page.evaluate(() => location.hash)).slice(1)).get('view') ?? '').split(',').map(Number);
    browser.check(distance < 0.6, `two fingers that part draw the surface nearer: distance ${distance}`);
    await page.context().close();
}

// On paper: what is only for the screen is gone, the figure and the numbers are there, on few pages.
for (const file of ['curve.html', 'surface.html']) {
    const page = await browser.report(`${reports}/${file}`, {width: 718, height: 1000});
    await page.emulateMedia({media: 'print'});
    for (const gone of ['.tools', '.play', '#keys']) browser.check(!await page.locator(gone).first().isVisible(), `${file}: ${gone} is not printed`);
    for (const kept of ['#verdict', '#canvas canvas', '#reproduce pre']) browser.check(await page.locator(kept).first().isVisible(), `${file}: ${kept} is printed`);
    browser.check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${file}: nothing sticks out of the paper`);
    const pages = (await page.pdf({format: 'A4', printBackground: true})).toString('latin1').match(/\/Type\s*\/Page\b/g)?.length;
    browser.check(pages >= 1 && pages <= 5, `${file}: is printed on ${pages} pages`);
    console.log(`${file}: ${pages} pages on paper`);
    await page.context().close();
}

// The replay plays to its end.
for (const file of ['curve.html', 'surface.html']) {
    const page = await browser.report(`${reports}/${file}`);
    await page.locator('.play').click();
    const rate = await page.evaluate(async () => {
        const slider = document.querySelector('.replay input'), begin = performance.now(), first = Number(document.documentElement.dataset.drawn);
        while (performance.now() - begin < 60000) {
            await new Promise(requestAnimationFrame);
            if (performance.now() - begin > 500 && Number(slider.value) >= Number(slider.max)) break;
        }
        return {end: Number(slider.value) >= Number(slider.max), rate: 1000 * (Number(document.documentElement.dataset.drawn) - first) / (performance.now() - begin)};
    });
    browser.check(rate.end, `${file}: the replay comes to its end`);
    console.log(`${file}: replayed at ${rate.rate.toFixed(1)} frames a second`);
    await page.context().close();
}

await browser.process.close();
process.exit(browser.failures.length ? 1 : 0);

// Chromium for the tests of the page: opening a report from disk, counting what must not happen, comparing pictures.
import {existsSync, readFileSync, writeFileSync} from 'node:fs';
import {pathToFileURL} from 'node:url';

const flags = ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--force-color-profile=srgb', '--font-render-hinting=none'];

export class Browser {
    static async open(playwright, executablePath) {
        const {chromium} = await import(playwright), browser = new Browser();
        browser.process = await chromium.launch({executablePath, args: flags});
        browser.failures = [];
        return browser;
    }

    fail(text) {
        this.failures.push(text);
        console.error('FAILED: ' + text);
    }

    check(holds, text) {
        if (!holds) this.fail(text);
    }

    /** A page of its own, loaded and drawn; errors and requests to anything but itself are failures. */
    async report(file, {width = 520, height = 720, dark = false, hash = ''} = {}) {
        const context = await this.process.newContext({viewport: {width, height}, colorScheme: dark ? 'dark' : 'light', reducedMotion: 'reduce'});
        const page = await context.newPage(), name = file.split('/').pop();
        page.setDefaultTimeout(120000); // machines under load
        page.on('pageerror', error => this.fail(`${name}: ${error.stack}`));
        page.on('console', message => { if (message.type() === 'error') this.fail(`${name}: console: ${message.text()}`); });
        page.on('request', request => { if (!/^(file|data|blob):/.test(request.url())) this.fail(`${name}: asks for ${request.url()}`); });
        await page.goto(pathToFileURL(file).href + hash);
        await page.waitForFunction(() => document.documentElement.dataset.ready && document.documentElement.dataset.drawn, null, {timeout: 60000});
        return page;
    }

    /** Goes to a view by its hash and waits until it is drawn. */
    async view(page, hash) {
        await page.evaluate(async wanted => {
            const drawn = document.documentElement.dataset.drawn;
            location.hash = wanted;
            while (document.documentElement.dataset.drawn === drawn) await new Promise(requestAnimationFrame);
        }, hash);
    }

    /** Compares the figure with a picture of it; `update`: writes the picture instead. */
    async compare(page, reference, update) {
        const now = await page.locator('#stage').screenshot(), name = reference.split('/').pop();
        if (update) { writeFileSync(reference, now); return; }
        if (!existsSync(reference)) { this.fail(`${name}: there is no such picture; make it by --update`); return; }
        const share = await differingShare(page, readFileSync(reference), now);
        console.log(`${name}: ${(100 * share).toFixed(2)} % of the pixels differ`);
        if (share <= MOST_DIFFERING) return;
        writeFileSync(`${process.cwd()}/${name}`, now);
        this.fail(`${name}: ${(100 * share).toFixed(1)} % of the pixels differ, more than ${100 * MOST_DIFFERING} %; what is drawn now: ${process.cwd()}/${name}`);
    }
}

const MOST_DIFFERING = 0.03, SEEN = 48; // fonts and the edges of lines differ from machine to machine

/** Share of the pixels that differ by more than the eye overlooks; 1 where the sizes differ. */
async function differingShare(page, a, b) {
    return page.evaluate(async ([first, second, seen]) => {
        const pixels = async base64 => {
            const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), c => c.charCodeAt(0))], {type: 'image/png'}));
            const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
            context.drawImage(bitmap, 0, 0);
            return context.getImageData(0, 0, bitmap.width, bitmap.height);
        };
        const p = await pixels(first), q = await pixels(second);
        if (p.width !== q.width || p.height !== q.height) return 1;
        let differing = 0;
        for (let k = 0; k < p.data.length; k += 4)
            differing += [0, 1, 2].some(c => Math.abs(p.data[k + c] - q.data[k + c]) > seen);
        return differing / (p.data.length / 4);
    }, [a.toString('base64'), b.toString('base64'), SEEN]);
}

// Builds src/report/page/page.html from the sources here: markup, style, the program deflated and in base64, and the licences of what
// is in it. `node build.mjs --check` builds in memory and compares with what is committed.
import {deflateSync, inflateSync} from 'node:zlib';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import {build} from 'esbuild';

const here = fileURLToPath(new URL('.', import.meta.url));
const target = fileURLToPath(new URL('../src/report/page/page.html', import.meta.url));
const read = name => readFileSync(here + name, 'utf8');

async function bundle(entry, options) {
    const result = await build({
        entryPoints: [here + entry], bundle: true, minify: true, write: false, target: 'es2022', legalComments: 'none', ...options});
    return result.outputFiles[0].text.trim();
}

const program = await bundle('src/main.js', {format: 'iife'});
const style = await bundle('style.css', {});
const licence = read('node_modules/three/LICENSE').trim();
const version = JSON.parse(read('node_modules/three/package.json')).version;

// The template with everything but the program in place.
const parts = read('page.html')
    .replace('/*style*/', () => style)
    .replace('<!--licences-->', () => `<!--\nThis page contains three.js ${version}:\n\n${licence}\n-->`)
    .split('<!--program-->');

if (process.argv.includes('--check')) {
    const committed = readFileSync(target, 'utf8');
    const [head, tail] = parts;
    const packed = committed.slice(head.length, committed.length - tail.length);
    const same = committed.startsWith(head) && committed.endsWith(tail) &&
        inflateSync(Buffer.from(packed, 'base64')).toString('utf8') === program;
    if (!same) {
        console.error('src/report/page/page.html does not correspond to web/; run ./run web and commit it');
        process.exit(1);
    }
    console.log('src/report/page/page.html corresponds to web/');
} else {
    mkdirSync(fileURLToPath(new URL('../src/report/page', import.meta.url)), {recursive: true});
    const packed = deflateSync(Buffer.from(program, 'utf8'), {level: 9}).toString('base64');
    writeFileSync(target, parts.join(packed));
    console.log(`${target}: program ${program.length} bytes, packed ${packed.length}`);
}

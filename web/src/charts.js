// The convergence chart and the histogram, as SVG with a table behind each.
import {foldedTable, make} from './dom.js';
import {count, number, tickLabels, ticks} from './format.js';

const WIDTH = innerWidth < 700 ? 370 : 560, HEIGHT = innerWidth < 700 ? 260 : 300, BOX = {left: 62, right: 14, top: 16, bottom: 44};
const inner = {width: WIDTH - BOX.left - BOX.right, height: HEIGHT - BOX.top - BOX.bottom};

function chart(title, description, ...parts) {
    return make('svg:svg', {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': `${title}. ${description}`}, ...parts);
}

const line = (x1, y1, x2, y2, className) => make('svg:line', {x1, y1, x2, y2, class: className});
const text = (x, y, className, content, anchor = 'middle') => make('svg:text', {x, y, class: className, 'text-anchor': anchor}, content);

function axes(xs, xLabels, atX, ys, yLabels, atY, xName) {
    const bottom = HEIGHT - BOX.bottom;
    return [...ys.map(y => line(BOX.left, atY(y), WIDTH - BOX.right, atY(y), 'rule')), ...ys.map((y, i) => text(BOX.left - 8, atY(y) + 4, 'tick', yLabels[i], 'end')),
        ...xs.map(x => line(atX(x), bottom, atX(x), bottom + 5, 'axis')), ...xs.map((x, i) => text(atX(x), bottom + 19, 'tick', xLabels[i])),
        line(BOX.left, bottom, WIDTH - BOX.right, bottom, 'axis'), text(BOX.left + inner.width / 2, HEIGHT - 6, 'name', xName)];
}

/** [iteration, control count, largest, rms] of the first model: the history that was written, or the frames'. */
export function history(model) {
    if (model.head.trace.length) return model.head.trace;
    return model.figures[0].frames.filter(f => f.maxError !== undefined).map(f => [f.iteration, f.controlCount, f.maxError, f.rmsError]);
}

const powers = (low, high) => {
    const step = Math.max(1, Math.ceil((high - low) / 6)), out = [];
    for (let e = Math.ceil(low - 1e-9); e <= high + 1e-9; e += step) out.push(10 ** e);
    return out;
};

export function convergence(model, element) {
    const rows = history(model).filter(r => r[2] > 0);
    if (rows.length < 2) return null;
    element.hidden = false;
    const last = rows[rows.length - 1][0], first = rows[0][0], logarithmic = last > 60;
    const warp = x => logarithmic ? Math.log10(1 + x) : x, values = rows.flatMap(r => [r[2], r[3]]).filter(v => v > 0);
    if (model.tolerance) values.push(model.tolerance);
    const low = Math.floor(Math.log10(Math.min(...values)) - 0.05), high = Math.ceil(Math.log10(Math.max(...values)) + 0.05);
    const atX = x => BOX.left + inner.width * (warp(x) - warp(first)) / (warp(last) - warp(first) || 1);
    const atY = y => BOX.top + inner.height * (high - Math.log10(y)) / (high - low);
    const xs = logarithmic ? [0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1e3, 2e3, 5e3, 1e4, 1e5, 1e6].filter((x, i, all) => x >= first && x <= last && (last < 2000 || ![2, 5, 20, 50, 200, 500].includes(x)))
        : ticks(first, last, Math.min(10, last - first)).filter(Number.isInteger);
    const ys = powers(low, high), path = column => rows.filter(r => r[column] > 0).map((r, i) => `${i ? 'L' : 'M'}${atX(r[0]).toFixed(1)} ${atY(r[column]).toFixed(1)}`).join('');
    const name = model.fits[0]?.round_count > 0 ? 'Round' : 'Iteration', growing = rows.some(r => r[1] !== rows[0][1]);
    const dots = column => rows.length > 40 ? [] : rows.filter(r => r[column] > 0).map(r => make('svg:circle', {cx: atX(r[0]), cy: atY(r[column]), r: 2.75, class: column === 2 ? 'max' : 'rms'}));
    const marker = make('svg:g', {class: 'now', visibility: 'hidden'}, line(0, BOX.top, 0, HEIGHT - BOX.bottom, 'now'), make('svg:circle', {r: 5, class: 'now'}));
    const counts = growing && rows.length <= 14 ? rows.map(r => text(atX(r[0]), atY(r[2]) - 9, 'note', count(r[1]))) : [];
    const story = `The largest error goes from ${number(rows[0][2])} to ${number(rows[rows.length - 1][2])} in ${name.toLowerCase()}s ${first} to ${last}.`;
    const goal = model.tolerance ? [line(BOX.left, atY(model.tolerance), WIDTH - BOX.right, atY(model.tolerance), 'goal'), text(BOX.left + 6, atY(model.tolerance) - 6, 'goal', `tolerance ${number(model.tolerance)}`, 'start')] : [];
    element.append(make('h2', {}, model.figures.length > 1 ? 'Convergence of the first model' : 'Convergence'), make('p', {class: 'key'}, make('span', {class: 'swatch max'}), 'largest error', make('span', {class: 'swatch rms'}), 'RMS error',
        counts.length ? make('span', {class: 'aside'}, 'numbers: control points') : ''),
        chart('Convergence', story, ...axes(xs, xs.map(count), atX, ys, ys.map(y => number(y, 1)), atY, name), ...goal,
            make('svg:path', {d: path(3), class: 'rms'}), make('svg:path', {d: path(2), class: 'max'}), ...dots(3), ...dots(2), ...counts, marker),
        foldedTable('Errors by ' + name.toLowerCase(), [name, 'Control points', 'Largest error', 'RMS error'], rows.map(r => [count(r[0]), count(r[1]), number(r[2], 4), number(r[3], 4)])));
    return {
        /** Moves the marker to an iteration and its error. */
        mark(iteration, error) {
            marker.setAttribute('visibility', error > 0 ? 'visible' : 'hidden');
            if (!(error > 0)) return;
            const x = atX(Math.min(last, Math.max(first, iteration))), [lineMark, dot] = marker.children;
            lineMark.setAttribute('x1', x);
            lineMark.setAttribute('x2', x);
            dot.setAttribute('cx', x);
            dot.setAttribute('cy', atY(error));
        }};
}

export function histogram(model, element) {
    if (!model.data) return;
    const {counts, low, high} = model.data.histogram, {sides, percentiles, all} = model.data;
    if (!(high > low)) return;
    element.hidden = false;
    const most = Math.max(...counts), atX = x => BOX.left + inner.width * (x - low) / (high - low), atY = y => BOX.top + inner.height * (1 - y / most);
    const xs = ticks(low, high, 5), ys = ticks(0, most, 4).filter(Number.isInteger), step = inner.width / counts.length;
    const edges = i => [low + (high - low) * i / counts.length, low + (high - low) * (i + 1) / counts.length];
    const bars = counts.map((n, i) => n ? make('svg:rect', {x: BOX.left + i * step + 0.5, y: Math.min(atY(n), atY(0) - 1.5), width: step - 1, height: Math.max(1.5, atY(0) - atY(n)), class: 'bar'},
        make('svg:title', {}, `${number(edges(i)[0])} to ${number(edges(i)[1])}: ${count(n)}`)) : null).filter(Boolean);
    const goals = model.tolerance ? (sides ? [-model.tolerance, model.tolerance] : [model.tolerance]).filter(t => t >= low && t <= high) : [];
    const labels = tickLabels(xs), scale = labels.some(l => l.length > 7) ? xs.map(x => number(x, 2)) : labels;
    const name = sides ? `Deviation (${model.surface ? 'above' : 'left of'} the ${model.surface ? 'surface' : 'curve'}: positive)` : 'Deviation';
    const story = `Half of ${count(all)} points are within ${number(percentiles[0])}, 90 of 100 within ${number(percentiles[1])}, 99 of 100 within ${number(percentiles[2])}; the largest is ${number(model.data.largest)}.`;
    element.append(make('h2', {}, 'Distribution of errors'), make('p', {class: 'key'}, story),
        chart('Histogram of deviations', story, ...axes(xs, scale, atX, ys, ys.map(count), atY, name), ...bars, ...goals.map(t => line(atX(t), BOX.top, atX(t), HEIGHT - BOX.bottom, 'goal'))),
        foldedTable('Points by deviation', ['From', 'To', 'Points'], counts.map((n, i) => [number(edges(i)[0]), number(edges(i)[1]), count(n)])));
}

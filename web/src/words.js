// The result told in sentences.
import {count, counted, number, seconds} from './format.js';

const DEGREES = ['', 'linear', 'quadratic', 'cubic', 'quartic', 'quintic'];
const STOPS = {
    tolerance: 'the tolerance is reached', change: 'the control points no longer moved', gradient: 'the gradient was as good as zero',
    iterations: 'the iterations asked for were done', time: 'the time was over', cancelled: 'it was interrupted',
    stalled: 'further steps did not reduce the error', finite: 'the method is finite and was done',
    'no-knot-left': 'the data cannot hold more knots', infeasible: 'constraints and shape left no step', none: 'it was still running'};

export const baseName = path => path ? path.split('/').pop() : null;

function shapeWords(model) {
    const [{spline, surface}] = model.figures, [p, q] = spline.degree, exact = model.figures[0].exact;
    const degree = !exact ? '' : surface && p !== q ? `degree ${p}\u00d7${q} ` : surface && p === 3 ? 'bicubic ' : `${DEGREES[p] ?? `degree-${p}`} `;
    const noun = `${model.figures.some(f => f.spline.weights) ? 'NURBS' : 'B-spline'} ${surface ? 'surface' : 'curve'}`;
    return {degree, noun};
}

export function controlCount(model) {
    return model.figures.reduce((sum, f) => sum + f.ownControl.reduce((a, b) => a * b, 1), 0);
}

/** control points as people count them: of a grid, rows times columns. */
function controlWords(model) {
    const fit = model.fits[0], [first] = model.figures;
    if (model.figures.length === 1 && first.surface) return `${first.ownControl.join('\u00a0\u00d7\u00a0')} control points`;
    return counted(model.figures.length === 1 && fit ? fit.control_count : controlCount(model), 'control point');
}

function whatSentence(model) {
    const {degree, noun} = shapeWords(model), many = model.figures.length, name = baseName(model.head.source);
    const subject = many > 1 ? `${counted(many, `${degree}${noun}`)} of ${controlWords(model)} in all`
        : `A ${model.figures[0].periodic ? 'closed ' : ''}${degree}${noun} of ${controlWords(model)}`;
    if (!model.data) return `${subject}.`;
    return `${subject} ${many > 1 ? 'follow' : 'follows'} ${counted(model.data.all, 'point')}${name ? ` of ${name}` : ''}.`;
}

export const rowName = (model, index) => `row\u00a0${count(model.data.row[index])}`;

function errorSentence(model) {
    const {data} = model;
    if (!data) return '';
    const how = data.parametric ? 'at the parameters of the fit' : 'from the closest points of the model';
    return `The farthest point, ${rowName(model, data.farthest)}, is ${number(data.largest, 4)} away, measured ${how}; half of all points are within ${number(data.percentiles[0])}, ` +
        `99 of 100 within ${number(data.percentiles[2])}.`;
}

function wayWords(fit) {
    const done = fit.round_count > 0 ? counted(fit.round_count, 'round') : counted(fit.iterations, 'iteration');
    return `Method ${fit.method} took ${done} and ${seconds(fit.seconds)}`;
}

function waySentence(model) {
    const [fit] = model.fits;
    if (!fit || model.fits.length > 1) return '';
    const from = fit.start_error > fit.max_error && fit.iterations > 0 ? `, from an error of ${number(fit.start_error)} at the start` : '';
    return `${wayWords(fit)}${from}.`;
}

/** {tone: good | bad | plain, text}: whether what was wanted is reached. */
export function verdict(model) {
    const {data, tolerance, fits} = model, stop = STOPS[fits.find(f => f && f.reached === false)?.stop ?? fits[0]?.stop];
    const asked = tolerance || fits.some(f => f && f.reached !== null), name = tolerance ? `Tolerance ${number(tolerance)}` : 'Tolerance';
    if (!asked) return {tone: 'plain', text: fits[0] ? 'No tolerance asked' : 'No fit'};
    if (fits.every(f => f && f.reached !== false)) return {tone: 'good', text: `${name} reached`};
    const excess = data && tolerance ? `: the farthest point is ${number(data.largest / tolerance, 2)} times as far` : '';
    return {tone: 'bad', text: `${name} not reached${excess}`, why: stop};
}

export function sentences(model) {
    const {why} = verdict(model), fit = model.fits[0];
    const stopped = why ? `The fit ended because ${why}.` : fit && fit.reached === null ? `It ended because ${STOPS[fit.stop]}.` : '';
    return [whatSentence(model), errorSentence(model), [waySentence(model), stopped].filter(Boolean).join(' ')].filter(Boolean);
}

/** Warnings, without what the library says of its choice of method. */
export function warnings(model) {
    const notes = model.fits.flatMap(fit => fit?.notes ?? []).filter(note => !note.startsWith('method: '));
    if (model.data && model.data.shown < model.data.all)
        notes.push(`Of ${count(model.data.all)} points, ${count(model.data.shown)} are drawn: of each group of neighbours the farthest. All numbers are of all points.`);
    if (model.figures.some(f => !f.exact)) notes.push('The model is too large for a page; its shape is drawn from samples.');
    return [...new Set(notes)];
}

export function choices(model) {
    return model.fits[0]?.notes.filter(note => note.startsWith('method: ')).map(note => note.slice(8)) ?? [];
}

export function keyFigures(model) {
    const {data, fits} = model, fit = fits.length === 1 ? fits[0] : null, controls = fit ? fit.control_count : controlCount(model);
    const out = [];
    if (model.tolerance) out.push(['Tolerance', number(model.tolerance), fit ? (fit.measure_distance ? 'true distance' : 'at the parameters') : '']);
    if (data) out.push(['Points', count(data.all)]);
    out.push(['Control points', count(controls), data ? `${number(data.all / controls, 2)} points each` : '']);
    if (data) out.push(['Largest error', number(data.largest, 4), rowName(model, data.farthest)], ['RMS error', number(data.rms), model.tolerance ? `${number(100 * data.rms / model.tolerance, 2)}\u00a0% of tolerance` : '']);
    if (data && !model.tolerance) out.push(['99 of 100 points', number(data.percentiles[2]), 'or nearer']);
    if (fit) out.push([fit.round_count > 0 ? 'Rounds' : 'Iterations', count(fit.round_count > 0 ? fit.round_count : fit.iterations), seconds(fit.seconds)]);
    if (fit && fit.constraint_error !== null) out.push(['Constraints', number(fit.constraint_error), 'largest violation']);
    return out;
}

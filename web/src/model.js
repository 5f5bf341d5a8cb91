// What the page is about: models with their replay, points, fits, as typed arrays.
import {unpack} from './codec.js';
import {Spline, samplesOf} from './spline.js';

const CURVE_NODES = 3000, SURFACE_NODES = 88;

function splineOf(bytes, spec, last) {
    const knots = spec.knots.map((packed, d) => unpack(bytes, packed, last?.knots[d]));
    const points = unpack(bytes, spec.points, last?.points);
    const weights = spec.weights ? unpack(bytes, spec.weights, last?.weights) : null;
    const spline = new Spline({degree: spec.degree, control: spec.control, knots: knots.map(k => k.values), points: points.values,
        weights: weights && weights.values, dim: points.components});
    return {spline, packed: {knots, points, weights}};
}

/** Frames on the nodes of one lattice, so that they can be blended: positions [nodes x dim] of frame k. */
class Replay {
    constructor(figure) {
        this.figure = figure;
        const {spline} = figure, wanted = figure.surface ? SURFACE_NODES : CURVE_NODES;
        this.nodes = spline.degree.map((p, d) => samplesOf(spline.knots[d], p, spline.control[d], wanted, wanted));
        this.cache = new Map();
    }

    positions(k) {
        if (!this.cache.has(k)) {
            const {spline} = this.figure.frames[k];
            this.cache.set(k, this.figure.surface ? spline.lattice(this.nodes[0], this.nodes[1], 0).s : spline.curvePositions(this.nodes[0]));
        }
        return this.cache.get(k);
    }

    normals(k) {
        return normalsOf(this.positions(k), this.nodes[0].length, this.nodes[1].length);
    }
}

function figureOf(bytes, spec) {
    const {spline} = splineOf(bytes, spec);
    const figure = {spline, surface: spline.directions === 2, graph: Boolean(spec.graph), dim: spec.dim, periodic: spec.periodic,
        exact: spec.exact, trim: (spec.trim ?? []).map(flat => Array.from({length: flat.length / 2}, (_, i) => [flat[2 * i], flat[2 * i + 1]])), ownControl: spec.own_control, frames: []};
    let last;
    for (const frame of spec.frames ?? []) {
        const {spline: shape, packed} = splineOf(bytes, frame, last);
        last = packed;
        figure.frames.push({spline: shape, exact: frame.exact, iteration: frame.iteration, controlCount: frame.control_count,
            maxError: frame.max_error, rmsError: frame.rms_error});
    }
    if (figure.frames.length) figure.frames[figure.frames.length - 1].spline = spline;
    figure.replay = new Replay(figure);
    return figure;
}

function pointsOf(bytes, spec) {
    const field = name => spec[name] ? unpack(bytes, spec[name]).values : null;
    const row = field('row');
    return {
        all: spec.count, shown: row.length, row, position: field('position'), deviation: field('deviation'),
        parameter: field('parameter'), owner: field('owner') ?? new Float64Array(row.length), largest: spec.largest, rms: spec.rms,
        worst: spec.worst, percentiles: spec.percentiles, parametric: spec.parametric, sides: spec.sides, histogram: spec.histogram,
        maps: spec.maps.map(m => m.map ? unpack(bytes, m.map) : null)};
}

/** Deviations of the points shown from frame k of their models at the parameters of the end; those of a surface have a side. */
function deviationsAt(model, k) {
    const {data, figures, dim} = model, feet = feetAt(model, k), out = new Float64Array(data.shown);
    const normals = figures.map(figure => figure.surface ? figure.replay.normals(frameOf(model, figure, k)) : null), normal = [0, 0, 0];
    for (let i = 0; i < data.shown; i++) {
        const owner = data.owner[i];
        let square = 0, along = data.deviation[i];
        for (let c = 0; c < dim; c++) square += (data.position[i * dim + c] - feet[i * dim + c]) ** 2;
        if (normals[owner]) {
            bilinear(figures[owner].replay.nodes, normals[owner], 3, data.parameter[2 * i], data.parameter[2 * i + 1], normal, 0);
            along = normal.reduce((sum, n, c) => sum + n * (data.position[i * dim + c] - feet[i * dim + c]), 0);
        }
        out[i] = along < 0 ? -Math.sqrt(square) : Math.sqrt(square);
    }
    return out;
}

/** Normals of a lattice of positions by differences of neighbours. */
export function normalsOf(position, rows, columns) {
    const out = new Float32Array(position.length);
    for (let i = 0, k = 0; i < rows; i++)
        for (let j = 0; j < columns; j++, k += 3) {
            const down = i + 1 < rows ? 3 * columns : 0, up = i > 0 ? 3 * columns : 0, right = j + 1 < columns ? 3 : 0, left = j > 0 ? 3 : 0;
            const u = [0, 1, 2].map(c => position[k + down + c] - position[k - up + c]), v = [0, 1, 2].map(c => position[k + right + c] - position[k - left + c]);
            const x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0], size = Math.hypot(x, y, z) || 1;
            out[k] = x / size;
            out[k + 1] = y / size;
            out[k + 2] = z / size;
        }
    return out;
}

/** Where the parameters of the points shown lie on frame k. */
function feetAt(model, k) {
    const {data, figures, dim} = model, out = new Float64Array(data.shown * dim);
    for (let i = 0; i < data.shown; i++) {
        const figure = figures[data.owner[i]], own = frameOf(model, figure, k);
        if (figure.surface)
            bilinear(figure.replay.nodes, figure.replay.positions(own), dim, data.parameter[2 * i], data.parameter[2 * i + 1], out, i * dim);
        else
            out.set((figure.frames[own]?.spline ?? figure.spline).curve(data.parameter[i], 0)[0], i * dim);
    }
    return out;
}

function cellOf(nodes, t) {
    let low = 0, high = nodes.length - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (t < nodes[middle]) high = middle; else low = middle;
    }
    return [low, Math.min(1, Math.max(0, (t - nodes[low]) / (nodes[low + 1] - nodes[low])))];
}

export function bilinear(nodes, values, width, u, v, out, at) {
    const [i, a] = cellOf(nodes[0], u), [j, b] = cellOf(nodes[1], v), n = nodes[1].length;
    for (let c = 0; c < width; c++) {
        const value = (di, dj) => values[((i + di) * n + j + dj) * width + c];
        out[at + c] = (1 - a) * ((1 - b) * value(0, 0) + b * value(0, 1)) + a * ((1 - b) * value(1, 0) + b * value(1, 1));
    }
}

/** The frame of one figure that belongs to frame k of the whole. */
export function frameOf(model, figure, k) {
    if (model.frameCount < 2 || figure.frames.length < 2) return figure.frames.length - 1;
    return Math.round(k * (figure.frames.length - 1) / (model.frameCount - 1));
}

function remembered(compute) {
    const known = new Map();
    return k => {
        if (!known.has(k)) known.set(k, compute(k));
        return known.get(k);
    };
}

export async function load() {
    const text = id => document.getElementById(id).textContent;
    const head = JSON.parse(text('pia-head')), bytes = await globalThis.piaInflate(text('pia-data'));
    const model = {head, space: head.space, dim: head.space ? 3 : 2, low: head.low, high: head.high,
        figures: head.figures.map(spec => figureOf(bytes, spec)), data: head.data ? pointsOf(bytes, head.data) : null,
        fits: head.fits, tolerance: head.tolerance};
    model.surface = model.figures.some(f => f.surface);
    model.graph = !model.space && model.figures.every(f => f.graph);
    model.frameCount = Math.max(0, ...model.figures.map(f => f.frames.length));
    model.diagonal = Math.hypot(...model.low.map((l, c) => model.high[c] - l)) || 1;
    if (model.data) {
        model.feet = remembered(k => feetAt(model, k));
        model.deviations = remembered(k => k >= model.frameCount - 1 ? model.data.deviation : deviationsAt(model, k));
        let worst = 0;
        model.data.deviation.forEach((d, i) => { if (Math.abs(d) > Math.abs(model.data.deviation[worst])) worst = i; });
        model.data.farthest = worst;
    }
    return model;
}

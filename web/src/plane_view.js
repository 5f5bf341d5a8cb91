// Planar curves on a 2-D canvas. The curve is evaluated for what is on the screen, so that zooming never shows a polygon.
import {colour} from './colours.js';
import {combOf, tipOf} from './comb.js';
import {tickLabels, ticks} from './format.js';
import {frameOf} from './model.js';
import {palette} from './palette.js';
import {barFactor} from './scale.js';
import {Spline} from './spline.js';

const MARGIN = {left: 58, right: 22, top: 22, bottom: 36}, MOST_ZOOM = 1e7;

export class PlaneView {
    constructor(element, model, state) {
        this.model = model;
        this.state = state;
        this.canvas = document.createElement('canvas');
        element.append(this.canvas);
        this.context = this.canvas.getContext('2d');
        this.combs = new Map();
        this.centre = [0, 1].map(c => (model.low[c] + model.high[c]) / 2);
        this.zoom = 1;
    }

    resize(width, height) {
        const ratio = devicePixelRatio || 1;
        this.width = width;
        this.height = height;
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
        const inner = [width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom];
        this.combed = this.state.shows('comb');
        const room = this.combed ? 1.36 : 1.06, size = [0, 1].map(c => (this.model.high[c] - this.model.low[c]) * room || this.model.diagonal);
        this.combs.clear();
        const own = inner.map((pixels, c) => Math.max(pixels, 40) / size[c]);
        this.fitted = this.model.graph ? own : [Math.min(...own), Math.min(...own)];
    }

    get camera() {
        return this.zoom === 1 && this.home ? '' : [...this.centre.map(c => c.toPrecision(9)), this.zoom.toPrecision(5)].map(Number).join(',');
    }

    set camera(text) {
        const [x, y, zoom] = text.split(',').map(Number);
        if (text && [x, y, zoom].every(Number.isFinite) && zoom > 0) Object.assign(this, {centre: [x, y], zoom, home: false});
        else this.reset();
    }

    reset() {
        this.centre = [0, 1].map(c => (this.model.low[c] + this.model.high[c]) / 2);
        this.zoom = 1;
        this.home = true;
    }

    get scale() {
        return this.fitted.map(s => s * this.zoom);
    }

    get middle() {
        return [(MARGIN.left + this.width - MARGIN.right) / 2, (MARGIN.top + this.height - MARGIN.bottom) / 2];
    }

    spot(x, y) {
        const [sx, sy] = this.scale, [mx, my] = this.middle;
        return [mx + (x - this.centre[0]) * sx, my - (y - this.centre[1]) * sy];
    }

    move(dx, dy) {
        const [sx, sy] = this.scale;
        this.centre = [this.centre[0] - dx / sx, this.centre[1] + dy / sy];
        this.home = false;
    }

    zoomAt(factor, x, y) {
        const [mx, my] = this.middle, px = x ?? mx, py = y ?? my;
        const limited = Math.min(MOST_ZOOM, Math.max(0.2, this.zoom * factor)) / this.zoom;
        this.move(-(px - mx) * (1 - 1 / limited), -(py - my) * (1 - 1 / limited));
        this.zoom *= limited;
        this.home = false;
    }

    turn(dx, dy) {
        this.move(dx, dy);
    }

    keepPace() {}

    /** Index of the point shown nearest to a spot, -1 when none is near. */
    pick(x, y, reach = 18) {
        const {data} = this.model;
        let best = -1, least = reach ** 2;
        for (let i = 0; data && i < data.shown; i++) {
            const [px, py] = this.spot(data.position[2 * i], data.position[2 * i + 1]), distance = (px - x) ** 2 + (py - y) ** 2;
            if (distance < least) [best, least] = [i, distance];
        }
        return best;
    }

    /** Brings a point into the middle when it is out of sight. */
    reveal(i) {
        const {position} = this.model.data, [x, y] = this.spot(position[2 * i], position[2 * i + 1]);
        if (x > MARGIN.left && x < this.width - MARGIN.right && y > MARGIN.top && y < this.height - MARGIN.bottom) return;
        this.centre = [position[2 * i], position[2 * i + 1]];
        this.home = false;
    }

    draw() {
        const {context, width, height, state} = this;
        this.colours = palette();
        this.frame = state.frame();
        if (this.combed !== state.shows('comb')) this.resize(width, height);
        context.clearRect(0, 0, width, height);
        this.drawGrid();
        context.save();
        context.beginPath();
        context.rect(MARGIN.left, MARGIN.top / 2, width - MARGIN.left - MARGIN.right / 2, height - MARGIN.bottom - MARGIN.top / 2);
        context.clip();
        context.lineJoin = 'round';
        if (state.shows('comb')) this.drawComb();
        if (state.shows('control')) this.drawControl();
        this.model.figures.forEach(figure => this.drawCurve(figure));
        if (state.shows('knots')) this.drawKnots();
        if (this.model.data && state.shows('bars')) this.drawBars();
        if (this.model.data && state.shows('points')) this.drawPoints();
        this.drawMarks();
        context.restore();
    }

    drawGrid() {
        const {context, colours, width, height} = this, [sx, sy] = this.scale, [mx, my] = this.middle;
        const right = width - MARGIN.right / 2, bottom = height - MARGIN.bottom, top = MARGIN.top / 2;
        const low = [this.centre[0] - (mx - MARGIN.left) / sx, this.centre[1] - (bottom - my) / sy];
        const high = [this.centre[0] + (right - mx) / sx, this.centre[1] + (my - top) / sy];
        const xs = ticks(low[0], high[0], (right - MARGIN.left) / 90), ys = ticks(low[1], high[1], (bottom - top) / 60);
        context.font = '12px ' + getComputedStyle(document.body).fontFamily;
        context.strokeStyle = colours.grid;
        context.fillStyle = colours.soft;
        context.lineWidth = 1;
        context.beginPath();
        for (const x of xs) { const [at] = this.spot(x, 0); context.moveTo(Math.round(at) + 0.5, top); context.lineTo(Math.round(at) + 0.5, bottom); }
        for (const y of ys) { const [, at] = this.spot(0, y); context.moveTo(MARGIN.left, Math.round(at) + 0.5); context.lineTo(right, Math.round(at) + 0.5); }
        context.stroke();
        context.textBaseline = 'top';
        context.textAlign = 'center';
        tickLabels(xs).forEach((label, k) => context.fillText(label, this.spot(xs[k], 0)[0], bottom + 9));
        context.textBaseline = 'middle';
        context.textAlign = 'right';
        tickLabels(ys).forEach((label, k) => context.fillText(label, MARGIN.left - 9, this.spot(0, ys[k])[1]));
    }

    /** Adds a line through world positions [count x 2], `from(i)` giving one. */
    trace(count, from, close = false) {
        const {context} = this;
        for (let i = 0; i < count; i++) {
            const [x, y] = this.spot(...from(i));
            if (i) context.lineTo(x, y); else context.moveTo(x, y);
        }
        if (close) context.closePath();
    }

    drawCurve(figure) {
        const {context, colours, model} = this;
        context.strokeStyle = colours.curve;
        context.lineWidth = 2.25;
        context.beginPath();
        if (this.frame >= model.frameCount - 1) this.traceSpline(figure.spline);
        else {
            const k = Math.floor(this.frame), share = this.frame - k;
            const a = figure.replay.positions(frameOf(model, figure, k)), b = figure.replay.positions(frameOf(model, figure, k + 1));
            this.trace(a.length / 2, i => [a[2 * i] * (1 - share) + b[2 * i] * share, a[2 * i + 1] * (1 - share) + b[2 * i + 1] * share]);
        }
        context.stroke();
    }

    /** The spans that are in sight, in pieces of some pixels; spans smaller than a pixel are taken together. */
    traceSpline(spline) {
        const {context, width, height} = this, [p] = spline.degree, knots = spline.knots[0], home = spline.points;
        let pen = false, travelled = 0;
        for (let s = p; s < spline.control[0]; s++) {
            if (!(knots[s] < knots[s + 1])) continue;
            let [left, right, top, bottom, length, before] = [Infinity, -Infinity, Infinity, -Infinity, 0, null];
            for (let i = s - p; i <= s; i++) {
                const spot = this.spot(home[2 * i], home[2 * i + 1]);
                [left, right, top, bottom] = [Math.min(left, spot[0]), Math.max(right, spot[0]), Math.min(top, spot[1]), Math.max(bottom, spot[1])];
                if (before) length += Math.hypot(spot[0] - before[0], spot[1] - before[1]);
                before = spot;
            }
            if (right < 0 || left > width || bottom < 0 || top > height) { pen = false; continue; }
            travelled += length / p;
            if (pen && travelled < 1 && s + 1 < spline.control[0]) continue;
            travelled = 0;
            const pieces = Math.min(400, Math.max(1, Math.ceil(length / 5)));
            for (let k = pen ? 1 : 0; k <= pieces; k++) {
                const [x, y] = this.spot(...spline.curve(knots[s] + (knots[s + 1] - knots[s]) * k / pieces, 0)[0]);
                if (pen) context.lineTo(x, y); else context.moveTo(x, y);
                pen = true;
            }
        }
    }

    splines() {
        const k = Math.round(this.frame);
        return this.model.figures.map(figure => figure.frames[frameOf(this.model, figure, k)] ?? figure).map(f => [f.spline, f.exact]);
    }

    drawControl() {
        const {context, colours} = this;
        for (const [spline, exact] of this.splines()) {
            if (!exact) continue;
            const at = i => [spline.points[2 * i], spline.points[2 * i + 1]], count = spline.control[0], r = count / this.zoom > 250 ? 1.75 : 3.25;
            context.strokeStyle = colours.control;
            context.lineWidth = 1;
            context.setLineDash([5, 4]);
            context.beginPath();
            this.trace(count, at);
            context.stroke();
            context.setLineDash([]);
            if (count > 4000) continue;
            context.fillStyle = colours.stage;
            for (let i = 0; i < count; i++) {
                const [x, y] = this.spot(...at(i));
                context.beginPath();
                context.rect(x - r, y - r, 2 * r, 2 * r);
                context.fill();
                context.stroke();
            }
        }
    }

    drawKnots() {
        const {context, colours} = this;
        context.strokeStyle = colours.knot;
        context.lineWidth = 1.5;
        context.beginPath();
        for (const [spline, exact] of this.splines()) {
            if (!exact) continue;
            const [p] = spline.degree, knots = spline.knots[0];
            for (let i = p; i <= spline.control[0]; i++) {
                if (i > p && knots[i] === knots[i - 1]) continue;
                const [at, along] = spline.curve(knots[i], 1), [x, y] = this.spot(at[0], at[1]);
                const tx = along[0] * this.scale[0], ty = -along[1] * this.scale[1], size = (Math.hypot(tx, ty) || 1) / (spline.control[0] / this.zoom > 250 ? 3 : 6);
                context.moveTo(x - ty / size, y + tx / size);
                context.lineTo(x + ty / size, y - tx / size);
            }
        }
        context.stroke();
    }

    comb() {
        const k = Math.round(this.frame);
        if (!this.combs.has(k)) this.combs.set(k, combOf(this.splines().map(([spline]) => this.drawn(spline)), Math.hypot(...[0, 1].map(c => (this.model.high[c] - this.model.low[c]) * this.fitted[c]))));
        return this.combs.get(k);
    }

    /** A curve in pixels of the fitted view, where a comb stands upright though the axes of a function graph have scales of their own. */
    drawn(spline) {
        const [sx, sy] = this.fitted;
        return new Spline({...spline, points: spline.points.map((x, k) => x * (k % 2 ? sy : sx))});
    }

    drawComb() {
        const {context, colours} = this, comb = this.comb(), factor = this.state.values.comb, [fx, fy] = this.fitted;
        const spot = ([x, y]) => this.spot(x / fx, y / fy);
        context.strokeStyle = colours.comb;
        for (const line of comb.lines) {
            const tips = line.map(tooth => tipOf(tooth, comb, factor));
            context.lineWidth = 0.75;
            context.beginPath();
            line.forEach((tooth, i) => { context.moveTo(...spot(tooth.root)); context.lineTo(...spot(tips[i])); });
            context.stroke();
            context.lineWidth = 1.5;
            context.beginPath();
            this.trace(tips.length, i => [tips[i][0] / fx, tips[i][1] / fy]);
            context.stroke();
        }
    }

    drawBars() {
        const {context, colours, model} = this, {data} = model, k = Math.round(this.frame);
        const feet = model.feet(Math.max(0, k)), factor = barFactor(model) * this.state.values.bars;
        context.strokeStyle = colours.bar;
        context.lineWidth = data.shown > 2000 ? 1 : 1.75;
        context.beginPath();
        for (let i = 0; i < data.shown; i++) {
            const fx = feet[2 * i], fy = feet[2 * i + 1];
            context.moveTo(...this.spot(fx, fy));
            context.lineTo(...this.spot(fx + factor * (data.position[2 * i] - fx), fy + factor * (data.position[2 * i + 1] - fy)));
        }
        context.stroke();
    }

    drawPoints() {
        const {context, colours, model} = this, {data} = model, deviation = model.deviations(Math.max(0, Math.round(this.frame)));
        const crowd = data.shown / Math.max(1, this.zoom), small = crowd > 1500, r = small ? 1.75 : crowd > 300 ? 2.25 : 3.25, scale = data.largest || 1;
        context.lineWidth = 0.75;
        context.strokeStyle = colours.ink;
        for (let i = 0; i < data.shown; i++) {
            const [x, y] = this.spot(data.position[2 * i], data.position[2 * i + 1]);
            if (x < 0 || y < 0 || x > this.width || y > this.height) continue;
            context.fillStyle = colour('sequential', Math.abs(deviation[i]) / scale);
            if (small) { context.fillRect(x - r, y - r, 2 * r, 2 * r); continue; }
            context.beginPath();
            context.arc(x, y, r, 0, 2 * Math.PI);
            context.fill();
            context.stroke();
        }
    }

    drawMarks() {
        const {context, colours, model, state} = this, {head, data} = model;
        context.lineWidth = 2;
        context.strokeStyle = colours.mark;
        const diamond = ([x, y], r) => { context.moveTo(x, y - r); context.lineTo(x + r, y); context.lineTo(x, y + r); context.lineTo(x - r, y); context.closePath(); };
        context.beginPath();
        if (state.shows('met')) for (const at of [...head.met, ...head.constraint_points]) diamond(this.spot(...at), 6.5);
        context.stroke();
        context.strokeStyle = colours.bad;
        context.beginPath();
        if (state.shows('corners')) for (const at of cornersOf(model)) { const [x, y] = this.spot(...at); context.rect(x - 6, y - 6, 12, 12); }
        if (state.shows('unsupported')) for (const i of head.unsupported) diamond(this.spot(model.figures[0].spline.points[2 * i], model.figures[0].spline.points[2 * i + 1]), 5);
        context.stroke();
        const chosen = state.point();
        if (!data || chosen < 0) return;
        const [x, y] = this.spot(data.position[2 * chosen], data.position[2 * chosen + 1]);
        context.strokeStyle = colours.ink;
        context.beginPath();
        context.arc(x, y, 9, 0, 2 * Math.PI);
        context.stroke();
    }
}

/** Corners: the rows that the fit of the first figure took for some; of others, inside knots where a curve need not be smooth. */
export function cornersOf(model) {
    const out = [...model.head.corners];
    for (const [f, {spline, surface}] of model.figures.entries()) {
        if (surface || (f === 0 && out.length)) continue;
        const [p] = spline.degree, knots = spline.knots[0];
        for (let i = p + 1; i < spline.control[0]; i++)
            if (p > 1 && knots[i] === knots[i + p - 1] && knots[i] > knots[i - 1]) out.push(Array.from(spline.curve(knots[i], 0)[0]));
    }
    return out;
}

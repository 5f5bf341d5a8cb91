// B-spline curves and surfaces, rational or not: values and derivatives.

/** Index of the span that holds t: knots[span] <= t < knots[span + 1], the last one at the end. */
export function spanOf(knots, degree, control, t) {
    if (t >= knots[control]) {
        let last = control - 1;
        while (last > degree && knots[last] >= knots[control]) last--;
        return last;
    }
    let low = degree, high = control;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (t < knots[middle]) high = middle; else low = middle;
    }
    return low;
}

/** Basis functions and their derivatives up to `order` (at most 2) at t: rows of degree + 1 numbers (The NURBS Book, A2.3). */
export function basis(knots, degree, span, t, order) {
    const p = degree, ndu = [];
    for (let j = 0; j <= p; j++) ndu.push(new Float64Array(p + 1));
    const left = new Float64Array(p + 1), right = new Float64Array(p + 1);
    ndu[0][0] = 1;
    for (let j = 1; j <= p; j++) {
        left[j] = t - knots[span + 1 - j];
        right[j] = knots[span + j] - t;
        let saved = 0;
        for (let r = 0; r < j; r++) {
            ndu[j][r] = right[r + 1] + left[j - r];
            const share = ndu[r][j - 1] / ndu[j][r];
            ndu[r][j] = saved + right[r + 1] * share;
            saved = left[j - r] * share;
        }
        ndu[j][j] = saved;
    }
    const out = [];
    for (let k = 0; k <= order; k++) out.push(new Float64Array(p + 1));
    for (let j = 0; j <= p; j++) out[0][j] = ndu[j][p];
    const a = [new Float64Array(p + 1), new Float64Array(p + 1)];
    for (let r = 0; r <= p; r++) {
        let s1 = 0, s2 = 1, factor = p;
        a[0].fill(0);
        a[0][0] = 1;
        for (let k = 1; k <= Math.min(order, p); k++) {
            let d = 0;
            a[s2].fill(0);
            if (r >= k) {
                a[s2][0] = a[s1][0] / ndu[p - k + 1][r - k];
                d = a[s2][0] * ndu[r - k][p - k];
            }
            for (let j = r >= k - 1 ? 1 : k - r; j <= (r - 1 <= p - k ? k - 1 : p - r); j++) {
                a[s2][j] = (a[s1][j] - a[s1][j - 1]) / ndu[p - k + 1][r - k + j];
                d += a[s2][j] * ndu[r - k + j][p - k];
            }
            if (r <= p - k) {
                a[s2][k] = -a[s1][k - 1] / ndu[p - k + 1][r];
                d += a[s2][k] * ndu[r][p - k];
            }
            out[k][r] = d * factor;
            factor *= p - k;
            [s1, s2] = [s2, s1];
        }
    }
    return out;
}

/** Parameters over the domain of one direction: equal pieces of every span, about `wanted` in all and at most `most`. */
export function samplesOf(knots, degree, control, wanted, most) {
    const ends = [knots[degree]];
    for (let i = degree; i < control; i++) if (knots[i + 1] > ends[ends.length - 1]) ends.push(knots[i + 1]);
    const spans = Math.max(1, ends.length - 1), low = ends[0], high = ends[ends.length - 1];
    if (spans > most) return Float64Array.from({length: most + 1}, (_, i) => low + (high - low) * i / most);
    const pieces = Math.max(1, Math.floor(wanted / spans));
    const out = new Float64Array(spans * pieces + 1);
    for (let s = 0; s < spans; s++)
        for (let k = 0; k < pieces; k++) out[s * pieces + k] = ends[s] + (ends[s + 1] - ends[s]) * k / pieces;
    out[spans * pieces] = high;
    return out;
}

export class Spline {
    /** @param {{degree: number[], control: number[], knots: Float64Array[], points: Float64Array, weights: Float64Array|null, dim: number}} data */
    constructor({degree, control, knots, points, weights, dim}) {
        Object.assign(this, {degree, control, knots, points, weights, dim});
        this.directions = degree.length;
        this.width = weights ? dim + 1 : dim;
        this.home = weights ? homogeneous(points, weights, dim) : points;
        this.domain = degree.map((p, d) => [knots[d][p], knots[d][control[d]]]);
    }

    /** Values and derivatives of a curve at t: [value, first, second, ...] as arrays of dim numbers. */
    curve(t, order) {
        const [p] = this.degree, [low, high] = this.domain[0];
        const at = Math.min(Math.max(t, low), high), span = spanOf(this.knots[0], p, this.control[0], at);
        const rows = basis(this.knots[0], p, span, at, order);
        const w = this.width, out = rows.map(row => {
            const value = new Float64Array(w);
            for (let r = 0; r <= p; r++) for (let c = 0; c < w; c++) value[c] += row[r] * this.home[(span - p + r) * w + c];
            return value;
        });
        return this.weights ? project(out, this.dim) : out;
    }

    /** Positions [count x dim] of a curve at parameters. */
    curvePositions(parameters) {
        const out = new Float64Array(parameters.length * this.dim);
        for (let i = 0; i < parameters.length; i++) out.set(this.curve(parameters[i], 0)[0], i * this.dim);
        return out;
    }

    /** Values and derivatives of a surface on the lattice us x vs: arrays [us x vs x dim] named by derivative: s, and with order 1 u and
     *  v, with order 2 uu, uv and vv. */
    lattice(us, vs, order) {
        const w = this.width, [p, q] = this.degree, columns = this.control[1];
        const across = Array.from(vs, v => {
            const span = spanOf(this.knots[1], q, columns, v);
            return {span, rows: basis(this.knots[1], q, span, v, order)};
        });
        const names = [['s', 0, 0], ['u', 1, 0], ['v', 0, 1], ['uu', 2, 0], ['uv', 1, 1], ['vv', 0, 2]].slice(0, [1, 3, 6][order]);
        const out = Object.fromEntries(names.map(([name]) => [name, new Float64Array(us.length * vs.length * w)]));
        const lines = Array.from({length: order + 1}, () => new Float64Array(columns * w));
        for (let i = 0; i < us.length; i++) {
            const span = spanOf(this.knots[0], p, this.control[0], us[i]), rows = basis(this.knots[0], p, span, us[i], order);
            for (let k = 0; k <= order; k++) {
                const line = lines[k].fill(0);
                for (let r = 0; r <= p; r++) {
                    const base = (span - p + r) * columns * w, factor = rows[k][r];
                    for (let c = 0; c < columns * w; c++) line[c] += factor * this.home[base + c];
                }
            }
            for (const [name, a, b] of names) {
                const line = lines[a], to = out[name];
                for (let j = 0; j < vs.length; j++) {
                    const {span: s, rows: weights} = across[j], at = (i * vs.length + j) * w;
                    for (let r = 0; r <= q; r++)
                        for (let c = 0; c < w; c++) to[at + c] += weights[b][r] * line[(s - q + r) * w + c];
                }
            }
        }
        return this.weights ? projectLattice(out, this.dim) : out;
    }
}

function homogeneous(points, weights, dim) {
    const out = new Float64Array(weights.length * (dim + 1));
    for (let i = 0; i < weights.length; i++) {
        for (let c = 0; c < dim; c++) out[i * (dim + 1) + c] = points[i * dim + c] * weights[i];
        out[i * (dim + 1) + dim] = weights[i];
    }
    return out;
}

/** Quotient rule for a curve: derivatives of (w x, w) become derivatives of x. */
function project(rows, dim) {
    const out = [], w = rows.map(row => row[dim]);
    rows.forEach((row, k) => {
        const value = new Float64Array(dim);
        for (let c = 0; c < dim; c++) {
            let sum = row[c];
            if (k >= 1) sum -= (k === 2 ? 2 : 1) * w[1] * out[k - 1][c];
            if (k >= 2) sum -= w[2] * out[k - 2][c];
            value[c] = sum / w[0];
        }
        out.push(value);
    });
    return out;
}

function projectLattice(rows, dim) {
    const count = rows.s.length / (dim + 1), out = {};
    for (const name of Object.keys(rows)) out[name] = new Float64Array(count * dim);
    for (let k = 0; k < count; k++) {
        const from = k * (dim + 1), to = k * dim, w = name => rows[name][from + dim];
        for (let c = 0; c < dim; c++) {
            const x = name => rows[name][from + c], y = name => out[name][to + c], w0 = w('s');
            out.s[to + c] = x('s') / w0;
            if (!rows.u) continue;
            out.u[to + c] = (x('u') - w('u') * y('s')) / w0;
            out.v[to + c] = (x('v') - w('v') * y('s')) / w0;
            if (!rows.uu) continue;
            out.uu[to + c] = (x('uu') - 2 * w('u') * y('u') - w('uu') * y('s')) / w0;
            out.uv[to + c] = (x('uv') - w('u') * y('v') - w('v') * y('u') - w('uv') * y('s')) / w0;
            out.vv[to + c] = (x('vv') - 2 * w('v') * y('v') - w('vv') * y('s')) / w0;
        }
    }
    return out;
}

/** Unit normals [count x 3], mean and Gaussian curvature [count] of a lattice of derivatives up to order 2 (order 1: normals only). */
export function surfaceShape(d) {
    const count = d.s.length / 3, normal = new Float32Array(3 * count);
    const mean = d.uu ? new Float32Array(count) : null, gaussian = d.uu ? new Float32Array(count) : null;
    for (let k = 0; k < count; k++) {
        const i = 3 * k, ux = d.u[i], uy = d.u[i + 1], uz = d.u[i + 2], vx = d.v[i], vy = d.v[i + 1], vz = d.v[i + 2];
        let nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const size = Math.hypot(nx, ny, nz) || 1;
        normal[i] = nx /= size;
        normal[i + 1] = ny /= size;
        normal[i + 2] = nz /= size;
        if (!mean) continue;
        const E = ux * ux + uy * uy + uz * uz, F = ux * vx + uy * vy + uz * vz, G = vx * vx + vy * vy + vz * vz;
        const along = a => nx * a[i] + ny * a[i + 1] + nz * a[i + 2];
        const L = along(d.uu), M = along(d.uv), N = along(d.vv), area = E * G - F * F;
        mean[k] = area > 0 ? (E * N - 2 * F * M + G * L) / (2 * area) : NaN;
        gaussian[k] = area > 0 ? (L * N - M * M) / area : NaN;
    }
    return {normal, mean, gaussian};
}

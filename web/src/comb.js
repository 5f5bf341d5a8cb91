// The curvature comb: teeth along the curve, as long as the curvature, on the outer side.
import {samplesOf} from './spline.js';

const TEETH = 420;

/** Teeth of curves: root, direction (unit, away from the centre) and curvature, and the scale at which nineteen of twenty stay within a
 *  twelfth of `diagonal`; longer ones than a fifth are cut, else one leading edge would flatten all the rest. */
export function combOf(splines, diagonal) {
    const lines = splines.map(spline => {
        const parameters = samplesOf(spline.knots[0], spline.degree[0], spline.control[0], TEETH, TEETH);
        return Array.from(parameters, t => toothOf(...spline.curve(t, 2)));
    });
    const sizes = lines.flat().map(tooth => tooth.curvature).sort((a, b) => a - b);
    const usual = sizes[Math.floor((sizes.length - 1) * 0.95)] || sizes[sizes.length - 1];
    return {lines, scale: usual > 0 ? diagonal / (12 * usual) : 0, longest: diagonal / 5, largest: sizes[sizes.length - 1]};
}

function toothOf(root, first, second) {
    const dot = (a, b) => a.reduce((sum, x, c) => sum + x * b[c], 0);
    const speed = dot(first, first), along = dot(first, second);
    const bend = second ? Array.from(second, (x, c) => speed > 0 ? (x - first[c] * along / speed) / speed : 0) : [];
    const curvature = Math.sqrt(dot(bend, bend)) || 0;
    return {root, curvature, out: bend.map(x => curvature > 0 ? -x / curvature : 0)};
}

export function tipOf(tooth, comb, factor) {
    const length = Math.min(comb.scale * factor * tooth.curvature, comb.longest * Math.max(1, factor));
    return Array.from(tooth.root, (x, c) => x + length * (tooth.out[c] ?? 0));
}

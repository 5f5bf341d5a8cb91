// The curvature comb: teeth along the curve, as long as the curvature, on the outer side.
import {samplesOf} from './spline.js';

const TEETH = 640, USUAL = 0.93;

/** Teeth of curves: root, direction (unit, away from the centre) and curvature, and the scale at which the curvature that all but a
 *  fourteenth of the length stays within is a fourteenth of `diagonal`; teeth longer than a fifth are cut, else one leading edge would
 *  flatten all the rest. */
export function combOf(splines, diagonal) {
    const lines = splines.map(spline => Array.from(placesOf(spline), t => toothOf(...spline.curve(t, 2))));
    const weighed = lines.flatMap(line => line.map((tooth, i) => [tooth.curvature, distance(line[Math.max(0, i - 1)].root, line[Math.min(line.length - 1, i + 1)].root)]));
    weighed.sort((a, b) => a[0] - b[0]);
    const all = weighed.reduce((sum, [, length]) => sum + length, 0);
    let sum = 0;
    const usual = (weighed.find(([, length]) => (sum += length) >= USUAL * all) ?? weighed[weighed.length - 1])[0] || weighed[weighed.length - 1][0];
    return {lines, scale: usual > 0 ? diagonal / (14 * usual) : 0, longest: diagonal / 5};
}

const distance = (a, b) => Math.hypot(...Array.from(a, (x, c) => x - b[c]));

/** Parameters half spaced by length and half by parameter: long flat spans and short bent ones both get their teeth. */
function placesOf(spline) {
    const [low, high] = spline.domain[0], pilot = samplesOf(spline.knots[0], spline.degree[0], spline.control[0], 2 * TEETH, 8 * TEETH);
    const walked = [0];
    let before = spline.curve(pilot[0], 0)[0];
    for (let i = 1; i < pilot.length; i++) {
        const at = spline.curve(pilot[i], 0)[0];
        walked.push(walked[i - 1] + distance(at, before));
        before = at;
    }
    const total = walked[walked.length - 1] || 1, share = walked.map((length, i) => length / total / 2 + i / (pilot.length - 1) / 2), out = [low];
    for (let k = 1, i = 0; k < TEETH; k++) {
        const wanted = k / TEETH;
        while (share[i + 1] < wanted) i++;
        out.push(pilot[i] + (pilot[i + 1] - pilot[i]) * (wanted - share[i]) / (share[i + 1] - share[i]));
    }
    return [...out, high];
}

function toothOf(root, first, second) {
    const dot = (a, b) => a.reduce((sum, x, c) => sum + x * b[c], 0);
    const speed = dot(first, first), along = second ? dot(first, second) : 0;
    const bend = second ? Array.from(second, (x, c) => speed > 0 ? (x - first[c] * along / speed) / speed : 0) : [];
    const curvature = Math.sqrt(dot(bend, bend)) || 0;
    return {root, curvature, out: bend.map(x => curvature > 0 ? -x / curvature : 0)};
}

export function tipOf(tooth, comb, factor) {
    const length = Math.min(comb.scale * factor * tooth.curvature, comb.longest * Math.max(1, factor));
    return Array.from(tooth.root, (x, c) => x + length * (tooth.out[c] ?? 0));
}

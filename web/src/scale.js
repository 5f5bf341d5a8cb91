// Factors that make small things visible.

/** 1, 2 or 5 times a power of ten, not above x. */
export function niceBelow(x) {
    const power = 10 ** Math.floor(Math.log10(x)), digit = x / power;
    return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

/** The exaggeration that draws the largest deviation as a twentieth of the figure. */
export function barFactor(model) {
    const size = model.graph ? model.high[1] - model.low[1] : model.diagonal;
    return model.data && model.data.largest > 0 && size > 0 ? niceBelow(Math.max(1e-300, size / 16 / model.data.largest)) : 1;
}

/** The factor on heights that gives a flat surface a sixth of its width. */
export function heightFactor(model) {
    if (!model.space || !model.surface) return 1;
    const [x, y, z] = model.low.map((l, c) => model.high[c] - l), wide = Math.max(x, y);
    return z > 0 && z < 0.12 * wide ? niceBelow(0.3 * wide / z) : z > 4 * wide && wide > 0 ? wide / z : 1;
}

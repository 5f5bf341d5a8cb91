// Colour maps that are even to the eye: paths through Oklab (B. Ottosson, "A perceptual color space for image processing", 2020).

const gamma = c => c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;

function oklch(lightness, chroma, hue) {
    const a = chroma * Math.cos(hue * Math.PI / 180), b = chroma * Math.sin(hue * Math.PI / 180);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
    return [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s].map(c => gamma(Math.min(1, Math.max(0, c))));
}

const between = (a, b, t) => a + (b - a) * t;

/** From pale to dark: sizes from 0. */
const sequential = t => oklch(between(0.93, 0.36, t), between(0.05, 0.14, t) + 0.06 * Math.sin(Math.PI * t), between(100, -40, t));
/** Blue below, red above, pale in between: signed values. */
function diverging(t) {
    const side = Math.abs(2 * t - 1), eased = side ** 0.9;
    return oklch(between(0.95, 0.42, eased), 0.004 + 0.165 * Math.sin(eased * Math.PI * 0.62) , t < 0.5 ? between(235, 262, side) : between(62, 24, side));
}

export const SIZE = 256;
const table = path => Array.from({length: SIZE}, (_, i) => path(i / (SIZE - 1)));
export const maps = {sequential: table(sequential), diverging: table(diverging)};

const css = rgb => `rgb(${rgb.map(c => Math.round(255 * c)).join(' ')})`;

/** Colour of t in 0 .. 1 */
export function colour(map, t) {
    return css(maps[map][Math.min(SIZE - 1, Math.max(0, Math.round(t * (SIZE - 1))))]);
}

/** The map as a CSS gradient from left to right. */
export function gradient(map) {
    const stops = Array.from({length: 17}, (_, i) => `${css(maps[map][Math.round(i / 16 * (SIZE - 1))])} ${100 * i / 16}%`);
    return `linear-gradient(to right, ${stops.join(', ')})`;
}

/** Bytes of an RGBA texture of one row. */
export function texels(map) {
    return Uint8Array.from(maps[map].flatMap(rgb => [...rgb.map(c => Math.round(255 * c)), 255]));
}

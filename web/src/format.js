// Numbers and words as people read them.

const superscript = {'-': '\u207b', 0: '\u2070', 1: '\u00b9', 2: '\u00b2', 3: '\u00b3', 4: '\u2074', 5: '\u2075', 6: '\u2076', 7: '\u2077', 8: '\u2078', 9: '\u2079'};
const trueMinus = text => text.replace('-', '\u2212');
const grouped = digits => digits.replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f');

/** At most `digits` significant digits; a power of ten outside 1e-3 .. 1e6. */
export function number(value, digits = 3) {
    if (value === null || value === undefined || Number.isNaN(value)) return 'unknown';
    if (value === 0) return '0';
    const size = Math.abs(value);
    if (size >= 1e-3 && size < 1e6) {
        const text = String(Number(value.toPrecision(Math.max(digits, Math.min(15, Math.floor(Math.log10(size)) + 1)))));
        const [whole, rest] = text.split('.');
        return trueMinus(Math.abs(Number(whole)) >= 10000 ? grouped(whole) : whole) + (rest ? '.' + rest : '');
    }
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    const power = [...String(Number(exponent))].map(c => superscript[c]).join('');
    return `${trueMinus(String(Number(mantissa)))}\u2009\u00d7\u200910${power}`;
}

export const count = value => value >= 10000 ? grouped(String(value)) : String(value);

/** "1 point", "12 345 points" */
export const counted = (value, noun, plural = noun + 's') => `${count(value)}\u00a0${value === 1 ? noun : plural}`;

/** Digits enough to tell points apart that are `range` apart at most. */
export function coordinate(value, range) {
    const decimals = Math.max(0, Math.min(12, 4 - Math.floor(Math.log10(range || 1))));
    return trueMinus(value.toFixed(decimals));
}

export function seconds(value) {
    if (value < 1e-3) return `${number(value * 1e6, 2)}\u00a0\u00b5s`;
    if (value < 1) return `${number(value * 1e3, 2)}\u00a0ms`;
    return value < 120 ? `${number(value, 2)}\u00a0s` : `${number(value / 60, 2)}\u00a0min`;
}

/** Positions of axis ticks: multiples of 1, 2 or 5 times a power of ten, about `wanted` of them between low and high. */
export function ticks(low, high, wanted) {
    const rough = (high - low) / Math.max(1, wanted);
    if (!(rough > 0)) return [low];
    const power = 10 ** Math.floor(Math.log10(rough)), step = power * [1, 2, 5, 10].find(f => f * power >= rough * 0.999);
    const out = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) out.push(Number((k * step).toPrecision(12)));
    return out;
}

/** One label for each tick, all with as many decimals. */
export function tickLabels(values) {
    const step = values.length > 1 ? Math.abs(values[1] - values[0]) : Math.abs(values[0]) || 1;
    const most = Math.max(...values.map(Math.abs));
    if (most >= 1e6 || step < 1e-4) return values.map(v => number(v, Math.max(2, Math.ceil(Math.log10(most / step)) + 1)));
    const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    return values.map(v => {
        const [whole, rest] = trueMinus(v.toFixed(decimals)).split('.');
        return (whole.length > 5 ? grouped(whole) : whole) + (rest ? '.' + rest : '');
    });
}

// Packed lattices of numbers: the inverse of src/report/page_pack.c, whose header describes the layout.

/** @typedef {{at: number, size: [number, number, number], planes: number, bits: number, follows?: boolean, low: number[], step: number[]}} Packed */
/** @typedef {{rows: number, columns: number, components: number, values: Float64Array, codes: Uint32Array}} Lattice values are
 *  row-major with the components together; NaN where there is no number. */

function undoPrediction(codes, begin, rows, columns, last) {
    for (let i = 0, k = begin; i < rows; i++)
        for (let j = 0; j < columns; j++, k++) {
            const left = j > 0 ? codes[k - 1] : 0;
            const up = i > 0 ? codes[k - columns] : 0;
            const corner = i > 0 && j > 0 ? codes[k - columns - 1] : 0;
            const folded = codes[k];
            codes[k] = left + up - corner + ((folded >>> 1) ^ -(folded & 1));
        }
    if (last) for (let k = begin; k < begin + rows * columns; k++) codes[k] += last[k];
}

/** @param {Uint8Array} bytes @param {Packed} packed @param {Lattice} [last] the lattice before it, where it follows one */
export function unpack(bytes, packed, last) {
    const [rows, columns, components] = packed.size;
    const count = rows * columns;
    const codes = new Uint32Array(count * components);
    let at = packed.at;
    for (let c = 0; c < components; c++) {
        for (let plane = 0; plane < packed.planes; plane++)
            for (let k = 0; k < count; k++) codes[c * count + k] |= bytes[at++] << (8 * plane);
        undoPrediction(codes, c * count, rows, columns, packed.follows ? last.codes : null);
    }
    const none = 2 ** packed.bits - 1;
    const values = new Float64Array(codes.length);
    for (let c = 0; c < components; c++)
        for (let k = 0; k < count; k++) {
            const code = codes[c * count + k];
            values[k * components + c] = code === none ? NaN : packed.low[c] + packed.step[c] * code;
        }
    return {rows, columns, components, values, codes};
}

// One material for all views of a surface: shading, zebra stripes, isophotes, and values through a colour map. Two states are blended.
import {CanvasTexture, DataTexture, DoubleSide, LinearFilter, ShaderMaterial, Vector3} from 'three';
import {SIZE, texels} from './colours.js';

export const MODES = {shaded: 0, zebra: 1, isophotes: 2, deviation: 3, gaussian: 3, mean: 3};
/** Values beyond this are none. */
export const NO_VALUE = 9;

const vertexShader = `
attribute vec3 laterPosition, laterNormal;
attribute float value, laterValue;
attribute vec2 place;
uniform float blend;
varying vec3 vNormal, vEye;
varying vec2 vPlace;
varying float vValue;
void main() {
    vPlace = place;
    vec4 eye = modelViewMatrix * vec4(mix(position, laterPosition, blend), 1.0);
    vNormal = normalMatrix * mix(normal, laterNormal, blend);
    vEye = eye.xyz;
    vValue = mix(value, laterValue, blend);
    gl_Position = projectionMatrix * eye;
}`;

// The zebra is what a polished surface would show of a room of parallel light strips that stands still about the viewer; isophotes are
// lines of equal brightness. Both break where the normal does: two derivatives less than the eye sees in shading.
const fragmentShader = `
uniform int mode;
uniform sampler2D map, mask;
uniform vec3 base, light;
uniform float stripes, steps;
varying vec3 vNormal, vEye;
varying vec2 vPlace;
varying float vValue;
float smoothBands(float x) {
    float width = fwidth(x);
    float triangle = abs(fract(x) - 0.5) * 2.0 - 0.5;
    return smoothstep(-width, width, triangle) ;
}
void main() {
    if (texture2D(mask, vPlace).r < 0.5) discard;
    vec3 n = normalize(vNormal), toEye = normalize(-vEye);
    if (dot(n, toEye) < 0.0) n = -n;
    float diffuse = max(dot(n, light), 0.0), fill = max(dot(n, normalize(vec3(-0.7, -0.2, 0.6))), 0.0);
    float shine = pow(max(dot(reflect(-light, n), toEye), 0.0), 28.0);
    float lit = 0.34 + 0.56 * diffuse + 0.16 * fill;
    vec3 colour = base * lit + 0.16 * shine;
    if (mode == 1) {
        vec3 r = reflect(-toEye, n);
        float stripe = smoothBands(stripes * acos(clamp(r.y, -1.0, 1.0)) / 3.14159265);
        colour = mix(vec3(0.07, 0.08, 0.10), vec3(0.97), stripe) * (0.80 + 0.2 * lit);
    } else if (mode == 2) {
        float band = smoothBands(stripes * dot(n, light));
        colour = mix(base * 0.42, base * 1.06, band) * (0.86 + 0.16 * fill);
    } else if (mode == 3) {
        if (vValue > 1.5) {
            colour = vec3(0.55) * lit + 0.12 * step(0.5, fract((gl_FragCoord.x + gl_FragCoord.y) / 9.0));
        } else {
            float at = clamp(0.5 + 0.5 * vValue, 0.0, 1.0);
            float x = at * steps, width = fwidth(x);
            float line = width > 0.3 || abs(at - 0.5) < 0.8 / steps ? 0.0 : 1.0 - smoothstep(0.0, 1.3 * width, abs(fract(x + 0.5) - 0.5));
            colour = texture2D(map, vec2(0.5 / ${SIZE}.0 + at * ${SIZE - 1}.0 / ${SIZE}.0, 0.5)).rgb;
            colour = colour * (0.72 + 0.30 * lit) * (1.0 - 0.28 * line);
        }
    }
    gl_FragColor = vec4(colour, 1.0);
}`;

export function mapTexture(name) {
    const texture = new DataTexture(texels(name), SIZE, 1);
    texture.minFilter = texture.magFilter = LinearFilter;
    texture.needsUpdate = true;
    return texture;
}

const MASK_SIZE = 1024;

/** What a trimmed surface keeps, over the unit square: loops are closed polylines there. Without loops, all of it. */
export function maskTexture(loops) {
    const canvas = document.createElement('canvas'), size = loops.length ? MASK_SIZE : 1, context = canvas.getContext('2d');
    canvas.width = canvas.height = size;
    context.fillRect(0, 0, size, size);
    context.fillStyle = '#fff';
    context.beginPath();
    for (const loop of loops) loop.forEach(([u, v], i) => i ? context.lineTo(u * size, (1 - v) * size) : context.moveTo(u * size, (1 - v) * size));
    if (!loops.length) context.rect(0, 0, size, size);
    context.fill('evenodd');
    return new CanvasTexture(canvas);
}

export function surfaceMaterial(map, mask) {
    return new ShaderMaterial({
        vertexShader, fragmentShader, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
        uniforms: {blend: {value: 0}, mode: {value: 0}, map: {value: map}, mask: {value: mask}, base: {value: new Vector3(0.62, 0.68, 0.76)},
            light: {value: new Vector3(0.35, 0.62, 0.70).normalize()}, stripes: {value: 14}, steps: {value: 20}}});
}

const pointVertex = `
attribute float value;
uniform float size, nearer;
varying float vValue;
void main() {
    vValue = value;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_Position.z -= nearer * gl_Position.w;
    gl_PointSize = size;
}`;

const pointFragment = `
uniform sampler2D map;
uniform vec3 plain, rim;
uniform float mapped, size, edge;
varying float vValue;
void main() {
    float r = length(gl_PointCoord - 0.5) * 2.0, soft = 2.0 / size;
    if (r > 1.0) discard;
    vec3 inner = mapped > 0.5 ? texture2D(map, vec2(clamp(0.5 + 0.5 * vValue, 0.002, 0.998), 0.5)).rgb : plain;
    gl_FragColor = vec4(mix(inner, rim, smoothstep(1.0 - 3.2 / size - soft, 1.0 - 3.2 / size, r) * edge), 1.0);
}`;

/** Round points with a rim, whose strength is `edge`, drawn a little nearer than they are, so that the surface they lie on does not swallow half of them. */
export function pointMaterial(map, size, plain, rim, mapped, edge) {
    return new ShaderMaterial({
        vertexShader: pointVertex, fragmentShader: pointFragment,
        uniforms: {map: {value: map}, size: {value: size}, nearer: {value: 0.002}, plain: {value: plain}, rim: {value: rim}, mapped: {value: mapped ? 1 : 0}, edge: {value: edge}}});
}

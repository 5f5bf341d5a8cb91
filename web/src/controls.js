// The panel beside the figure: views, layers, scales. And the legend over it.
import {gradient} from './colours.js';
import {make} from './dom.js';
import {number} from './format.js';
import {barFactor, heightFactor} from './scale.js';
import {cornersOf} from './plane_view.js';
import {controlCount} from './words.js';

const MODE_NAMES = {shaded: 'Shaded', deviation: 'Deviation', zebra: 'Zebra', isophotes: 'Isophotes', gaussian: 'Gaussian curvature', mean: 'Mean curvature'};

/** Layers that this model has: [name, label]. */
export function layersOf(model) {
    const {head, data, surface} = model, out = [];
    if (data) out.push(['points', 'Data points']);
    out.push(['control', surface ? 'Control net' : 'Control polygon'], ['knots', surface ? 'Knot lines' : 'Knots']);
    if (surface) out.push(['edges', 'Boundary']);
    else out.push(['comb', 'Curvature comb']);
    if (data && !surface) out.push(['bars', 'Deviation bars']);
    if (!surface && cornersOf(model).length) out.push(['corners', 'Corners']);
    if (head.met.length || head.constraint_points.length) out.push(['met', 'Points met exactly']);
    if (head.unsupported.length) out.push(['unsupported', 'Unsupported control points']);
    return out;
}

export function defaultsOf(model) {
    const {data, surface} = model, show = layersOf(model).map(([name]) => name)
        .filter(name => !['comb', 'bars'].includes(name) && !(controlCount(model) > 150 && ['control', 'knots'].includes(name)) && !(surface && ['control', 'knots'].includes(name)) && !(surface && name === 'points' && data.shown > 2500));
    return {theme: 'auto', mode: surface && data && data.largest > 0 ? 'deviation' : 'shaded', show, comb: 1, bars: 1, height: 1, frame: null, row: null, view: ''};
}

function slider(label, state, key, range, write) {
    const out = make('output', {'aria-live': 'off'}), input = make('input', {type: 'range', min: -range, max: range, step: 0.05, id: `scale-${key}`,
        oninput: () => state.set({[key]: Number((10 ** Number(input.value)).toPrecision(3))}, 'controls')});
    const show = () => {
        input.value = Math.log10(state.values[key]);
        out.textContent = write(state.values[key]);
        input.setAttribute('aria-valuetext', out.textContent);
    };
    show();
    return {element: make('div', {class: 'scale'}, make('label', {for: `scale-${key}`}, label), out, input), show};
}

export function controls(model, state, element, view) {
    const parts = [], updates = [];
    if (model.surface) {
        const inputs = Object.entries(MODE_NAMES).filter(([mode]) => mode !== 'deviation' || model.data).map(([mode, name]) => {
            const input = make('input', {type: 'radio', name: 'mode', value: mode, onchange: () => state.set({mode}, 'controls')});
            updates.push(() => { input.checked = state.values.mode === mode; });
            return make('label', {class: 'choice'}, input, make('span', {}, name));
        });
        parts.push(make('fieldset', {class: 'modes'}, make('legend', {}, 'Surface'), ...inputs));
    }
    const layers = layersOf(model).map(([name, label]) => {
        const input = make('input', {type: 'checkbox', onchange: () => state.toggle(name, input.checked)});
        updates.push(() => { input.checked = state.shows(name); });
        return make('label', {class: `layer ${name}`}, input, make('i', {'aria-hidden': 'true'}), make('span', {}, label));
    });
    parts.push(make('fieldset', {class: 'layers'}, make('legend', {}, 'Show'), ...layers));
    const scales = [];
    const add = (layer, ...args) => {
        const scale = slider(...args);
        updates.push(() => { scale.show(); scale.element.hidden = layer !== null && !state.shows(layer); });
        scales.push(scale.element);
    };
    if (!model.surface) add('comb', 'Comb length', state, 'comb', 1.3, v => `\u00d7\u2009${number(v, 2)}`);
    if (model.data && !model.surface) add('bars', 'Bars exaggerated', state, 'bars', 2, v => `\u00d7\u2009${number(v * barFactor(model), 2)}`);
    if (model.space && model.surface) add(null, 'Heights drawn', state, 'height', 1, v => `\u00d7\u2009${number(v * heightFactor(model), 2)}`);
    const group = make('fieldset', {class: 'scales'}, make('legend', {}, 'Scale'), ...scales);
    updates.push(() => { group.hidden = scales.every(scale => scale.hidden); });
    if (scales.length) parts.push(group);
    const button = (text, label, act) => make('button', {type: 'button', 'aria-label': label, onclick: act}, text);
    parts.push(make('div', {class: 'camera'}, button('\u2212', 'Zoom out', () => view.act('out')), button('+', 'Zoom in', () => view.act('in')), button('Show all', 'Show all', () => view.act('all')),
        ...(model.data ? [button('Farthest point', 'Go to the farthest point', () => view.act('worst'))] : [])));
    element.append(...parts);
    const update = event => event?.source === 'replay' || updates.forEach(f => f());
    state.addEventListener('change', update);
    update();
}

/** A scale of colours with its numbers. */
function scaleLegend(title, map, low, middle, high) {
    return make('div', {class: 'colours'}, make('p', {}, title), make('div', {class: 'bar', style: `background: ${gradient(map)}`}),
        make('div', {class: 'ends'}, make('span', {}, low), make('span', {}, middle), make('span', {}, high)));
}

export function legend(model, state, element, view) {
    const update = event => {
        const {mode} = state.values, parts = [];
        if (event?.source === 'replay') return;
        const signed = (title, range, digits = 3) => parts.push(scaleLegend(title, 'diverging', number(-range, digits), '0', number(range, digits)));
        if (model.surface && mode === 'deviation') signed('Deviation, units of the data', view.range('deviation'));
        else if (model.surface && mode === 'gaussian') signed('Gaussian curvature, 1/unit\u00b2', view.range('gaussian'));
        else if (model.surface && mode === 'mean') signed('Mean curvature, 1/unit', view.range('mean'));
        else if (model.data && state.shows('points') && model.data.largest > 0) {
            if (model.surface && model.data.sides) signed('Deviation of points', model.data.largest);
            else parts.push(scaleLegend('Deviation of points', 'sequential', '0', number(model.data.largest / 2), number(model.data.largest)));
        }
        element.replaceChildren(...parts);
        element.hidden = !parts.length;
    };
    state.addEventListener('change', update);
    update();
}

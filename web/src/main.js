// Puts the page together.
import {convergence, histogram} from './charts.js';
import {controls, defaultsOf, legend} from './controls.js';
import {make} from './dom.js';
import {coordinate, number} from './format.js';
import {gestures} from './gestures.js';
import {load} from './model.js';
import {PlaneView} from './plane_view.js';
import {replay} from './replay.js';
import {SpaceView} from './space_view.js';
import {State} from './state.js';
import {keys, reproduce, settings} from './tables.js';
import {baseName, keyFigures, rowName, sentences, verdict, warnings} from './words.js';

const byId = id => document.getElementById(id);

async function copy(text, button) {
    const label = button.textContent;
    try {
        await navigator.clipboard.writeText(text);
        button.textContent = 'Copied';
    } catch {
        button.textContent = 'Select and copy by hand';
    }
    setTimeout(() => { button.textContent = label; }, 1600);
}

function summary(model) {
    const {tone, text} = verdict(model), lines = warnings(model);
    byId('title').textContent = model.head.title ?? baseName(model.head.source) ?? 'Model';
    byId('verdict').textContent = text;
    byId('verdict').dataset.tone = tone;
    sentences(model).forEach((line, i) => byId('words').append(make('p', {class: i ? null : 'first'}, line)));
    byId('warnings').hidden = !lines.length;
    byId('warnings').append(...lines.map(line => make('li', {}, line)));
    byId('key-figures').append(...keyFigures(model).map(([name, value, note]) => make('div', {}, make('dt', {}, name), make('dd', {}, value), note ? make('dd', {class: 'note'}, note) : '')));
    byId('made').textContent = `pia ${model.head.version}`;
    byId('footer').textContent = `Made by pia ${model.head.version}. This file holds model, points and program; it asks nothing of the network.`;
}

function theme(state) {
    const button = byId('theme'), names = {auto: 'Theme: as the system', light: 'Theme: light', dark: 'Theme: dark'}, next = {auto: 'light', light: 'dark', dark: 'auto'};
    const update = event => {
        const {theme} = state.values;
        if (event?.source === 'replay') return;
        button.textContent = names[theme] ?? names.auto;
        if (theme === 'auto') delete document.documentElement.dataset.theme;
        else document.documentElement.dataset.theme = theme;
    };
    button.addEventListener('click', () => state.set({theme: next[state.values.theme] ?? 'auto'}, 'theme'));
    state.addEventListener('change', update);
    update();
}

function readout(model, state, hovered) {
    const {data, dim} = model, i = hovered >= 0 ? hovered : state.point(), element = byId('readout');
    const show = text => { if (element.textContent !== text) element.textContent = text; };
    if (!data || i < 0) { show(''); return; }
    const names = ['x', 'y', 'z'], at = Array.from({length: dim}, (_, c) => `${names[c]} ${coordinate(data.position[i * dim + c], model.diagonal)}`);
    const frame = Math.max(0, Math.round(state.frame())), deviation = model.deviations(frame)[i];
    const name = rowName(model, i);
    show(`${name[0].toUpperCase()}${name.slice(1)} \u00b7 ${at.join('  ')} \u00b7 deviation ${number(data.sides ? deviation : Math.abs(deviation), 4)}`);
}

/** The view of the figure with everything that moves it. */
class Figure {
    constructor(model, state) {
        Object.assign(this, {model, state, hovered: -1, drawn: 0, waiting: false});
        const element = byId('canvas');
        this.element = element;
        this.view = model.space ? new SpaceView(element, model, state) : new PlaneView(element, model, state);
        element.setAttribute('aria-label', model.space ? 'The model in space' : 'The curve');
        new ResizeObserver(() => this.resize()).observe(element);
        matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.redraw());
        this.resize();
        this.view.camera = state.values.view;
        state.addEventListener('change', event => {
            if (event.source === null) this.view.camera = state.values.view;
            this.redraw();
        });
        gestures(element, {
            turn: (dx, dy) => this.moved(() => this.view.turn(dx, dy)), move: (dx, dy) => this.moved(() => this.view.move(dx, dy)),
            zoom: (factor, x, y) => this.moved(() => this.view.zoomAt(factor, x, y)), hover: (x, y) => this.hover(this.view.pick(x, y)),
            tap: (x, y) => this.choose(this.view.pick(x, y, 24)), key: key => this.key(key)});
        element.addEventListener('pointerleave', () => this.hover(-1));
        addEventListener('beforeprint', () => this.view.draw());
    }

    resize() {
        const box = this.element.getBoundingClientRect();
        if (!box.width || !box.height) return;
        this.view.resize(box.width, box.height);
        this.redraw();
    }

    redraw() {
        if (this.waiting) return;
        this.waiting = true;
        requestAnimationFrame(() => {
            this.waiting = false;
            this.view.draw();
            this.drawn++;
            readout(this.model, this.state, this.hovered);
            document.documentElement.dataset.drawn = this.drawn;
        });
    }

    moved(act) {
        act();
        this.state.set({view: this.view.camera}, 'camera');
    }

    hover(i) {
        if (i === this.hovered) return;
        this.hovered = i;
        readout(this.model, this.state, i);
        this.element.style.cursor = i >= 0 ? 'pointer' : '';
    }

    choose(i) {
        if (i >= 0) this.view.reveal(i);
        this.state.set({row: i < 0 ? null : this.model.data.row[i], view: this.view.camera}, 'point');
    }

    range(mode) {
        return this.view.range(mode);
    }

    act(name) {
        const acts = {in: () => this.view.zoomAt(1.35), out: () => this.view.zoomAt(1 / 1.35), all: () => this.view.reset()};
        if (name === 'worst') this.choose(this.model.data.farthest);
        else this.moved(acts[name]);
    }

    key(key) {
        const {data} = this.model, step = d => data && this.choose((this.state.point() + d + data.shown) % data.shown);
        const acts = {'+': () => this.act('in'), '=': () => this.act('in'), '-': () => this.act('out'), 0: () => this.act('all'), '.': () => step(1), ',': () => step(this.state.point() < 0 ? 0 : -1),
            w: () => data && this.act('worst'), Escape: () => this.choose(-1), ' ': () => this.replay?.toggle(), '[': () => this.replay?.previous(), ']': () => this.replay?.next()};
        const act = acts[key] ?? acts[key.toLowerCase()];
        act?.();
        return Boolean(act);
    }
}

function figure(model, state) {
    try {
        return new Figure(model, state);
    } catch (error) {
        byId('canvas').append(make('p', {class: 'fatal'}, `The view in space cannot be drawn: ${error.message}. The numbers below hold all the same.`));
        return null;
    }
}

async function start() {
    const model = await load(), state = new State(defaultsOf(model), model);
    theme(state);
    summary(model);
    document.querySelector('[data-skip]').addEventListener('click', event => { event.preventDefault(); byId('canvas').focus(); });
    byId('copy-link').addEventListener('click', event => { state.write(); copy(location.href, event.target); });
    const chart = convergence(model, byId('convergence')), shown = figure(model, state);
    histogram(model, byId('histogram'));
    reproduce(model, byId('reproduce'), copy);
    settings(model, byId('settings'));
    keys(model, byId('keys'));
    if (shown) {
        controls(model, state, byId('controls'), shown);
        legend(model, state, byId('legend'), shown);
        shown.replay = replay(model, state, byId('replay'), at => model.figures.length === 1 && chart?.mark(at.iteration, at.maxError),
            pace => { shown.view.keepPace(pace); shown.redraw(); });
    }
    document.documentElement.dataset.ready = Math.round(performance.now());
}

start().catch(error => {
    document.querySelector('main').prepend(make('p', {class: 'fatal'}, `The report cannot be shown: ${error.message}`));
    throw error;
});

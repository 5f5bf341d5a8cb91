// Surfaces and space curves in three dimensions.
import {BufferAttribute, BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, LinearSRGBColorSpace, Mesh, PerspectiveCamera, Points, Scene,
    Vector3, WebGLRenderer, ColorManagement} from 'three';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {LineSegments2} from 'three/addons/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/addons/lines/LineSegmentsGeometry.js';
import {combOf, tipOf} from './comb.js';
import {bilinear, frameOf, normalsOf} from './model.js';
import {palette} from './palette.js';
import {barFactor, heightFactor} from './scale.js';
import {MODES, NO_VALUE, mapTexture, maskTexture, pointMaterial, surfaceMaterial} from './shader.js';
import {samplesOf, surfaceShape} from './spline.js';
import {tickLabels, ticks} from './format.js';
import {cornersOf} from './plane_view.js';

ColorManagement.enabled = false; // colours are written as they are to be seen

const FINE = 200, MOST_FINE = 256, FIELD = 28, LINE_STEPS = 160, MOST_LINES = 90, SLOW = 36;
const HOME = {azimuth: -55, elevation: 32, distance: 1};

/** The vertices of a loop and points between them: a side that is straight in the parameter plane is a curve in space. */
function refined(loop, domain) {
    return loop.flatMap((a, i) => {
        const b = loop[(i + 1) % loop.length];
        const steps = Math.max(1, ...[0, 1].map(d => Math.ceil(LINE_STEPS * Math.abs(b[d] - a[d]) / (domain[d][1] - domain[d][0]))));
        return Array.from({length: steps}, (_, k) => [0, 1].map(d => a[d] + (b[d] - a[d]) * k / steps));
    });
}

export class SpaceView {
    constructor(element, model, state) {
        Object.assign(this, {element, model, state});
        this.renderer = new WebGLRenderer({antialias: true, alpha: true});
        this.renderer.outputColorSpace = LinearSRGBColorSpace;
        element.append(this.renderer.domElement);
        this.labels = document.createElement('div');
        this.labels.className = 'axis-labels';
        this.labels.setAttribute('aria-hidden', 'true');
        element.append(this.labels);
        this.scene = new Scene();
        this.group = new Group();
        this.scene.add(this.group);
        this.eye = new PerspectiveCamera(FIELD, 1, 0.01, 100);
        this.eye.up.set(0, 0, 1);
        this.look = {...HOME, target: new Vector3()};
        this.map = mapTexture('diverging');
        this.sizeMap = mapTexture('sequential');
        this.surfaces = model.figures.filter(f => f.surface).map(figure => this.buildSurface(figure));
        this.layers = {};
        this.built = null;
    }

    // ---- Coordinates: data are moved to their centre and scaled to a unit ball, heights by the factor asked. ----

    arrange() {
        const {low, high} = this.model, height = this.state.values.height * heightFactor(this.model);
        const size = [0, 1, 2].map(c => (high[c] - low[c]) * (c === 2 ? height : 1));
        this.unit = 2 / (Math.hypot(...size) || 1);
        this.stretch = [1, 1, height];
        this.middle = [0, 1, 2].map(c => (low[c] + high[c]) / 2);
        this.group.scale.set(this.unit, this.unit, this.unit * height);
    }

    /** Positions relative to the middle, in single precision. */
    relative(values) {
        const out = new Float32Array(values.length);
        for (let k = 0; k < values.length; k++) out[k] = values[k] - this.centre(k % 3);
        return out;
    }

    centre(c) {
        return (this.model.low[c] + this.model.high[c]) / 2;
    }

    // ---- Surfaces ----

    buildSurface(figure) {
        const unit = ([u, v]) => [u, v].map((t, d) => (t - figure.spline.domain[d][0]) / (figure.spline.domain[d][1] - figure.spline.domain[d][0]));
        const material = surfaceMaterial(this.map, maskTexture(figure.trim.map(loop => loop.map(unit)))), entry = {figure, material, fine: null, coarse: null, frame: -1};
        const us = samplesOf(figure.spline.knots[0], figure.spline.degree[0], figure.spline.control[0], FINE, MOST_FINE);
        const vs = samplesOf(figure.spline.knots[1], figure.spline.degree[1], figure.spline.control[1], FINE, MOST_FINE);
        const rows = figure.spline.lattice(us, vs, 1);
        entry.fine = this.meshOf(us, vs, this.relative(rows.s), surfaceShape(rows).normal, material);
        entry.nodes = [us, vs];
        this.group.add(entry.fine);
        return entry;
    }

    /** Mean and Gaussian curvature of the vertices, computed when they are first asked for. */
    curvatures(entry) {
        return entry.curvatures ??= surfaceShape(entry.figure.spline.lattice(...entry.nodes, 2));
    }

    meshOf(us, vs, position, normal, material) {
        const geometry = new BufferGeometry(), index = new Uint32Array(6 * (us.length - 1) * (vs.length - 1));
        let at = 0;
        for (let i = 0; i + 1 < us.length; i++)
            for (let j = 0; j + 1 < vs.length; j++) {
                const a = i * vs.length + j, b = a + vs.length;
                index.set([a, b, a + 1, a + 1, b, b + 1], at);
                at += 6;
            }
        geometry.setIndex(new BufferAttribute(index, 1));
        for (const name of ['position', 'laterPosition']) geometry.setAttribute(name, new BufferAttribute(position, 3));
        for (const name of ['normal', 'laterNormal']) geometry.setAttribute(name, new BufferAttribute(normal, 3));
        const none = new BufferAttribute(new Float32Array(us.length * vs.length), 1), place = new Float32Array(2 * us.length * vs.length);
        const share = (nodes, i) => (nodes[i] - nodes[0]) / (nodes[nodes.length - 1] - nodes[0]);
        for (let i = 0, k = 0; i < us.length; i++) for (let j = 0; j < vs.length; j++, k += 2) place.set([share(us, i), share(vs, j)], k);
        geometry.setAttribute('place', new BufferAttribute(place, 2));
        for (const name of ['value', 'laterValue']) geometry.setAttribute(name, none);
        const mesh = new Mesh(geometry, material);
        mesh.frustumCulled = false;
        return mesh;
    }

    /** Range of a mode's values: the same above and below 0; of curvatures, what 98 of 100 vertices stay within. */
    range(mode) {
        if (mode === 'deviation') return this.model.data ? this.model.data.largest || 1 : 1;
        this.ranges ??= {};
        if (!this.ranges[mode]) {
            const all = Float32Array.from(this.surfaces.flatMap(s => Array.from(this.curvatures(s)[mode])).filter(Number.isFinite), Math.abs).sort();
            this.ranges[mode] = all[Math.floor((all.length - 1) * 0.98)] || 1;
        }
        return this.ranges[mode];
    }

    /** The deviations of a map at nodes, over the range. */
    mapped(figure, nodes) {
        const out = new Float32Array(nodes[0].length * nodes[1].length).fill(NO_VALUE);
        const map = this.model.data?.maps[this.model.figures.indexOf(figure)], range = this.range('deviation');
        if (!map) return out;
        const grid = [map.rows, map.columns].map((n, d) => {
            const [low, high] = figure.spline.domain[d];
            return Float64Array.from({length: n}, (_, i) => low + (high - low) * i / (n - 1));
        });
        const value = [0];
        for (let i = 0, k = 0; i < nodes[0].length; i++)
            for (let j = 0; j < nodes[1].length; j++, k++) {
                bilinear(grid, map.values, 1, nodes[0][i], nodes[1][j], value, 0);
                out[k] = Number.isNaN(value[0]) ? NO_VALUE : value[0] / range;
            }
        return out;
    }

    fineValues(entry, mode) {
        if (mode === 'deviation') return entry.deviation ??= this.mapped(entry.figure, entry.nodes);
        const range = this.range(mode);
        return Float32Array.from(this.curvatures(entry)[mode], v => Number.isFinite(v) ? v / range : NO_VALUE);
    }

    /** A frame on the nodes of the replay: positions, normals by differences, and deviations moved by the way to the end along them. */
    frameState(entry, k) {
        entry.states ??= new Map();
        if (entry.states.has(k)) return entry.states.get(k);
        const {figure} = entry, {nodes} = figure.replay, end = figure.frames.length - 1;
        const values = figure.replay.positions(k), position = this.relative(values), normal = normalsOf(position, nodes[0].length, nodes[1].length);
        const value = Float32Array.from(entry.coarseMap ??= this.mapped(figure, nodes)), final = figure.replay.positions(end), range = this.range('deviation');
        for (let i = 0; i < value.length; i++) {
            if (value[i] === NO_VALUE) continue;
            let along = 0;
            for (let c = 0; c < 3; c++) along += (final[3 * i + c] - values[3 * i + c]) * normal[3 * i + c];
            value[i] = Math.max(-1.2, Math.min(1.2, value[i] + along / range));
        }
        const state = {position: new BufferAttribute(position, 3), normal: new BufferAttribute(normal, 3), value: new BufferAttribute(value, 1)};
        entry.states.set(k, state);
        return state;
    }

    showFrame(entry, frame) {
        const {figure} = entry, end = this.model.frameCount - 1, replaying = frame < end && figure.frames.length > 1;
        entry.fine.visible = !replaying;
        if (entry.coarse) entry.coarse.visible = replaying;
        if (!replaying) return;
        const nodes = figure.replay.nodes;
        if (!entry.coarse) {
            const first = this.frameState(entry, 0);
            entry.coarse = this.meshOf(nodes[0], nodes[1], first.position.array, first.normal.array, entry.material);
            this.group.add(entry.coarse);
        }
        const k = Math.floor(frame), own = frameOf(this.model, figure, k), next = frameOf(this.model, figure, k + 1);
        if (entry.frame !== own) {
            const a = this.frameState(entry, own), b = this.frameState(entry, next), geometry = entry.coarse.geometry;
            for (const [name, key] of [['position', 'position'], ['normal', 'normal'], ['value', 'value']]) {
                geometry.setAttribute(name, a[key]);
                geometry.setAttribute('later' + name[0].toUpperCase() + name.slice(1), b[key]);
            }
            entry.frame = own;
        }
        entry.material.uniforms.blend.value = frame - k;
    }

    updateSurfaces(frame) {
        const {mode} = this.state.values;
        for (const entry of this.surfaces) {
            entry.material.uniforms.mode.value = MODES[mode] ?? 0;
            const still = frame >= this.model.frameCount - 1;
            if (still) entry.material.uniforms.blend.value = 0;
            this.showFrame(entry, frame);
            if (still && MODES[mode] === 3 && entry.mode !== mode) {
                const attribute = new BufferAttribute(this.fineValues(entry, mode), 1);
                entry.fine.geometry.setAttribute('value', attribute);
                entry.fine.geometry.setAttribute('laterValue', attribute);
                entry.mode = mode;
            }
            if (!still && (mode === 'gaussian' || mode === 'mean')) entry.material.uniforms.mode.value = 0;
        }
    }

    // ---- Lines and points, rebuilt when what they show changes ----

    /** Segments between pairs of positions [2 n x 3]. */
    segments(values, colour, width) {
        const position = this.relative(values);
        if (width <= 1) {
            const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(position, 3));
            return new LineSegments(geometry, new LineBasicMaterial({color: new Color(colour), transparent: true, opacity: 0.75}));
        }
        const line = new LineSegments2(new LineSegmentsGeometry().setPositions(position), new LineMaterial({color: new Color(colour), linewidth: width}));
        line.frustumCulled = false;
        return line;
    }

    dots(values, size, colour, deviations = null, map = this.map, rimColour = this.colours.ink) {
        const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(this.relative(values), 3));
        const range = this.range('deviation');
        geometry.setAttribute('value', new BufferAttribute(Float32Array.from({length: values.length / 3}, (_, i) => deviations ? deviations[i] / range : 0), 1));
        const rgb = new Color(colour), rim = new Color(rimColour), ratio = this.renderer.getPixelRatio();
        const points = new Points(geometry, pointMaterial(map, size * ratio, new Vector3(rgb.r, rgb.g, rgb.b), new Vector3(rim.r, rim.g, rim.b), deviations !== null, size < 7 ? 0.3 : 0.85));
        points.frustumCulled = false;
        return points;
    }

    splines(frame) {
        return this.model.figures.map(figure => [figure.frames[frameOf(this.model, figure, frame)] ?? figure, figure]);
    }

    controlSegments(frame) {
        const out = [];
        for (const [{spline, exact}] of this.splines(frame)) {
            if (exact === false) continue;
            const [rows, columns = 1] = spline.control, at = (i, j) => spline.points.subarray(3 * (i * columns + j), 3 * (i * columns + j) + 3);
            for (let i = 0; i < rows; i++)
                for (let j = 0; j < columns; j++) {
                    if (i + 1 < rows) out.push(...at(i, j), ...at(i + 1, j));
                    if (j + 1 < columns) out.push(...at(i, j), ...at(i, j + 1));
                }
        }
        return out;
    }

    curveSegments(frame) {
        const out = [];
        for (const figure of this.model.figures) {
            if (figure.surface) continue;
            const k = Math.floor(frame), share = frame - k, last = frame >= this.model.frameCount - 1;
            const a = last ? figure.spline.curvePositions(samplesOf(figure.spline.knots[0], figure.spline.degree[0], figure.spline.control[0], 6000, 20000))
                : figure.replay.positions(frameOf(this.model, figure, k));
            const b = last ? a : figure.replay.positions(frameOf(this.model, figure, k + 1));
            const at = i => [0, 1, 2].map(c => a[3 * i + c] * (1 - share) + b[3 * i + c] * share);
            for (let i = 0; i + 1 < a.length / 3; i++) out.push(...at(i), ...at(i + 1));
        }
        return out;
    }

    /** Curves of a surface at its knots, or its boundary alone: its edges, or the loops that trim it. */
    knotLines(inside) {
        const out = [];
        for (const {figure} of this.surfaces) {
            const {spline, trim} = figure;
            if (trim.length && !inside) {
                for (const loop of trim) {
                    const spots = refined(loop, spline.domain).map(([u, v]) => spline.lattice([u], [v], 0).s);
                    spots.forEach((spot, i) => out.push(...spot, ...spots[(i + 1) % spots.length]));
                }
                continue;
            }
            for (const d of [0, 1]) {
                const knots = spline.knots[d], [low, high] = spline.domain[d];
                let at = inside ? [...new Set(knots)].filter(t => t > low && t < high) : [low, high];
                const every = Math.ceil(at.length / MOST_LINES);
                at = at.filter((_, i) => i % every === 0);
                const across = samplesOf(spline.knots[1 - d], spline.degree[1 - d], spline.control[1 - d], LINE_STEPS, LINE_STEPS);
                const rows = d === 0 ? spline.lattice(at, across, 0).s : spline.lattice(across, at, 0).s;
                const spot = (line, step) => { const k = 3 * (d === 0 ? line * across.length + step : step * at.length + line); return rows.subarray(k, k + 3); };
                for (let line = 0; line < at.length; line++)
                    for (let s = 0; s + 1 < across.length; s++) out.push(...spot(line, s), ...spot(line, s + 1));
            }
        }
        return out;
    }

    combSegments(frame) {
        const comb = combOf(this.splines(frame).map(([f]) => f.spline), this.model.diagonal), out = [];
        for (const line of comb.lines) {
            const tips = line.map(tooth => tipOf(tooth, comb, this.state.values.comb));
            line.forEach((tooth, i) => {
                out.push(...tooth.root, ...tips[i]);
                if (i) out.push(...tips[i - 1], ...tips[i]);
            });
        }
        return out;
    }

    barSegments(frame) {
        const {data} = this.model, feet = this.model.feet(frame), factor = barFactor(this.model) * this.state.values.bars, out = [];
        for (let i = 0; i < data.shown; i++)
            for (const share of [0, factor])
                for (let c = 0; c < 3; c++) out.push(feet[3 * i + c] + share * (data.position[3 * i + c] - feet[3 * i + c]));
        return out;
    }

    knotDots(frame) {
        const out = [];
        for (const [{spline, exact}] of this.splines(frame)) {
            if (exact === false || spline.directions === 2) continue;
            for (const t of new Set(spline.knots[0])) out.push(...spline.curve(t, 0)[0]);
        }
        return out;
    }

    /** What each layer needs to be rebuilt for. */
    layerKeys(frame) {
        const {state, model} = this, whole = Math.max(0, Math.round(frame)), theme = this.colours.ink, {values} = state;
        const surface = this.surfaces.length > 0, end = whole >= model.frameCount - 1;
        return {
            curve: surface ? null : `${theme} ${frame}`,
            edges: surface && end && state.shows('edges') ? theme : null,
            knots: state.shows('knots') && (!surface || end) ? `${theme} ${surface ? '' : whole}` : null,
            control: state.shows('control') ? `${theme} ${whole}` : null,
            comb: !surface && state.shows('comb') ? `${theme} ${whole} ${values.comb}` : null,
            bars: model.data && !surface && state.shows('bars') ? `${theme} ${whole} ${values.bars}` : null,
            points: model.data && state.shows('points') ? `${theme} ${whole}` : null,
            unsupported: end && state.shows('unsupported') ? theme : null,
            met: state.shows('met') ? theme : null,
            corners: state.shows('corners') ? theme : null,
            chosen: state.point() >= 0 ? `${theme} ${state.point()}` : null};
    }

    buildLayer(name, frame) {
        const {model, colours} = this, {data, head} = model, whole = Math.max(0, Math.round(frame)), surface = this.surfaces.length > 0;
        switch (name) {
        case 'curve': return [this.segments(this.curveSegments(frame), colours.curve, 2.5)];
        case 'edges': return [this.segments(this.knotLines(false), colours.ink, 1.5)];
        case 'knots': return surface ? [this.segments(this.knotLines(true), colours.knot, 1)] : [this.dots(this.knotDots(whole), 6, colours.knot)];
        case 'control': return this.buildControl(whole);
        case 'comb': return [this.segments(this.combSegments(whole), colours.comb, 1)];
        case 'bars': return [this.segments(this.barSegments(whole), colours.bar, 1.75)];
        case 'points': return [this.buildPoints(whole)];
        case 'unsupported': return [this.dots(head.unsupported.flatMap(i => Array.from(model.figures[0].spline.points.subarray(3 * i, 3 * i + 3))), 10, colours.bad)];
        case 'met': return [this.dots([...head.met, ...head.constraint_points].flat(), 11, colours.mark)];
        case 'corners': return [this.dots(cornersOf(model).flat(), 11, colours.bad)];
        default: return [this.dots(Array.from(data.position.subarray(3 * this.state.point(), 3 * this.state.point() + 3)), 16, colours.mark)];
        }
    }

    buildControl(frame) {
        const {colours} = this, points = this.splines(frame).filter(([f]) => f.exact !== false).flatMap(([f]) => Array.from(f.spline.points));
        const parts = [this.segments(this.controlSegments(frame), colours.control, 1)];
        if (points.length < 3 * 800) parts.push(this.dots(points, 5, colours.control, null, this.map, colours.control));
        return parts;
    }

    buildPoints(frame) {
        const {data} = this.model, size = data.shown > 6000 ? 4 : data.shown > 1500 ? 5.5 : 7.5, deviations = this.model.deviations(frame);
        if (this.surfaces.length && data.sides) return this.dots(data.position, size, this.colours.point, deviations);
        return this.dots(data.position, size, this.colours.point, Array.from(deviations, d => 2 * Math.abs(d) - (data.largest || 1)), this.sizeMap);
    }

    updateLayers(frame) {
        const keys = this.layerKeys(frame);
        for (const [name, key] of Object.entries(keys)) {
            const layer = this.layers[name];
            if (layer?.key === key || (!layer && key === null)) continue;
            layer?.objects.forEach(object => { this.group.remove(object); object.geometry.dispose(); object.material.dispose(); });
            this.layers[name] = key === null ? undefined : {key, objects: this.buildLayer(name, frame)};
            this.layers[name]?.objects.forEach(object => this.group.add(object));
        }
    }

    // ---- The box with its ticks ----

    drawBox() {
        const {low, high} = this.model, corner = (i, j, k) => [i ? high[0] : low[0], j ? high[1] : low[1], k ? high[2] : low[2]];
        const near = this.nearestCorner(corner), key = `${this.colours.line} ${near}`;
        if (this.box?.key !== key) {
            if (this.box) this.group.remove(this.box.object);
            this.box = {key, object: this.segments(this.farEdges(corner, near), this.colours.line, 1)};
            this.group.add(this.box.object);
        }
        const seen = [this.camera, this.width, this.height, this.stretch].join();
        if (this.labelled === seen) return;
        this.labelled = seen;
        this.labels.replaceChildren();
        this.labelAxis(0, [[0, 0], [1, 0]].map(([j, k]) => [corner(0, j, k), corner(1, j, k)]), 1);
        this.labelAxis(1, [[0, 0], [1, 0]].map(([i, k]) => [corner(i, 0, k), corner(i, 1, k)]), 1);
        this.labelAxis(2, [[0, 0], [0, 1], [1, 0], [1, 1]].map(([i, j]) => [corner(i, j, 0), corner(i, j, 1)]), 0);
    }

    nearestCorner(corner) {
        const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(k => [k & 1, k >> 1 & 1, k >> 2]);
        const depths = corners.map(c => this.spot(corner(...c))[2]);
        return corners[depths.indexOf(Math.min(...depths))];
    }

    /** The edges of the box but the three that would stand before what is in it. */
    farEdges(corner, near) {
        const out = [];
        for (const axis of [0, 1, 2])
            for (const [a, b] of [[0, 0], [0, 1], [1, 0], [1, 1]]) {
                const ends = [0, 1].map(end => axis === 0 ? [end, a, b] : axis === 1 ? [a, end, b] : [a, b, end]);
                if (!ends.some(end => end.every((x, c) => x === near[c]))) out.push(...ends.flatMap(end => corner(...end)));
            }
        return out;
    }

    /** Ticks along the edge that lies lowest on the screen (axis across: `down`), or leftmost. */
    labelAxis(axis, edges, down) {
        const spots = edges.map(edge => edge.map(at => this.spot(at)));
        const score = ([a, b]) => down ? a[1] + b[1] : -(a[0] + b[0]);
        const best = spots.reduce((k, s, i) => score(s) > score(spots[k]) ? i : k, 0), [from, to] = edges[best], [a, b] = spots[best];
        if (Math.hypot(a[0] - b[0], a[1] - b[1]) < 45 || from[axis] === to[axis]) return;
        const values = ticks(from[axis], to[axis], Math.hypot(a[0] - b[0], a[1] - b[1]) / 62), names = tickLabels(values);
        const heart = this.spot([0, 1, 2].map(c => this.centre(c))), mid = [(a[0] + b[0]) / 2 - heart[0], (a[1] + b[1]) / 2 - heart[1]];
        const away = Math.hypot(...mid) || 1, put = (text, at, distance, className) => {
            const label = document.createElement('span'), [x, y] = this.spot(at);
            label.textContent = text;
            label.className = className;
            label.style.transform = `translate(-50%, -50%) translate(${x + distance * mid[0] / away}px, ${y + distance * mid[1] / away}px)`;
            this.labels.append(label);
        };
        values.forEach((value, i) => put(names[i], from.map((x, c) => c === axis ? value : x), down ? 16 : 24, 'tick'));
        put('xyz'[axis], from.map((x, c) => (x + to[c]) / 2), down ? 38 : 52, 'axis');
    }

    // ---- Camera ----

    get camera() {
        const {azimuth, elevation, distance, target} = this.look;
        if (azimuth === HOME.azimuth && elevation === HOME.elevation && distance === 1 && target.length() === 0) return '';
        return [azimuth.toFixed(1), elevation.toFixed(1), distance.toFixed(3), ...target.toArray().map(x => x.toFixed(3))].map(Number).join(',');
    }

    set camera(text) {
        const [azimuth, elevation, distance, x = 0, y = 0, z = 0] = text.split(',').map(Number);
        if (text && [azimuth, elevation, distance, x, y, z].every(Number.isFinite) && distance > 0)
            this.look = {azimuth, elevation, distance, target: new Vector3(x, y, z)};
        else this.reset();
    }

    reset() {
        this.look = {...HOME, target: new Vector3()};
    }

    turn(dx, dy) {
        this.look.azimuth = (this.look.azimuth - dx * 0.4 + 540) % 360 - 180;
        this.look.elevation = Math.max(-89.9, Math.min(89.9, this.look.elevation + dy * 0.4));
    }

    move(dx, dy) {
        const step = 2 * Math.tan(FIELD * Math.PI / 360) * this.range3() / this.height;
        const right = new Vector3().setFromMatrixColumn(this.eye.matrix, 0), up = new Vector3().setFromMatrixColumn(this.eye.matrix, 1);
        this.look.target.addScaledVector(right, -dx * step).addScaledVector(up, dy * step);
    }

    zoomAt(factor) {
        this.look.distance = Math.max(0.02, Math.min(5, this.look.distance / factor));
    }

    /** Distance at which the box fills the picture from the first direction, with room for the labels. */
    fittedRange() {
        const a = HOME.azimuth * Math.PI / 180, e = HOME.elevation * Math.PI / 180, {low, high} = this.model;
        const toward = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)], right = [-Math.sin(a), Math.cos(a), 0];
        const up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)], half = [0, 1, 2].map(c => (high[c] - low[c]) / 2 * this.unit * this.stretch[c]);
        const tall = Math.tan(FIELD * Math.PI / 360), wide = tall * this.width / this.height, room = [1 - 2 * 46 / this.width, 1 - 2 * 44 / this.height];
        let range = 0;
        for (let k = 0; k < 8; k++) {
            const at = [0, 1, 2].map(c => (k >> c & 1 ? 1 : -1) * half[c]), along = axis => axis.reduce((sum, x, c) => sum + x * at[c], 0);
            range = Math.max(range, along(toward) + Math.abs(along(right)) / (wide * Math.max(0.4, room[0])), along(toward) + Math.abs(along(up)) / (tall * Math.max(0.4, room[1])));
        }
        return range;
    }

    range3() {
        return this.look.distance * this.fittedRange();
    }

    aim() {
        const {azimuth, elevation, target} = this.look, a = azimuth * Math.PI / 180, e = elevation * Math.PI / 180, r = this.range3();
        this.eye.position.set(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)).multiplyScalar(r).add(target);
        this.eye.near = Math.max(r / 500, r - 4);
        this.eye.far = r + 4;
        this.eye.lookAt(target);
        this.eye.updateMatrix();
        this.eye.updateProjectionMatrix();
        this.eye.updateMatrixWorld();
    }

    resize(width, height) {
        Object.assign(this, {width, height});
        this.renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
        this.renderer.setSize(width, height);
        this.eye.aspect = width / height;
    }

    /** Slow machines draw fewer pixels while a replay plays. pace: milliseconds between its frames; null: at rest. */
    keepPace(pace) {
        const now = this.renderer.getPixelRatio(), wanted = pace === null ? Math.min(2, devicePixelRatio || 1) : pace > SLOW ? Math.max(0.5, 0.8 * now) : now;
        if (wanted !== now) this.renderer.setPixelRatio(wanted);
    }

    spot(at) {
        const v = new Vector3(...[0, 1, 2].map(c => (at[c] - this.centre(c)) * this.unit * this.stretch[c])).project(this.eye);
        return [(v.x + 1) * this.width / 2, (1 - v.y) * this.height / 2, v.z];
    }

    pick(x, y, reach = 14) {
        const {data} = this.model;
        let best = -1, nearest = Infinity;
        for (let i = 0; data && i < data.shown; i++) {
            const [px, py, depth] = this.spot(data.position.subarray(3 * i, 3 * i + 3)), distance = Math.hypot(px - x, py - y);
            if (distance < reach && distance / reach * 0.05 + depth * 10 < nearest) [best, nearest] = [i, distance / reach * 0.05 + depth * 10];
        }
        return best;
    }

    reveal() {}

    draw() {
        this.colours = palette();
        this.arrange();
        this.aim();
        const frame = this.state.frame();
        this.updateSurfaces(frame);
        this.updateLayers(frame);
        this.drawBox();
        this.renderer.render(this.scene, this.eye);
    }
}

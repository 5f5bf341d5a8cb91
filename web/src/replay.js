// The replay: a slider over the frames, blended in between, that plays by itself.
import {make} from './dom.js';
import {count, number} from './format.js';

const FRAMES_A_SECOND = 4; // of the fit; the screen shows the blends between them

/** onFrame is told each frame that is shown, onPace the milliseconds between them while it plays, and null when it stops. */
export function replay(model, state, element, onFrame, onPace) {
    if (model.frameCount < 2) return null;
    const end = model.frameCount - 1, {frames} = model.figures.find(f => f.frames.length === model.frameCount);
    element.hidden = false;
    const rounds = model.fits[0]?.round_count > 0;
    const words = frame => {
        const at = frames[Math.round(frame)], error = at.maxError;
        if (model.figures.length > 1) return `Frame ${count(Math.round(frame) + 1)} of ${count(model.frameCount)}`;
        return `${rounds ? 'Round' : 'Iteration'} ${count(at.iteration)} \u00b7 ${count(at.controlCount)} control points \u00b7 largest error ${number(error)}`;
    };
    const input = make('input', {type: 'range', min: 0, max: end, step: 'any', 'aria-label': 'Replay of the iterations', oninput: () => { stop(); show(Number(input.value)); }});
    const out = make('output', {'aria-live': 'off'}), button = make('button', {type: 'button', class: 'play', onclick: () => playing ? stop() : play()});
    const ticks = make('div', {class: 'ticks', 'aria-hidden': 'true'}, ...frames.map((_, k) => make('i', {style: `left: ${100 * k / end}%`})));
    let playing = false, before = 0;
    const face = () => {
        button.textContent = playing ? '\u275a\u275a' : '\u25b6';
        button.setAttribute('aria-label', playing ? 'Pause the replay' : 'Play the replay');
    };
    function show(frame) {
        state.set({frame: frame >= end ? null : Number(frame.toFixed(3))}, 'replay');
    }
    function play() {
        playing = true;
        before = 0;
        if (state.frame() >= end) show(0);
        face();
        requestAnimationFrame(step);
    }
    function stop() {
        playing = false;
        onPace(null);
        face();
    }
    function step(now) {
        if (!playing) return;
        const passed = before ? Math.min(0.1, (now - before) / 1000) : 0, next = state.frame() + passed * FRAMES_A_SECOND;
        if (before) onPace(now - before);
        before = now;
        show(Math.min(end, next));
        if (next >= end) stop();
        else requestAnimationFrame(step);
    }
    const update = () => {
        const frame = state.frame(), at = frames[Math.round(frame)];
        input.value = frame;
        input.setAttribute('aria-valuetext', words(frame));
        out.textContent = words(frame);
        onFrame(at);
    };
    element.append(button, make('div', {class: 'track'}, ticks, input), out);
    state.addEventListener('change', update);
    face();
    update();
    const whole = d => show(Math.max(0, Math.min(end, Math.round(state.frame()) + d)));
    return {toggle: () => playing ? stop() : play(), next: () => { stop(); whole(1); }, previous: () => { stop(); whole(-1); }};
}

// Mouse, touch and keys over the figure.

const STEP = 40;

/** @param {{turn: Function, move: Function, zoom: Function, hover: Function, tap: Function, key: (key: string, shift: boolean) => boolean}} acts */
export function gestures(element, acts) {
    const held = new Map();
    let travelled = 0;
    const local = event => { const box = element.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
    element.addEventListener('contextmenu', event => event.preventDefault());
    element.addEventListener('pointerdown', event => {
        element.setPointerCapture(event.pointerId);
        held.set(event.pointerId, local(event));
        travelled = held.size > 1 ? Infinity : 0;
    });
    element.addEventListener('pointermove', event => {
        const at = local(event), from = held.get(event.pointerId);
        if (!from) { acts.hover(...at); return; }
        const [dx, dy] = [at[0] - from[0], at[1] - from[1]];
        travelled += Math.hypot(dx, dy);
        if (held.size === 2) pinch(event.pointerId, from, at);
        else if (event.buttons & 2 || event.shiftKey) acts.move(dx, dy);
        else acts.turn(dx, dy);
        held.set(event.pointerId, at);
    });
    function pinch(id, from, at) {
        const [other] = [...held].filter(([key]) => key !== id).map(([, spot]) => spot);
        const wide = spot => Math.hypot(spot[0] - other[0], spot[1] - other[1]) || 1;
        acts.zoom(wide(at) / wide(from), (at[0] + other[0]) / 2, (at[1] + other[1]) / 2);
        acts.move((at[0] - from[0]) / 2, (at[1] - from[1]) / 2);
    }
    const release = event => {
        const at = held.get(event.pointerId);
        held.delete(event.pointerId);
        if (event.type === 'pointerup' && at && travelled < 6) acts.tap(...at);
    };
    element.addEventListener('pointerup', release);
    element.addEventListener('pointercancel', release);
    element.addEventListener('wheel', event => {
        if (!event.ctrlKey && document.activeElement !== element && !element.matches(':focus-within')) return; // the page scrolls until the figure is in focus
        event.preventDefault();
        acts.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0016)), ...local(event));
    }, {passive: false});
    element.addEventListener('keydown', event => {
        const arrows = {ArrowLeft: [STEP, 0], ArrowRight: [-STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP]};
        if (event.altKey || event.ctrlKey || event.metaKey) return;
        if (arrows[event.key]) (event.shiftKey ? acts.move : acts.turn)(...arrows[event.key]);
        else if (!acts.key(event.key)) return;
        event.preventDefault();
    });
}

// What is shown, kept in the URL's hash: each view is a link.

const LISTS = new Set(['show']), NUMBERS = new Set(['comb', 'bars', 'height', 'frame', 'row']);

export class State extends EventTarget {
    constructor(defaults, model) {
        super();
        this.model = model;
        this.defaults = defaults;
        this.values = {...defaults};
        this.read();
        addEventListener('hashchange', () => {
            if (location.hash.slice(1) === this.written) return;
            this.read();
            this.tell(null);
        });
    }

    read() {
        this.values = {...this.defaults};
        for (const [key, text] of new URLSearchParams(location.hash.slice(1))) {
            if (!(key in this.defaults)) continue;
            const value = LISTS.has(key) ? (text ? text.split(' ') : []) : NUMBERS.has(key) ? Number(text) : text;
            if (!(NUMBERS.has(key) && !Number.isFinite(value))) this.values[key] = value;
        }
    }

    /** Changes some values; listeners of "change" learn who did it. */
    set(changes, source = null) {
        Object.assign(this.values, changes);
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.write(), 150);
        this.tell(source);
    }

    tell(source) {
        this.dispatchEvent(Object.assign(new Event('change'), {source}));
    }

    write() {
        const parts = [];
        for (const [key, value] of Object.entries(this.values)) {
            const text = LISTS.has(key) ? value.join(' ') : value === null ? '' : String(value);
            const initial = LISTS.has(key) ? this.defaults[key].join(' ') : this.defaults[key] === null ? '' : String(this.defaults[key]);
            if (text !== initial) parts.push(`${key}=${encodeURIComponent(text).replace(/%20/g, '+').replace(/%2C/g, ',')}`);
        }
        this.written = parts.join('&');
        try {
            history.replaceState(null, '', '#' + this.written);
        } catch {
            location.replace('#' + this.written);
        }
    }

    /** The frame shown, whole numbers at frames and others between; the end where none is asked. */
    frame() {
        const end = this.model.frameCount - 1, {frame} = this.values;
        return frame === null || frame > end ? end : Math.max(0, frame);
    }

    /** Index of the chosen point among those shown, -1 when none is. */
    point() {
        return this.values.row === null || !this.model.data ? -1 : this.model.data.row.indexOf(this.values.row);
    }

    shows(layer) {
        return this.values.show.includes(layer);
    }

    toggle(layer, on) {
        const rest = this.values.show.filter(name => name !== layer);
        this.set({show: on ? [...rest, layer] : rest}, 'controls');
    }
}

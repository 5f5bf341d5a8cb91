// Settings, how to reproduce the fit, keys.
import {make, table} from './dom.js';
import {choices} from './words.js';

export function settings(model, element) {
    const rows = model.head.settings;
    if (!rows.length) return;
    element.hidden = false;
    const changed = rows.filter(([, value]) => value !== null), rest = rows.filter(([, value]) => value === null);
    const cells = ([name, value, initial]) => Object.assign([make('code', {}, name), value === null ? initial : value, initial], {className: value === null ? null : 'changed'});
    element.append(make('h2', {id: 'settings-heading'}, 'Settings'),
        make('p', {class: 'key'}, `${changed.length} of ${rows.length} settings differ from their defaults; they come first.`, ...choices(model).map(text => make('span', {class: 'aside'}, `Chosen: ${text}.`))),
        make('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Settings'}, table('All settings with their defaults', ['Setting', 'Value', 'Default'], [...changed, ...rest].map(cells), 'settings')));
}

export function reproduce(model, element, copy) {
    const {command} = model.head;
    if (!command) return;
    element.hidden = false;
    const button = make('button', {type: 'button', onclick: () => copy(command, button)}, 'Copy');
    element.append(make('h2', {id: 'reproduce-heading'}, 'How to reproduce'), make('p', {class: 'key'}, `Run this where the files are, with pia ${model.head.version}. The answer is the same to the bit, whatever the number of threads.`),
        make('div', {class: 'command'}, make('pre', {tabindex: '0', 'aria-label': 'Command line'}, make('code', {}, command)), button));
}

export function keys(model, element) {
    const rows = [['Arrow keys', model.space ? 'turn; with Shift: move' : 'move'], ['+ and \u2212', 'zoom'], ['0', 'show all'], ['. and ,', 'next and previous point'], ['W', 'the farthest point'],
        ['Esc', 'no point'], ...(model.frameCount > 1 ? [['Space', 'play or pause the replay'], ['[ and ]', 'previous and next frame']] : [])];
    element.append(make('h2', {id: 'keys-heading'}, 'Keys'), make('p', {class: 'key'}, `With the figure in focus. By mouse or touch: drag to ${model.space ? 'turn' : 'move'}, wheel or pinch to zoom${model.space ? ', right button or two fingers to move' : ''}, point or tap to read.`),
        make('dl', {class: 'keys'}, ...rows.map(([key, what]) => make('div', {}, make('dt', {}, make('kbd', {}, key)), make('dd', {}, what)))));
}

// Elements made in one expression.

/** @param {string} name a tag, or an SVG tag as "svg:line" */
export function make(name, attributes = {}, ...children) {
    const element = name.startsWith('svg:') ? document.createElementNS('http://www.w3.org/2000/svg', name.slice(4)) : document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (value === null || value === undefined || value === false) continue;
        if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
        else element.setAttribute(key, value === true ? '' : value);
    }
    element.append(...children.filter(child => child !== null && child !== undefined && child !== ''));
    return element;
}

/** A table with a caption; cells are texts or elements. */
export function table(caption, head, rows, className = '') {
    return make('table', {class: className}, make('caption', {}, caption),
        make('thead', {}, make('tr', {}, ...head.map(text => make('th', {scope: 'col'}, text)))),
        make('tbody', {}, ...rows.map(row => make('tr', {class: row.className ?? null},
            ...row.map((cell, i) => i === 0 ? make('th', {scope: 'row'}, cell) : make('td', {}, cell))))));
}

/** A table that stays folded until it is asked for: the text behind a chart. */
export function foldedTable(caption, head, rows) {
    return make('details', {}, make('summary', {}, 'As a table'), make('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption}, table(caption, head, rows)));
}

// Colours of the theme, as the style sheet defines them.
export function palette() {
    const style = getComputedStyle(document.documentElement);
    const value = name => style.getPropertyValue('--' + name).trim();
    return {ink: value('ink'), soft: value('soft'), faint: value('faint'), line: value('line'), stage: value('stage'), curve: value('curve'),
        control: value('control'), knot: value('knot'), comb: value('comb'), bar: value('bar'), point: value('point'), mark: value('mark'),
        bad: value('bad'), grid: value('grid')};
}

// What is shown, and how.

import {by_id, make} from '../dom.js';

const LOOK_NAMES = {plain: 'raw and cut', time: 'when it was cut', side: 'direction of the face', classes: 'excess, target, residue'};
/** Of the page's link. */
export const FIRST = {look: 'plain', smooth: true, robot: 'collision', opacity: 1, axis: '', cut_at: 0.5, machined: false, floor: true, box: true, path: false};

/**
 * @param {typeof FIRST} layers
 * @param {(layers: typeof FIRST) => void} on_change
 * @param {boolean} milled is there a surface as machined?
 */
export function show_layers(layers, on_change, milled) {
  const set = (name, value) => {
    layers[name] = value;
    on_change(layers);
  };
  const choice = (label, name, options) => make('label', {}, label, make('select', {on: {change: (event) => set(name, event.target.value)}},
    ...Object.entries(options).map(([value, text]) => make('option', {value, selected: layers[name] === value}, text))));
  const tick = (label, name) => make('label', {}, make('input', {type: 'checkbox', checked: layers[name], on: {change: (event) => set(name, event.target.checked)}}), label);
  const range = (label, name, low) => make('label', {}, label, make('input', {type: 'range', min: low, max: 1, step: 0.005, value: layers[name],
    on: {input: (event) => set(name, Number(event.target.value))}}));
  by_id('panel-layers').replaceChildren(
    make('h3', {}, 'Stock'),
    choice('Colour', 'look', LOOK_NAMES),
    tick('Smooth light (off: each voxel sharp)', 'smooth'),
    choice('Section', 'axis', {'': 'none', x: 'across x', y: 'across y', z: 'across z'}),
    range('Section at', 'cut_at', 0),
    milled ? tick('Surface at the end, by what stands above what was ordered', 'machined') : '',
    make('h3', {}, 'Robot'),
    choice('Links', 'robot', {collision: 'collision shapes', visual: 'visual shapes', none: 'hidden'}),
    range('Opacity', 'opacity', 0.1),
    tick('Way of the tool around now (orange: cuts)', 'path'),
    make('h3', {}, 'Room'),
    tick('Floor grid', 'floor'),
    tick('Edges of the grid of voxels', 'box'),
  );
}

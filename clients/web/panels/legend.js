// What the colours of the stock mean.

import {by_id, fill, make} from '../dom.js';
import {RAMP, SIDES} from '../stock/material.js';

const WORDS = {
  plain: [['#9a8f80', 'raw stock'], ['#e9e2d4', 'cut surface'], ['#d1495b', 'residue'], ['#ffb000', 'pointed out']],
  classes: [['#9a8f80', 'still to cut'], ['#e9e2d4', 'target'], ['#d1495b', 'residue'], ['#ffb000', 'pointed out']],
  side: [...['\u2212x', '+x', '\u2212y', '+y', '\u2212z', '+z'].map((text, at) => [SIDES[at], text]), ['#9a8f80', 'raw stock']],
};

const MACHINED = [['#33bf33', 'within the tolerance'], ['#ffbf33', 'five times as much'], ['#ff0033', 'ten times and more']];

/** @param {string} look `machined`: of the surface at the end @param {string} note */
export function show_legend(look, note) {
  const swatch = (colour) => {
    const box = make('i');
    box.style.background = colour;
    return box;
  };
  const lines = ((look === 'machined' ? MACHINED : WORDS[look]) ?? []).map(([colour, text]) => make('span', {}, swatch(colour), text));
  if (look === 'time') {
    const ramp = swatch('');
    ramp.style.background = `linear-gradient(90deg, ${RAMP.join(',')})`;
    ramp.style.width = '90px';
    lines.push(make('span', {}, 'first', ramp, 'last'), make('span', {}, swatch('#9a8f80'), 'raw stock'));
  }
  fill(by_id('legend'), ...lines, note && make('span', {class: 'hint'}, note));
}

// What was left and why: counts by reason, a click flies there.

import {by_id, count, make} from '../dom.js';

/**
 * @param {any[] | null} residue entries {voxel, reason}; null: not known yet
 * @param {(voxels: number[][] | null, at: number[] | null) => void} on_choose voxels to point out, and the one to look at
 */
export function show_residue(residue, on_choose) {
  const panel = by_id('panel-residue');
  if (residue === null) return panel.replaceChildren(make('p', {class: 'hint'}, 'Known when the plan is finished.'));
  if (residue.length === 0) return panel.replaceChildren(make('p', {}, 'Nothing was left: every voxel that should go is removed.'));
  const by_reason = new Map();
  for (const {voxel, reason} of residue) {
    if (!by_reason.has(reason)) by_reason.set(reason, []);
    by_reason.get(reason).push(voxel);
  }
  const reasons = [...by_reason].sort((a, b) => b[1].length - a[1].length);
  let chosen = '', next = 0;
  const note = make('p', {class: 'hint', role: 'status'});
  const buttons = reasons.map(([reason, voxels]) => make('button', {class: 'reason', aria: {pressed: 'false'}, on: {click: (event) => {
    if (chosen !== reason) next = 0;
    chosen = reason;
    for (const button of buttons) button.setAttribute('aria-pressed', String(button === event.currentTarget));
    const at = voxels[next++ % voxels.length];
    note.textContent = `Voxel ${at.join(', ')}: ${reason}. Click again for another place.`;
    on_choose(voxels, at);
  }}}, make('span', {}, reason), make('span', {}, count(voxels.length))));
  panel.replaceChildren(
    make('p', {class: 'hint'}, `${count(residue.length)} voxels were left. Click a reason to point them out and fly to one.`),
    ...buttons,
    make('button', {on: {click: () => {
      chosen = '';
      note.textContent = '';
      for (const button of buttons) button.setAttribute('aria-pressed', 'false');
      on_choose(null, null);
    }}}, 'Point out none'),
    note);
}

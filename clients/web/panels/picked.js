// What is known of a voxel that was clicked.

import {by_id, count, fill, make} from '../dom.js';

const KINDS = ['a move', 'a cut along \u2212x', 'a cut along +x', 'a cut along \u2212y', 'a cut along +y', 'a cut along \u2212z', 'a cut along +z', 'a cut'];

/**
 * @param {{cell: number[], label: number, ordinal: number | null} | null} hit
 * @param {{block: number, time: import('./time_bar.js').TimeBar, reason_of: (cell: number[]) => string | null, final: boolean}} plan
 */
export function show_picked(hit, plan) {
  const card = by_id('picked');
  card.hidden = hit === null;
  if (!hit) return;
  const voxel = hit.cell.map((value) => value * plan.block);
  const name = plan.block === 1 ? `Voxel ${voxel.join(', ')}` : `Block of ${plan.block}\u00b3 voxels at ${voxel.join(', ')}`;
  const keyframe = hit.ordinal === null ? null : plan.time.keyframe_of(hit.ordinal);
  let fate = 'It is part of the target and stays.';
  if (keyframe !== null) fate = `It goes as number ${count(hit.ordinal)}, in keyframe ${count(keyframe + 1)}: ${KINDS[plan.time.kinds[keyframe] & 7]}.`;
  else if (hit.label !== 1) fate = plan.final ? `It should go and was left: ${plan.reason_of(hit.cell) ?? 'see the residue'}.` : 'It is to go; the plan has not come to it yet.';
  fill(card,
    make('p', {}, make('strong', {}, name)), make('p', {}, fate),
    keyframe !== null && make('button', {on: {click: () => plan.time.go(keyframe)}}, 'Go there'),
    make('button', {on: {click: () => { card.hidden = true; }}}, 'Close'));
}

// What stands at a moment as few rectangles: the faces of the voxels, merged where they lie in one plane and are alike.

import {NEVER} from '../plan/timeline.js';

const AIR = 0, GONE = 1, STANDS = 2, LEFT = 3;  // of a cell; LEFT stands too, and should not
const KEEP_LABEL = 1;
/** Kinds of faces, in the order in which they are given out. */
export const KINDS = ['cut', 'raw', 'residue'];
const FINEST = 128;  // cells along an edge: more makes files that phones refuse

/**
 * @typedef {object} Outline
 * @property {number} edge cells along an edge of the grid; at most 128, each then some voxels wide
 * @property {{corners: Uint16Array, sides: Uint8Array}[]} kinds one for each of KINDS: of each rectangle four corners in cells, counter-clockwise from
 *   outside, and its side: -x, +x, -y, +y, -z, +z
 */

/**
 * @param {import('../plan/timeline.js').Timeline} timeline that has started
 * @param {{removed: number, final: boolean, what: 'stock' | 'sculpture'}} moment `sculpture`: the target alone
 * @param {number} [finest] cells along an edge, at most
 * @returns {Outline}
 */
export function outline(timeline, moment, finest = FINEST) {
  const edge = Math.min(timeline.edge, finest), states = states_of(timeline, moment, edge);
  const found = KINDS.map(() => ({corners: [], sides: []}));
  const mask = new Uint8Array(edge * edge), strides = [1, edge, edge * edge];
  for (let side = 0; side < 6; ++side) {
    const axis = side >> 1, up = side & 1, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (let layer = 0; layer < edge; ++layer) {
      const is_last = layer === (up ? edge - 1 : 0);
      for (let b = 0, at = 0; b < edge; ++b) {
        for (let a = 0; a < edge; ++a, ++at) {
          const cell = layer * strides[axis] + a * strides[u] + b * strides[v], state = states[cell];
          const beyond = is_last ? AIR : states[cell + (up ? strides[axis] : -strides[axis])];
          mask[at] = state < STANDS || beyond >= STANDS ? 0 : 1 + (state === LEFT ? 2 : beyond === GONE || moment.what === 'sculpture' ? 0 : 1);
        }
      }
      merge(mask, edge, (kind, from, to) => {
        const place = layer + up, [a0, b0] = from, [a1, b1] = to;
        const around = up ? [[a0, b0], [a1, b0], [a1, b1], [a0, b1]] : [[a0, b0], [a0, b1], [a1, b1], [a1, b0]];
        for (const [a, b] of around) {
          const corner = [0, 0, 0];
          corner[axis] = place;
          corner[u] = a;
          corner[v] = b;
          found[kind - 1].corners.push(...corner);
        }
        found[kind - 1].sides.push(side);
      });
    }
  }
  return {edge, kinds: found.map(({corners, sides}) => ({corners: new Uint16Array(corners), sides: new Uint8Array(sides)}))};
}

// A coarser cell stands while one of its voxels does; it is left over only if none of them is of the target.
function states_of(timeline, {removed, final, what}, edge) {
  const states = new Uint8Array(edge ** 3), targets = new Uint8Array(edge ** 3), {order, label} = timeline;
  const fine = timeline.edge, shift = Math.log2(fine / edge);
  for (let k = 0, at = 0; k < fine; ++k) {
    for (let j = 0; j < fine; ++j) {
      const row = edge * ((j >> shift) + edge * (k >> shift));
      for (let i = 0; i < fine; ++i, ++at) {
        if (order[at] === 0) continue;
        const cell = row + (i >> shift), is_target = label[at] === KEEP_LABEL;
        if (is_target) targets[cell] = 1;
        const stands = what === 'sculpture' ? is_target : order[at] > removed;
        const state = !stands ? GONE : final && order[at] >= NEVER && !is_target ? LEFT : STANDS;
        if (state > states[cell]) states[cell] = state;
      }
    }
  }
  for (let cell = 0; cell < states.length; ++cell) if (states[cell] === LEFT && targets[cell]) states[cell] = STANDS;
  return states;
}

// The largest rectangles, row by row; the mask is empty afterwards.
function merge(mask, edge, take) {
  for (let b = 0; b < edge; ++b) {
    for (let a = 0; a < edge; ++a) {
      const kind = mask[a + edge * b];
      if (kind === 0) continue;
      let to_a = a + 1, to_b = b + 1;
      while (to_a < edge && mask[to_a + edge * b] === kind) ++to_a;
      const is_alike = (row) => {
        for (let at = a; at < to_a; ++at) if (mask[at + edge * row] !== kind) return false;
        return true;
      };
      while (to_b < edge && is_alike(to_b)) ++to_b;
      for (let row = b; row < to_b; ++row) mask.fill(0, a + edge * row, to_a + edge * row);
      take(kind, [a, b], [to_a, to_b]);
    }
  }
}

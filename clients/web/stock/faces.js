// The visible faces of one chunk of the grid at one moment, with smooth normals: two words a face, as material.js reads them.

import {NEVER} from '../plan/timeline.js';

export const CHUNK = 32;
const BORDER = 2, SIDE = CHUNK + 2 * BORDER;  // a normal comes from the 5 x 5 x 5 cells around
const KEEP_LABEL = 1;
const RESIDUE_CLASS = 2, CHOSEN_CLASS = 3;
const SIGN = 1 << 31;
const SKIN = 4095;
const BUCKETS = 4094;

// Of five cells in a row, as bits: how many stand, and the sum of their places from -2 to 2.
const COUNT = new Int8Array(32), LEAN = new Int8Array(32);
for (let five = 0; five < 32; ++five) {
  for (let bit = 0; bit < 5; ++bit) {
    COUNT[five] += (five >> bit) & 1;
    LEAN[five] += ((five >> bit) & 1) * (bit - 2);
  }
}

/**
 * @typedef {object} Moment
 * @property {number} removed voxels cut so far
 * @property {boolean} final nothing will be cut any more behind the timeline's end
 * @property {Set<number> | null} chosen cells that are pointed out
 */

/** Which cells stand at a moment, a bit each, 32 of a row in a word; made anew chunk by chunk. */
export class Standing {
  /** @param {import('../plan/timeline.js').Timeline} timeline that has started */
  constructor(timeline) {
    this.timeline = timeline;
    this.across = Math.ceil(timeline.edge / CHUNK);
    this.order = new Int32Array(timeline.order.buffer);  // whole numbers with a sign are compared faster: SIGN puts theirs in order
    this.words = new Uint32Array(this.across * timeline.edge ** 2);
    // The rows of a chunk and its border: of cells 0 to 31, -2 to 29, and 2 to 33.
    this.here = new Uint32Array(SIDE * SIDE);
    this.low = new Uint32Array(SIDE * SIDE);
    this.high = new Uint32Array(SIDE * SIDE);
    this.found = new Uint32Array(1 << 15);
  }

  /** @param {[number, number, number]} corner the chunk's first cell @param {number} removed voxels cut so far */
  update(corner, removed) {
    const {edge} = this.timeline, size = Math.min(CHUNK, edge), {words, across, order} = this, limit = removed ^ SIGN;
    for (let z = corner[2]; z < corner[2] + size; ++z) {
      for (let y = corner[1]; y < corner[1] + size; ++y) {
        let at = edge * (y + edge * z) + corner[0], word = 0;
        for (let bit = 0; bit < size; ++bit, ++at) word |= ((order[at] ^ SIGN) > limit ? 1 : 0) << bit;
        words[(corner[0] >> 5) + across * (y + edge * z)] = word;
      }
    }
  }

  /**
   * The chunks around it must be of the same moment.
   * @param {[number, number, number]} corner
   * @param {Moment} moment
   * @returns {{faces: Uint32Array, ends: number[]}} two words a face, those of one side together; where those of each side end, in words
   */
  faces(corner, moment) {
    this.#read_rows(corner);
    const {here, low, high} = this, size = Math.min(CHUNK, this.timeline.edge);
    let words = 0;
    for (let k = 0; k < size; ++k) {
      for (let j = 0; j < size; ++j) {
        const row = j + BORDER + SIDE * (k + BORDER), stand = here[row];
        if (stand === 0) continue;
        const left = stand & ~((low[row] >>> 1) | ((high[row] << 3) & 0x80000000)), right = stand & ~((high[row] << 1) | ((low[row] >>> 3) & 1));
        const front = stand & ~here[row - 1], back = stand & ~here[row + 1], below = stand & ~here[row - SIDE], above = stand & ~here[row + SIDE];
        for (let open = left | right | front | back | below | above; open !== 0; open &= open - 1) {
          const i = 31 - Math.clz32(open & -open);
          const sides = ((left >>> i) & 1) | (((right >>> i) & 1) << 1) | (((front >>> i) & 1) << 2) | (((back >>> i) & 1) << 3)
            | (((below >>> i) & 1) << 4) | (((above >>> i) & 1) << 5);
          if (words + 12 > this.found.length) this.#grow();
          words = this.#add_faces(corner[0] + i, corner[1] + j, corner[2] + k, {sides, normal: this.#normal(row, i, sides), moment, words});
        }
      }
    }
    return this.#by_side(words);
  }

  #by_side(words) {
    const {found} = this, ends = [0, 0, 0, 0, 0, 0], faces = new Uint32Array(words);
    for (let at = 1; at < words; at += 2) ends[found[at] & 7] += 2;
    const to = [0, 0, 0, 0, 0, 0];
    for (let side = 1; side < 6; ++side) {
      to[side] = ends[side - 1];
      ends[side] += ends[side - 1];
    }
    for (let at = 0; at < words; at += 2) {
      const side = found[at + 1] & 7;
      faces[to[side]++] = found[at];
      faces[to[side]++] = found[at + 1];
    }
    return {faces, ends};
  }

  #read_rows(corner) {
    const {here, low, high, words, across} = this, {edge} = this.timeline, column = corner[0] >> 5;
    for (let c = 0, row = 0; c < SIDE; ++c) {
      const z = corner[2] + c - BORDER;
      for (let b = 0; b < SIDE; ++b, ++row) {
        const y = corner[1] + b - BORDER;
        if (y < 0 || z < 0 || y >= edge || z >= edge) {
          here[row] = low[row] = high[row] = 0;
          continue;
        }
        const at = column + across * (y + edge * z), word = words[at];
        here[row] = word;
        low[row] = (word << 2) | (column > 0 ? words[at - 1] >>> 30 : 0);
        high[row] = (word >>> 2) | (column + 1 < across ? words[at + 1] << 30 : 0);
      }
    }
  }

  #grow() {
    const larger = new Uint32Array(2 * this.found.length);
    larger.set(this.found);
    this.found = larger;
  }

  /** Away from what stands around, as an octahedral map of 8 + 8 bits. */
  #normal(row, i, sides) {
    const rows = i < 16 ? this.low : this.high, shift = i < 16 ? i : i - 4;
    let x = 0, y = 0, z = 0;
    for (let dk = -2; dk <= 2; ++dk) {
      const base = row + dk * SIDE;
      const a = (rows[base - 2] >>> shift) & 31, b = (rows[base - 1] >>> shift) & 31, c = (rows[base] >>> shift) & 31;
      const d = (rows[base + 1] >>> shift) & 31, e = (rows[base + 2] >>> shift) & 31;
      x -= LEAN[a] + LEAN[b] + LEAN[c] + LEAN[d] + LEAN[e];
      y += 2 * (COUNT[a] - COUNT[e]) + COUNT[b] - COUNT[d];
      z -= dk * (COUNT[a] + COUNT[b] + COUNT[c] + COUNT[d] + COUNT[e]);
    }
    if (x === 0 && y === 0 && z === 0) {  // as much on each side: the open faces decide
      x = ((sides >> 1) & 1) - (sides & 1);
      y = ((sides >> 3) & 1) - ((sides >> 2) & 1);
      z = ((sides >> 5) & 1) - ((sides >> 4) & 1) || (x === 0 && y === 0 ? 1 : 0);
    }
    const length = Math.abs(x) + Math.abs(y) + Math.abs(z);
    let u = x / length, v = y / length;
    if (z < 0) {
      const folded = (1 - Math.abs(v)) * (u < 0 ? -1 : 1);
      v = (1 - Math.abs(u)) * (v < 0 ? -1 : 1);
      u = folded;
    }
    return Math.round((u * 0.5 + 0.5) * 255) | (Math.round((v * 0.5 + 0.5) * 255) << 8);
  }

  /** @param {number} x @param {number} y @param {number} z @param {{sides: number, normal: number, moment: Moment, words: number}} cell @returns {number} words now */
  #add_faces(x, y, z, {sides, normal, moment, words}) {
    const {order, label, edge, voxels} = this.timeline, {found} = this;
    const at = x + edge * (y + edge * z);
    const place = (x | (y << 10) | (z << 20) | (class_of(order[at], label[at], at, moment) << 30)) >>> 0;
    for (let side = 0; side < 6; ++side) {
      if (!(sides & (1 << side))) continue;
      const axis = side >> 1, up = side & 1, here = axis === 0 ? x : axis === 1 ? y : z;
      const inside = up ? here + 1 < edge : here > 0, step = axis === 0 ? 1 : axis === 1 ? edge : edge * edge;
      const gone = inside ? order[at + (up ? step : -step)] : 0;
      const bucket = gone === 0 ? SKIN : Math.floor(((gone - 1) * BUCKETS) / voxels.remove);
      found[words++] = place;
      found[words++] = (side | (bucket << 3) | (normal << 15)) >>> 0;
    }
    return words;
  }
}

function class_of(order, label, cell, moment) {
  if (moment.chosen !== null && moment.chosen.has(cell)) return CHOSEN_CLASS;
  if (label === KEEP_LABEL) return KEEP_LABEL;
  return moment.final && order >= NEVER ? RESIDUE_CLASS : 0;
}

// Which chunks of the grid look different at two moments: a bit for each chunk and each of 4096 stretches of the plan.

import {CHUNK} from './faces.js';

const STRETCHES = 4096, WORDS = STRETCHES / 32;
const REACH = 2;  // a cut changes the normals of cells as far away

export class Chunks {
  /** @param {number} edge cells along an edge of the grid @param {number} remove voxels that may be cut */
  constructor(edge, remove) {
    this.edge = edge;
    this.row_bits = Math.log2(edge);
    this.across = Math.ceil(edge / CHUNK);
    this.count = this.across ** 3;
    this.scale = STRETCHES / Math.max(1, remove);
    this.bits = new Uint32Array(this.count * WORDS);
    this.noted = {box: -1, stretch: -1};  // last, of one stretch
  }

  /** @param {number} chunk @returns {[number, number, number]} its first cell */
  corner(chunk) {
    const {across} = this;
    return [CHUNK * (chunk % across), CHUNK * (Math.floor(chunk / across) % across), CHUNK * Math.floor(chunk / (across * across))];
  }

  /**
   * Cells in a row along an axis that go one after the other, from and to these counts of voxels.
   * @param {number} first @param {number} last @param {number} from @param {number} to
   */
  add(first, last, from, to) {
    const {edge, row_bits, across, bits} = this, top = across - 1, low = Math.min(first, last), high = Math.max(first, last);  // an edge is a power of two
    const end = this.#stretch(to);
    const a0 = Math.max(0, ((low & (edge - 1)) - REACH) >> 5), a1 = Math.min(top, ((high & (edge - 1)) + REACH) >> 5);
    const b0 = Math.max(0, (((low >>> row_bits) & (edge - 1)) - REACH) >> 5), b1 = Math.min(top, (((high >>> row_bits) & (edge - 1)) + REACH) >> 5);
    const c0 = Math.max(0, ((low >>> (2 * row_bits)) - REACH) >> 5), c1 = Math.min(top, ((high >>> (2 * row_bits)) + REACH) >> 5);
    const begin = this.#stretch(from), box = ((((a0 * across + a1) * across + b0) * across + b1) * across + c0) * across + c1;
    if (begin === end && this.noted.stretch === end && this.noted.box === box) return;
    this.noted.box = box;
    this.noted.stretch = end;
    for (let stretch = begin; stretch <= end; ++stretch) {
      const word = stretch >> 5, bit = 1 << (stretch & 31);
      for (let c = c0; c <= c1; ++c)
        for (let b = b0; b <= b1; ++b)
          for (let a = a0; a <= a1; ++a) bits[(a + across * (b + across * c)) * WORDS + word] |= bit;
    }
  }

  /** @param {number} before @param {number} after voxels cut @returns {number[]} */
  between(before, after) {
    if (before === after) return [];
    const first = this.#stretch(Math.min(before, after)), last = this.#stretch(Math.max(before, after));
    const changed = [];
    for (let chunk = 0; chunk < this.count; ++chunk) {
      if (this.#touched(chunk * WORDS, first, last)) changed.push(chunk);
    }
    return changed;
  }

  #touched(at, first, last) {
    for (let word = first >> 5; word <= last >> 5; ++word) {
      let mask = 0xffffffff;
      if (word === first >> 5) mask &= 0xffffffff << (first & 31);
      if (word === last >> 5) mask &= 0xffffffff >>> (31 - (last & 31));
      if (this.bits[at + word] & mask) return true;
    }
    return false;
  }

  #stretch(ordinal) {
    return Math.min(STRETCHES - 1, Math.floor(ordinal * this.scale));
  }
}

// Which chunks of the grid look different at two moments: a bit for each chunk and each of 1024 stretches of the plan.

import {CHUNK} from './faces.js';

const STRETCHES = 1024, WORDS = STRETCHES / 32;
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
  }

  /** @param {number} chunk @returns {[number, number, number]} its first cell */
  corner(chunk) {
    const {across} = this;
    return [CHUNK * (chunk % across), CHUNK * (Math.floor(chunk / across) % across), CHUNK * Math.floor(chunk / (across * across))];
  }

  /** @param {number} cell @param {number} ordinal */
  add(cell, ordinal) {
    const {edge, across, row_bits} = this;  // an edge is a power of two
    const x = cell & (edge - 1), y = (cell >>> row_bits) & (edge - 1), z = cell >>> (2 * row_bits);
    const stretch = this.#stretch(ordinal), word = stretch >> 5, bit = 1 << (stretch & 31);
    if ((x + REACH) >> 5 === (x - REACH) >> 5 && (y + REACH) >> 5 === (y - REACH) >> 5 && (z + REACH) >> 5 === (z - REACH) >> 5) {
      this.bits[((x >> 5) + across * ((y >> 5) + across * (z >> 5))) * WORDS + word] |= bit;
      return;
    }
    const last = across - 1;
    const to = (value) => Math.min(last, (value + REACH) >> 5), from = (value) => Math.max(0, (value - REACH) >> 5);
    for (let c = from(z), c_end = to(z); c <= c_end; ++c)
      for (let b = from(y), b_end = to(y); b <= b_end; ++b)
        for (let a = from(x), a_end = to(x); a <= a_end; ++a) this.bits[(a + across * (b + across * c)) * WORDS + word] |= bit;
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

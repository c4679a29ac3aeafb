// The timeline of a job as it comes in: what each voxel is at the start, and which are cut when (docs/trajectory.md).

import {Varints, signed} from './varint.js';

const AIR = 0, KEEP = 1, REMOVE = 2;
const SEGMENT = 4096;
const LINE_END = 10;
export const NEVER = 0xffffffff;
const FINEST = 256;

/** A list of numbers that grows. */
class Growing {
  /** @param {any} Kind a typed array's class */
  constructor(Kind) {
    this.Kind = Kind;
    this.values = new Kind(1 << 16);
    this.length = 0;
  }

  /** @param {number} value */
  push(value) {
    if (this.length === this.values.length) {
      const larger = new this.Kind(2 * this.length);
      larger.set(this.values);
      this.values = larger;
    }
    this.values[this.length++] = value;
  }
}

/**
 * The decoded part. Cells are voxels, or where there are more than FINEST along an edge, blocks of them: a block goes with its last voxel.
 * `order[cell]`: 0 = nothing was there, else it stands until so many voxels are cut, NEVER = as long as is known.
 */
export class Timeline {
  /** @param {number} [finest] cells along an edge, at most */
  constructor(finest = FINEST) {
    this.finest = finest;
    this.unread = new Uint8Array(0);
    /** @type {any} the header line, once it is there */
    this.header = null;
    this.voxels = {air: 0, keep: 0, remove: 0};
    /** after keyframe k: voxels cut so far */
    this.removed = new Growing(Uint32Array);
    /** of keyframe k: 0 = a move, else 1 + direction, and 8 more where another row begins */
    this.kinds = new Growing(Uint8Array);
    this.ordinal = 0;
    this.filled = 0;
    this.last = {at: [0, 0, 0], direction: 0, length: 1};
  }

  get keyframes() {
    return this.kinds.length;
  }
  get started() {
    return this.header !== null && this.filled === this.n ** 3;
  }

  /**
   * @param {Uint8Array} bytes the next ones
   * @param {(cell: number, ordinal: number) => void} on_cut a cell that goes when so many voxels are cut
   */
  add(bytes, on_cut) {
    const all = new Uint8Array(this.unread.length + bytes.length);
    all.set(this.unread);
    all.set(bytes, this.unread.length);
    const numbers = new Varints(all);
    if (this.#read_header(numbers) && this.#read_runs(numbers)) this.#read_tokens(numbers, on_cut);
    this.unread = all.slice(numbers.at);
  }

  /** @param {Varints} numbers */
  #read_header(numbers) {
    if (this.header) return true;
    const end = numbers.bytes.indexOf(LINE_END);
    if (end < 0) return false;
    this.header = JSON.parse(new TextDecoder().decode(numbers.bytes.subarray(0, end)));
    numbers.at = end + 1;
    this.n = this.header.resolution;
    this.edge = Math.min(this.n, this.finest);
    this.block = this.n / this.edge;
    this.order = new Uint32Array(this.edge ** 3);
    this.label = new Uint8Array(this.edge ** 3);
    this.left = this.block > 1 ? new Uint16Array(this.edge ** 3) : null;
    return true;
  }

  /** @param {Varints} numbers */
  #read_runs(numbers) {
    const total = this.n ** 3;
    while (this.filled < total) {
      const run = numbers.next();
      if (run < 0) return false;
      this.#fill(run % 3, (run - (run % 3)) / 3 + 1);
    }
    return true;
  }

  /** @param {number} label @param {number} length */
  #fill(label, length) {
    this.voxels[label === AIR ? 'air' : label === KEEP ? 'keep' : 'remove'] += length;
    const end = this.filled + length;
    if (label !== AIR && this.block === 1) {
      this.order.fill(NEVER, this.filled, end);
      this.label.fill(label, this.filled, end);
    } else if (label !== AIR) {
      for (let at = this.filled; at < end; ++at) {
        const cell = this.cell(at % this.n, Math.floor(at / this.n) % this.n, Math.floor(at / (this.n * this.n)));
        this.order[cell] = NEVER;
        ++this.left[cell];
        if (this.label[cell] !== KEEP) this.label[cell] = label;
      }
    }
    this.filled = end;
  }

  /** @param {number} i @param {number} j @param {number} k of a voxel @returns {number} */
  cell(i, j, k) {
    if (this.block === 1) return i + this.n * (j + this.n * k);
    const {block, edge} = this;
    return Math.floor(i / block) + edge * (Math.floor(j / block) + edge * Math.floor(k / block));
  }

  /** @param {Varints} numbers @param {(cell: number, ordinal: number) => void} on_cut */
  #read_tokens(numbers, on_cut) {
    const {last, removed, kinds} = this;
    for (;;) {
      const begin = numbers.at, token = numbers.next();
      if (token < 0) return;
      if (kinds.length % SEGMENT === 0) {
        last.at = [0, 0, 0];
        last.direction = 0;
        last.length = 1;
      }
      if (token === 0) {
        kinds.push(0);
        removed.push(this.ordinal);
        continue;
      }
      let start = last.direction, {direction, length} = last;
      if (token > 1) {
        start = (token - 2) % 7;
        const rest = (token - 2 - start) / 7;
        direction = rest % 6;
        length = (rest - direction) / 6 + 1;
      }
      const at = [...last.at];
      if (start < 6) {
        at[start >> 1] += start & 1 ? 1 : -1;
      } else {
        for (let axis = 0; axis < 3; ++axis) {
          const gap = numbers.next();
          if (gap < 0) {
            numbers.at = begin;
            return;
          }
          at[axis] += signed(gap);
        }
      }
      const before = kinds.length ? kinds.values[kinds.length - 1] & 7 : 0;
      kinds.push((1 + direction) | (before === 1 + direction && start === direction ? 0 : 8));
      this.#cut(at, direction, length, on_cut);
      removed.push(this.ordinal);
      Object.assign(last, {at, direction, length});
    }
  }

  /** Cuts a run; `at` becomes its last voxel. */
  #cut(at, direction, length, on_cut) {
    const axis = direction >> 1, step = direction & 1 ? 1 : -1;
    for (let m = 0; m < length; ++m) {
      if (m > 0) at[axis] += step;
      const cell = this.cell(at[0], at[1], at[2]);
      ++this.ordinal;
      if (this.left && --this.left[cell] > 0) continue;
      this.order[cell] = this.ordinal;
      on_cut(cell, this.ordinal);
    }
  }
}

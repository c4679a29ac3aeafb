// The timeline of a job as it comes in: what each voxel is at the start, and which are cut when (docs/trajectory.md).

import {Varints, signed} from './varint.js';

const AIR = 0, KEEP = 1, REMOVE = 2;
const SEGMENT = 4096;
const LINE_END = 10;
const MOVE = 0, MILLED = 7;
export const NEVER = 0xffffff00;
const FINEST = 256;

/** A list of numbers that grows. */
class Growing {
  /** @param {any} Kind a typed array's class */
  constructor(Kind) {
    this.Kind = Kind;
    this.values = new Kind(1 << 16);
    this.length = 0;
  }

  /** Room for so many more. @param {number} more */
  reserve(more) {
    if (this.length + more <= this.values.length) return;
    const larger = new this.Kind(Math.max(2 * this.length, this.length + more));
    larger.set(this.values.subarray(0, this.length));
    this.values = larger;
  }

  /** There is room for it. @param {number} value */
  push(value) {
    this.values[this.length++] = value;
  }
}

/** @typedef {(first: number, last: number, from: number, to: number) => void} OnCut cells in a row that go, one after the other, when `from` to `to` voxels are cut */

/**
 * The decoded part. Cells are voxels, or where there are more than FINEST along an edge, blocks of them: a block goes with its last voxel.
 * `order[cell]`: 0 = nothing was there, else it stands until so many voxels are cut, from NEVER on = as long as is known: of a block
 * that is NEVER and how many of its voxels are still to be cut.
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
    /** of keyframe k: 0 = a move, 1 + direction of a cut, 7 = a cut of a milling tool, and 8 more where another row begins */
    this.kinds = new Growing(Uint8Array);
    /** @type {{keyframe: number, tool: number}[]} changes of tools: the keyframe that is one, and the tool's number in the header */
    this.changes = [];
    this.ordinal = 0;
    this.filled = 0;
    this.last = {x: 0, y: 0, z: 0, direction: 0, length: 1};
  }

  get keyframes() {
    return this.kinds.length;
  }
  get started() {
    return this.header !== null && this.filled === this.n ** 3;
  }

  /**
   * @param {Uint8Array} bytes the next ones
   * @param {OnCut} on_cut
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
    this.block_bits = Math.log2(this.block);
    this.order = new Uint32Array(this.edge ** 3);
    this.label = new Uint8Array(this.edge ** 3);
    return true;
  }

  /** @param {Varints} numbers */
  #read_runs(numbers) {
    const total = this.n ** 3;
    if (this.filled === total) return true;
    while (this.filled < total) {
      const run = numbers.next();
      if (run < 0) return false;
      this.#fill(run % 3, (run - (run % 3)) / 3 + 1);
    }
    if (this.block > 1) this.#stand_blocks();
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
      this.#fill_blocks(label, end);
    }
    this.filled = end;
  }

  /** From what is filled to there, a row at a time: blocks count their voxels, and are kept if any of these is. @param {number} label @param {number} end */
  #fill_blocks(label, end) {
    const {n, block, block_bits, order, label: labels} = this, row_bits = Math.log2(n);
    for (let at = this.filled, next = at; at < end; at = next) {
      const x = at & (n - 1), row = (at - x) / n, last = Math.min(n, x + end - at) - 1, cells = this.cell(0, row & (n - 1), row >> row_bits);
      const from = cells + (x >> block_bits), to = cells + (last >> block_bits);
      for (let cell = from; cell <= to; ++cell) order[cell] += block;
      order[from] -= x & (block - 1);
      order[to] -= block - 1 - (last & (block - 1));
      if (label === KEEP) labels.fill(KEEP, from, to + 1);
      next = at + last + 1 - x;
    }
  }

  #stand_blocks() {
    const {order, label} = this;
    for (let cell = 0; cell < order.length; ++cell) {
      if (order[cell] === 0) continue;
      order[cell] += NEVER;
      if (label[cell] !== KEEP) label[cell] = REMOVE;
    }
  }

  /** @param {number} i @param {number} j @param {number} k of a voxel @returns {number} */
  cell(i, j, k) {
    if (this.block === 1) return i + this.n * (j + this.n * k);
    const {block_bits, edge} = this;
    return (i >> block_bits) + edge * ((j >> block_bits) + edge * (k >> block_bits));
  }

  /** @param {Varints} numbers @param {OnCut} on_cut */
  #read_tokens(numbers, on_cut) {
    const {kinds, removed} = this, milled = Boolean(this.header.tools), bytes = numbers.bytes.length - numbers.at;
    kinds.reserve(bytes);
    removed.reserve(bytes);
    for (;;) {
      const begin = numbers.at;
      if (kinds.length % SEGMENT === 0) Object.assign(this.last, {x: 0, y: 0, z: 0, direction: 0, length: 1});
      const kind = milled ? this.#read_milled(numbers, on_cut) : this.#read_token(numbers, on_cut);
      if (kind < 0) {  // it does not end yet
        numbers.at = begin;
        return;
      }
      kinds.push(kind);
      removed.push(this.ordinal);
    }
  }

  /** @param {Varints} numbers @param {OnCut} on_cut @returns {number} the kind of the next keyframe; below 0: not all of it is there */
  #read_token(numbers, on_cut) {
    const token = numbers.next();
    if (token <= 0) return token;
    const before = this.kinds.length ? this.kinds.values[this.kinds.length - 1] & 7 : 0;
    const start = this.#read_run(token, numbers, on_cut);
    if (start < 0) return -1;
    const {direction} = this.last;
    return (1 + direction) | (before === 1 + direction && start === direction ? 0 : 8);
  }

  /** The same of a plan with milling tools. @param {Varints} numbers @param {OnCut} on_cut @returns {number} */
  #read_milled(numbers, on_cut) {
    const token = numbers.next();
    if (token <= 0) return token;
    if (token === 1) {
      const tool = numbers.next();
      if (tool < 0) return -1;
      this.changes.push({keyframe: this.kinds.length, tool});
      return MOVE;
    }
    const begin = numbers.at;
    for (let left = token - 2; left > 0; --left) {  // is all of it there?
      const run = numbers.next(), places = run > 1 && (run - 2) % 7 === 6 ? 3 : 0;
      if (run < 0) return -1;
      for (let place = 0; place < places; ++place) if (numbers.next() < 0) return -1;
    }
    numbers.at = begin;
    for (let left = token - 2; left > 0; --left) this.#read_run(numbers.next(), numbers, on_cut);
    const before = this.kinds.length ? this.kinds.values[this.kinds.length - 1] & 7 : 0;
    return MILLED | (before === MILLED ? 0 : 8);
  }

  /**
   * Cuts the run of a token.
   * @param {number} token @param {Varints} numbers @param {OnCut} on_cut
   * @returns {number} how it begins from the end of the last one: a direction, or 6 for anywhere; below 0: not all of it is there
   */
  #read_run(token, numbers, on_cut) {
    const {last} = this;
    let start = last.direction, {direction, length} = last, x = 0, y = 0, z = 0;  // from the last cut's end
    if (token > 1) {
      start = (token - 2) % 7;
      const rest = (token - 2 - start) / 7;
      direction = rest % 6;
      length = (rest - direction) / 6 + 1;
    }
    if (start < 6) {
      const step = start & 1 ? 1 : -1;
      if (start < 2) x = step;
      else if (start < 4) y = step;
      else z = step;
    } else {
      const [a, b, c] = [numbers.next(), numbers.next(), numbers.next()];
      if (c < 0) return -1;
      x = signed(a);
      y = signed(b);
      z = signed(c);
    }
    last.x += x;
    last.y += y;
    last.z += z;
    last.direction = direction;
    last.length = length;
    if (this.block > 1) this.#cut_blocks(on_cut);
    else this.#cut_cells(on_cut);
    return start;
  }

  /** Cuts the last run; its place becomes that of its last voxel. @param {OnCut} on_cut */
  #cut_cells(on_cut) {
    const {last, n, order} = this, axis = last.direction >> 1, way = last.direction & 1 ? 1 : -1;
    const step = way * (axis === 0 ? 1 : axis === 1 ? n : n * n), first = last.x + n * (last.y + n * last.z), from = this.ordinal + 1;
    let cell = first;
    for (let left = last.length; left > 0; --left, cell += step) order[cell] = ++this.ordinal;
    this.#go_on(axis, way * (last.length - 1));
    on_cut(first, cell - step, from, this.ordinal);
  }

  /** The same where cells are blocks: each goes with its last voxel. @param {OnCut} on_cut */
  #cut_blocks(on_cut) {
    const {last, block, edge, order} = this, axis = last.direction >> 1, up = last.direction & 1;
    const step = (up ? 1 : -1) * (axis === 0 ? 1 : axis === 1 ? edge : edge * edge), place = (axis === 0 ? last.x : axis === 1 ? last.y : last.z) & (block - 1);
    let cell = this.cell(last.x, last.y, last.z), taken = up ? block - place : place + 1;  // voxels of the run in its first block
    let first = -1, from = 0, final = 0;
    for (let rest = last.length; rest > 0; rest -= taken, taken = block, cell += step) {
      if (taken > rest) taken = rest;
      this.ordinal += taken;
      const left = order[cell] - taken;
      order[cell] = left > NEVER ? left : this.ordinal;
      if (left > NEVER) continue;
      if (first < 0) {
        first = cell;
        from = this.ordinal;
      }
      final = cell;
    }
    this.#go_on(axis, (up ? 1 : -1) * (last.length - 1));
    if (first >= 0) on_cut(first, final, from, this.ordinal);
  }

  /** @param {number} axis @param {number} steps */
  #go_on(axis, steps) {
    if (axis === 0) this.last.x += steps;
    else if (axis === 1) this.last.y += steps;
    else this.last.z += steps;
  }
}

// Where the joints are at each keyframe: pieces of the .sct file (docs/trajectory.md), fetched when the playhead comes there.

import {get} from '../wire/token.js';
import {Varints, signed} from './varint.js';

const TAIL = 24 + 4 + 64, ENTRY = 24;
const HEAD = 1 + 4 + 8 + 4 + 4;
const KEPT = 24;
const QUANTUM = 1e-7;

/** What a token says behind itself is skipped. @param {Varints} numbers @param {boolean} milled of a plan with milling tools */
function skip_token(numbers, milled) {
  const token = numbers.next();
  if (milled && token % 4 > 1) numbers.next();  // a cut's voxels, a change's tool
  if (!milled && token > 1 && (token - 2) % 7 === 6) for (let axis = 0; axis < 3; ++axis) numbers.next();
}

/** @param {Uint8Array} body @param {number} count keyframes @param {number} joints @param {boolean} milled @returns {Float64Array[]} one column a joint */
export function decode_joints(body, count, joints, milled) {
  const numbers = new Varints(body);
  for (let at = 0; at < count; ++at) skip_token(numbers, milled);
  return Array.from({length: joints}, () => read_column(numbers, count));
}

function read_column(numbers, count) {
  const order = numbers.bytes[numbers.at++], sums = [0, 0, 0], column = new Float64Array(count);
  let zeros = 0;
  for (let at = 0; at < count; ++at) {
    let value = 0;
    if (zeros > 0) {
      --zeros;
    } else {
      value = signed(numbers.next());
      if (value === 0) zeros = numbers.next();
    }
    for (let level = order; level-- > 0;) value = sums[level] += value;
    column[at] = value * QUANTUM;
  }
  return column;
}

/** The joints of one finished job. */
export class Joints {
  /** @param {string} job @param {any} header of its trajectory */
  constructor(job, header) {
    this.path = `/v1/artifacts/${job}/trajectory?format=binary`;
    /** @type {string[]} */
    this.names = header.joints;
    /** @type {number[]} */
    this.home = header.home;
    this.milled = Boolean(header.tools);
    /** @type {Promise<{offset: number, first: number}[]> | null} */
    this.index = null;
    /** @type {Map<number, Promise<Float64Array[]>>} the last ones used at the end */
    this.segments = new Map();
  }

  /**
   * @param {number} at keyframes, with a share of the motion to the next one
   * @returns {Promise<number[]>} one value a joint
   */
  async at(at) {
    const whole = Math.floor(at), share = at - whole;
    const before = whole === 0 ? this.home : await this.#of_keyframe(whole - 1);
    if (share === 0) return before;
    const after = await this.#of_keyframe(whole);
    return before.map((value, joint) => value + share * (after[joint] - value));
  }

  /** @param {number} keyframe @returns {Promise<{first: number, columns: Float64Array[]}>} the segment that has it */
  async around(keyframe) {
    this.index ??= this.#read_index();
    const index = await this.index;
    let number = 0;
    while (number + 2 < index.length && index[number + 1].first <= keyframe) ++number;
    return {first: index[number].first, columns: await this.#segment(number, index)};
  }

  /** @param {number} from @param {number} to keyframes @returns {Promise<number[][]>} the joints at each, both ends included */
  async between(from, to) {
    const values = [];
    for (let at = from; at <= to; ++at) values.push(await this.at(at));
    return values;
  }

  async #of_keyframe(keyframe) {
    const {first, columns} = await this.around(keyframe);
    return columns.map((column) => column[Math.min(column.length - 1, keyframe - first)]);
  }

  #segment(number, index) {
    const kept = this.segments.get(number) ?? this.#fetch_segment(index[number], index[number + 1]);
    this.segments.delete(number);
    this.segments.set(number, kept);
    if (this.segments.size > KEPT) this.segments.delete(this.segments.keys().next().value);
    return kept;
  }

  async #fetch_segment(segment, next) {
    const bytes = await this.#range(`bytes=${segment.offset}-${next.offset - 1}`);
    return decode_joints(bytes.subarray(HEAD), next.first - segment.first, this.names.length, this.milled);
  }

  async #read_index() {
    const tail = await this.#range(`bytes=-${TAIL}`);
    const number_at = (bytes, at) => Number(new DataView(bytes.buffer, bytes.byteOffset).getBigUint64(at, true));
    const keyframes = number_at(tail, 0), offset = number_at(tail, 16);
    const entries = await this.#range(`bytes=${offset}-`);
    const index = [];
    for (let at = 5; at + ENTRY <= entries.length - TAIL; at += ENTRY) {
      index.push({offset: number_at(entries, at), first: number_at(entries, at + 8)});
    }
    return [...index, {offset, first: keyframes}];
  }

  async #range(range) {
    return new Uint8Array(await (await get(this.path, {Range: range})).arrayBuffer());
  }
}

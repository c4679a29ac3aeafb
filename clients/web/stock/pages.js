// Faces of all chunks in one buffer, drawn in one call: each chunk has pages of it, and only pages that changed go to the graphics card.

import {BufferAttribute, BufferGeometry, IntType} from '../vendor/libraries.js';

const FACES = 64;            // of a page
const WORDS = FACES * 4 * 2;  // each of a face's four corners says it again: two words
const FIRST_PAGES = 256;
const NOTHING = 0xffffffff;
const CORNERS = [0, 1, 2, 0, 2, 3];  // of two triangles

/** @type {Map<number, BufferAttribute>} by pages: the same for all buffers */
const corners_of = new Map();

export class Pages {
  constructor() {
    /** @type {Map<number, number[]>} */
    this.of_chunk = new Map();
    /** @type {number[]} */
    this.free = [];
    /** @type {Set<number>} pages that the graphics card does not have yet */
    this.changed = new Set();
    this.used = 0;
    this.geometry = new BufferGeometry();
    this.#allocate(FIRST_PAGES, null);
    this.geometry.setDrawRange(0, 0);
  }

  /** @returns {number} faces that are there now */
  get faces() {
    let sum = 0;
    for (const pages of this.of_chunk.values()) sum += pages.length * FACES;
    return sum;
  }

  clear() {
    this.of_chunk.clear();
    this.free = [];
    this.changed.clear();
    this.used = 0;
    this.geometry.setDrawRange(0, 0);
  }

  /** Before a picture: what changed since the last one that they were in, however often. */
  send() {
    if (this.changed.size === 0) return;
    this.attribute.clearUpdateRanges();
    for (const page of this.changed) this.attribute.addUpdateRange(page * WORDS, WORDS);
    this.attribute.needsUpdate = true;
  }

  /** They are in a picture, so the graphics card has them. */
  sent() {
    this.changed.clear();
  }

  /** @param {number} chunk @param {Uint32Array} faces all that it has now, two words each */
  put(chunk, faces) {
    const pages = this.of_chunk.get(chunk) ?? [];
    const needed = Math.ceil(faces.length / 2 / FACES);
    while (pages.length > needed) this.#release(/** @type {number} */ (pages.pop()));
    while (pages.length < needed) pages.push(this.#take());
    this.of_chunk.set(chunk, pages);
    pages.forEach((page, at) => this.#write(page, faces.subarray(at * FACES * 2, (at + 1) * FACES * 2)));
    this.geometry.setDrawRange(0, this.used * FACES * 6);
  }

  #write(page, faces) {
    const words = this.words;
    let to = page * WORDS;
    for (let at = 0; at < faces.length; at += 2) {
      const place = faces[at], look = faces[at + 1];
      for (let corner = 0; corner < 4; ++corner) {
        words[to++] = place;
        words[to++] = look;
      }
    }
    words.fill(NOTHING, to, (page + 1) * WORDS);
    this.changed.add(page);
  }

  #release(page) {
    this.#write(page, []);
    this.free.push(page);
  }

  #take() {
    const page = this.free.pop() ?? this.used++;
    if (page >= this.pages) this.#allocate(2 * this.pages, this.words);
    return page;
  }

  #allocate(pages, before) {
    this.pages = pages;
    this.words = new Uint32Array(pages * WORDS).fill(NOTHING);
    if (before) this.words.set(before);
    this.geometry.dispose();
    this.attribute = new BufferAttribute(this.words, 2);
    this.attribute.gpuType = IntType;
    this.geometry.setAttribute('face', this.attribute);
    this.geometry.setIndex(corners_for(pages));
  }
}

function corners_for(pages) {
  if (!corners_of.has(pages)) {
    const corners = new Uint32Array(pages * FACES * 6);
    for (let face = 0, at = 0; face < pages * FACES; ++face) {
      for (const corner of CORNERS) corners[at++] = 4 * face + corner;
    }
    corners_of.set(pages, new BufferAttribute(corners, 1));
  }
  return corners_of.get(pages);
}

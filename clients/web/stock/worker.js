// Beside the page: decodes the timeline and makes the faces of what stands. One message in, at most one out.

import {outline} from '../export/outline.js';
import {NEVER, Timeline} from '../plan/timeline.js';
import {Chunks} from './chunks.js';
import {Standing} from './faces.js';
import {first_on_ray} from './ray.js';

let timeline = new Timeline();
/** @type {Chunks | null} */
let chunks = null;
/** @type {Standing | null} */
let standing = null;
/** @type {import('./faces.js').Moment} */
let moment = {removed: 0, final: false, chosen: null};
/** @type {[number, number, number, number][]} of the piece in which the grid became known */
let cuts_before = [];
let told = 0;

/** @type {Record<string, (message: any) => void>} */
const on = {
  reset() {
    timeline = new Timeline();
    chunks = standing = null;
    moment = {removed: 0, final: false, chosen: null};
    told = 0;
  },

  add({generation, bytes}) {
    const began = timeline.started;
    timeline.add(bytes, (first, last, from, to) => (chunks ? chunks.add(first, last, from, to) : cuts_before.push([first, last, from, to])));
    if (!timeline.started) return postMessage({kind: 'grown', generation, head: null, keyframes: 0, removed: new Uint32Array(0), kinds: new Uint8Array(0), changes: []});
    if (!chunks) {
      chunks = new Chunks(timeline.edge, timeline.voxels.remove);
      standing = new Standing(timeline);
      for (const [first, last, from_cut, to_cut] of cuts_before) chunks.add(first, last, from_cut, to_cut);
      cuts_before = [];
    }
    const from = told;
    told = timeline.keyframes;
    const head = began ? null : {header: timeline.header, voxels: timeline.voxels, edge: timeline.edge, block: timeline.block};
    const removed = timeline.removed.values.slice(from, told), kinds = timeline.kinds.values.slice(from, told);
    const changes = timeline.changes.filter(({keyframe}) => keyframe >= from);
    postMessage({kind: 'grown', generation, head, keyframes: told, removed, kinds, changes}, [removed.buffer, kinds.buffer]);
  },

  /** The moment, or with `all` everything anew: another picture of the same moment. */
  show({generation, removed, final, chosen, all}) {
    if (!chunks) return postMessage({kind: 'faces', generation, removed, chunks: []});
    const begin = performance.now(), wanted = all ? [...Array(chunks.count).keys()] : chunks.between(moment.removed, removed);
    moment = {removed, final, chosen: chosen && new Set(chosen.map(([i, j, k]) => timeline.cell(i, j, k)))};
    for (const chunk of wanted) standing.update(chunks.corner(chunk), removed);
    const made = wanted.map((chunk) => ({chunk, ...standing.faces(chunks.corner(chunk), moment)}));
    postMessage({kind: 'faces', generation, removed, final, chunks: made, made_ms: performance.now() - begin}, made.map(({faces}) => faces.buffer));
  },

  /** What stands at a moment, as rectangles. */
  outline({generation, ticket, moment: {removed, final, what}}) {
    const body = timeline.started ? outline(timeline, {removed, final, what}) : null;
    postMessage({kind: 'outlined', generation, ticket, body}, body ? body.kinds.flatMap(({corners, sides}) => [corners.buffer, sides.buffer]) : []);
  },

  /** What a ray in cells hits first. */
  pick({ticket, origin, direction, clip}) {
    const cell = timeline.started ? first_on_ray(timeline, moment.removed, {origin, direction, clip}) : null;
    if (!cell) return postMessage({kind: 'picked', ticket, hit: null});
    const at = cell[0] + timeline.edge * (cell[1] + timeline.edge * cell[2]);
    const order = timeline.order[at];
    postMessage({kind: 'picked', ticket, hit: {cell, label: timeline.label[at], ordinal: order >= NEVER ? null : order}});
  },
};

onmessage = (message) => on[message.data.kind](message.data);

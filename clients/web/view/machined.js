// The surface as milling tools leave it: the artifact `surface`, coloured by what stands above the surface that was ordered.

import {BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshLambertMaterial} from '../vendor/libraries.js';
import {get} from '../wire/token.js';

const VERTEX_BYTES = 19, FACE_BYTES = 13, COLOUR_AT = 16;

/** Shows that of one job, loaded when it is first wanted. */
export class Machined {
  /** @param {import('./view.js').View} view @param {(sentence: string) => void} note what is told meanwhile, empty at the end */
  constructor(view, note) {
    this.view = view;
    this.note = note;
    /** of the job that is to be shown or on its way @type {string | null} */
    this.job = null;
    /** @type {{job: string, mesh: Mesh} | null} the last one that came */
    this.loaded = null;
  }

  /** @param {string | null | undefined} job null: the stock again */
  async show(job) {
    if (this.job === (job ?? null)) return;
    this.job = job ?? null;
    if (!job || this.loaded?.job === job) return this.view.show_machined(job ? this.loaded.mesh : null);
    this.view.show_machined(null);
    this.note('The surface as machined is being measured\u2026');
    try {
      const mesh = read_surface(await (await get(`/v1/artifacts/${job}/surface`)).arrayBuffer());
      this.loaded = {job, mesh};
      if (this.job !== job) return;
      this.view.show_machined(mesh);
      this.note('');
    } catch (error) {
      if (this.job === job) this.note(`The surface as machined is not shown: ${error.message}`);
    }
  }
}

/**
 * @param {ArrayBuffer} ply as the server writes it (docs/milling.md)
 * @returns {Mesh} metres, in the stock's frame. Throws an Error for other bytes.
 */
function read_surface(ply) {
  const text = new TextDecoder('latin1').decode(ply.slice(0, 1000)), end = text.indexOf('end_header\n');
  const count = (element) => Number(new RegExp(`element ${element} (\\d+)`).exec(text)?.[1]);
  const vertices = count('vertex'), faces = count('face'), begin = end + 'end_header\n'.length;
  if (end < 0 || begin + vertices * VERTEX_BYTES + faces * FACE_BYTES !== ply.byteLength) throw new Error('the surface is not one that this page reads');
  const view = new DataView(ply), places = new Float32Array(3 * vertices), colours = new Uint8Array(3 * vertices), corners = new Uint32Array(3 * faces);
  for (let vertex = 0, at = begin; vertex < vertices; ++vertex, at += VERTEX_BYTES) {
    for (let axis = 0; axis < 3; ++axis) {
      places[3 * vertex + axis] = view.getFloat32(at + 4 * axis, true);
      colours[3 * vertex + axis] = view.getUint8(at + COLOUR_AT + axis);
    }
  }
  for (let face = 0, at = begin + vertices * VERTEX_BYTES; face < faces; ++face, at += FACE_BYTES)
    for (let corner = 0; corner < 3; ++corner) corners[3 * face + corner] = view.getUint32(at + 1 + 4 * corner, true);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(places, 3));
  geometry.setAttribute('color', new BufferAttribute(colours, 3, true));
  geometry.setIndex(new BufferAttribute(corners, 1));
  geometry.computeVertexNormals();
  return new Mesh(geometry, new MeshLambertMaterial({vertexColors: true, side: DoubleSide}));
}

// The faces of the stock, those that look to one side in a mesh of their own: where none of a side can be seen, none is drawn.

import {Group, Mesh} from '../vendor/libraries.js';
import {Pages} from './pages.js';

const SIDES = 6;  // -x, x, -y, y, -z, z

export class Shell {
  /** @param {import('../vendor/libraries.js').ShaderMaterial} material */
  constructor(material) {
    this.sides = Array.from({length: SIDES}, () => new Pages());
    this.meshes = this.sides.map(({geometry}) => new Mesh(geometry, material));
    /** in cells */
    this.body = new Group();
    this.meshes.forEach((mesh, side) => {
      mesh.frustumCulled = false;
      mesh.onAfterRender = () => this.sides[side].sent();
      this.body.add(mesh);
    });
  }

  /** @returns {number} room for faces that is taken */
  get faces() {
    return this.sides.reduce((sum, {faces}) => sum + faces, 0);
  }

  clear() {
    for (const side of this.sides) side.clear();
  }

  /** @param {{chunk: number, faces: Uint32Array, ends: number[]}[]} changed as `Standing.faces` gives them */
  put(changed) {
    for (const {chunk, faces, ends} of changed) this.sides.forEach((pages, side) => pages.put(chunk, faces.subarray(ends[side - 1] ?? 0, ends[side])));
  }

  /** Before a picture: what changed since the last one. */
  send() {
    for (const side of this.sides) side.send();
  }

  /** @param {import('../vendor/libraries.js').Vector3 | null} eye in cells; null: whatever looks to any side is to be seen @param {number} edge cells */
  show_to(eye, edge) {
    this.meshes.forEach((mesh, side) => {
      const place = eye?.getComponent(side >> 1);
      mesh.visible = !eye || (side & 1 ? place > 0 : place < edge);
    });
  }
}

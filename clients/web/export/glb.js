// A body as a glTF 2.0 binary: corners as whole numbers of cells (KHR_mesh_quantization), one part for each kind of face.

import {COLOURS, filled_kinds, linear, stand} from './place.js';

const MAGIC = 0x46546c67, JSON_CHUNK = 0x4e4f534a, BINARY_CHUNK = 0x004e4942;
const BYTE = 5120, UNSIGNED_SHORT = 5123, UNSIGNED_INT = 5125, ARRAYS = 34962, INDICES = 34963;
const CORNER_BYTES = 12;  // three unsigned shorts, a gap, three bytes of the normal, a gap

/**
 * @param {import('./outline.js').Outline} body
 * @param {{size_m: number, name: string}} of `size_m`: of the grid
 * @returns {Blob} throws an Error with a sentence where nothing stands
 */
export function to_glb(body, {size_m, name}) {
  const kinds = filled_kinds(body), {cell_m, lowest} = stand(body, size_m);
  const pieces = [], views = [], accessors = [], primitives = [];
  let bytes = 0;
  const add_view = (array, more) => {
    pieces.push(array);
    views.push({buffer: 0, byteOffset: bytes, byteLength: array.byteLength, ...more});
    bytes += array.byteLength;
    return views.length - 1;
  };
  kinds.forEach(({corners, sides}, material) => {
    const count = 4 * sides.length;
    const vertices = add_view(vertices_of(corners, sides), {byteStride: CORNER_BYTES, target: ARRAYS});
    const [position, normal, indices] = [0, 1, 2].map((more) => accessors.length + more);
    accessors.push(
      {bufferView: vertices, componentType: UNSIGNED_SHORT, count, type: 'VEC3', ...bounds_of(corners)},
      {bufferView: vertices, byteOffset: 8, componentType: BYTE, normalized: true, count, type: 'VEC3'},
      {bufferView: add_view(triangles_of(sides.length), {target: INDICES}), componentType: UNSIGNED_INT, count: 6 * sides.length, type: 'SCALAR'});
    primitives.push({attributes: {POSITION: position, NORMAL: normal}, indices, material});
  });
  const half = body.edge / 2, turned = Math.SQRT1_2;
  return pack({
    asset: {version: '2.0', generator: 'sculptd'},
    extensionsUsed: ['KHR_mesh_quantization'], extensionsRequired: ['KHR_mesh_quantization'],
    scene: 0, scenes: [{nodes: [0]}],
    // (x, y, z) of the stock becomes (x, z, -y).
    nodes: [{name, mesh: 0, rotation: [-turned, 0, 0, turned], scale: [cell_m, cell_m, cell_m], translation: [-half * cell_m, -lowest * cell_m, half * cell_m]}],
    meshes: [{name, primitives}],
    materials: kinds.map((kind) => ({name: kind.name, pbrMetallicRoughness: {baseColorFactor: [...COLOURS[kind.name].map(linear), 1], metallicFactor: 0, roughnessFactor: 0.9}})),
    buffers: [{byteLength: bytes}], bufferViews: views, accessors,
  }, pieces, bytes);
}

function vertices_of(corners, sides) {
  const out = new ArrayBuffer((corners.length / 3) * CORNER_BYTES), shorts = new Uint16Array(out), signed = new Int8Array(out);
  for (let vertex = 0; vertex < corners.length / 3; ++vertex) {
    shorts.set(corners.subarray(3 * vertex, 3 * vertex + 3), (vertex * CORNER_BYTES) / 2);
    const side = sides[vertex >> 2];
    signed[vertex * CORNER_BYTES + 8 + (side >> 1)] = side & 1 ? 127 : -127;
  }
  return new Uint8Array(out);
}

function triangles_of(rectangles) {
  const out = new Uint32Array(6 * rectangles);
  for (let at = 0; at < rectangles; ++at) out.set([0, 1, 2, 0, 2, 3].map((corner) => 4 * at + corner), 6 * at);
  return new Uint8Array(out.buffer);
}

function bounds_of(corners) {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  corners.forEach((value, at) => {
    min[at % 3] = Math.min(min[at % 3], value);
    max[at % 3] = Math.max(max[at % 3], value);
  });
  return {min, max};
}

function pack(document, pieces, bytes) {
  const text = new TextEncoder().encode(JSON.stringify(document)), padding = ' '.repeat((4 - (text.length % 4)) % 4);
  const words = (...values) => new Uint32Array(values);  // glTF is little-endian, as all that runs a browser
  const json_bytes = text.length + padding.length;
  return new Blob([
    words(MAGIC, 2, 12 + 8 + json_bytes + 8 + bytes), words(json_bytes, JSON_CHUNK), text, padding, words(bytes, BINARY_CHUNK), ...pieces,
  ], {type: 'model/gltf-binary'});
}

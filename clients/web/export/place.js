// How an exported body stands: in metres, y up, on the floor, its grid around the middle. And what its faces look like.

import {KINDS} from './outline.js';

/** sRGB, as the page draws them, by the kinds of faces. */
export const COLOURS = {cut: [0xe9, 0xe2, 0xd4], raw: [0x9a, 0x8f, 0x80], residue: [0xd1, 0x49, 0x5b]};

/** @param {number} value of a colour's part, 0 to 255 @returns {number} of light, 0 to 1 */
export function linear(value) {
  const share = value / 255;
  return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
}

/**
 * @param {import('./outline.js').Outline} body
 * @param {number} size_m of the grid
 * @returns {{cell_m: number, lowest: number}} `lowest`: of the body, in cells
 */
export function stand(body, size_m) {
  let lowest = body.edge;
  for (const {corners} of body.kinds) for (let at = 2; at < corners.length; at += 3) lowest = Math.min(lowest, corners[at]);
  return {cell_m: size_m / body.edge, lowest};
}

/** @param {import('./outline.js').Outline} body @returns {{name: string, corners: Uint16Array, sides: Uint8Array}[]} those that have faces */
export function filled_kinds(body) {
  const kinds = KINDS.map((name, at) => ({name, ...body.kinds[at]})).filter(({sides}) => sides.length > 0);
  if (kinds.length === 0) throw new Error('nothing stands at this moment: go to another one');
  return kinds;
}

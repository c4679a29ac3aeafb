// Tools as solids about the z axis of the link that carries them, the spindle's side at z = 0, the tip away from it. Metres.

import {CylinderGeometry, Mesh, MeshLambertMaterial, SphereGeometry} from '../vendor/libraries.js';

const CUTTER = '#e0b04a', HOLDER = '#59636e';

/**
 * A thin tool, and what the cell says is around it.
 * @param {{ball_radius_m: number, shank_radius_m: number, stickout_m: number}} tool of the trajectory's header
 * @param {{length_m: number, radius_m: number, end_radius_m?: number}[]} holder sections from the link's origin on
 * @returns {Mesh[]}
 */
export function thin_tool({ball_radius_m, shank_radius_m, stickout_m}, holder) {
  const solids = [ball(stickout_m, ball_radius_m)];
  if (stickout_m > 0 && shank_radius_m > 0) solids.push(section(0, stickout_m, [shank_radius_m, shank_radius_m], CUTTER));
  let from = 0;
  for (const {length_m, radius_m, end_radius_m = radius_m} of holder) {
    solids.push(section(from, from + length_m, [radius_m, end_radius_m], HOLDER));
    from += length_m;
  }
  return solids;
}

/**
 * A milling tool; a rounded rim is drawn as a chamfer.
 * @param {{cutter: {kind: string, diameter_m: number, corner_radius_m?: number, flute_m: number}, body: {length_m: number, radius_m: number,
 *   end_radius_m?: number}[], stickout_m: number}} tool of the trajectory's header
 * @returns {Mesh[]}
 */
export function milling_tool({cutter, body, stickout_m}) {
  const radius = cutter.diameter_m / 2, rim = cutter.kind === 'ball' ? radius : cutter.corner_radius_m ?? 0;
  let top = stickout_m - cutter.flute_m;
  const solids = [section(top, stickout_m - rim, [radius, radius], CUTTER)];
  if (cutter.kind === 'ball') solids.push(ball(stickout_m - radius, radius));
  else if (rim > 0) solids.push(section(stickout_m - rim, stickout_m, [radius, radius - rim], CUTTER));
  for (const {length_m, radius_m, end_radius_m = radius_m} of body) {  // towards the spindle
    solids.push(section(top - length_m, top, [end_radius_m, radius_m], HOLDER));
    top -= length_m;
  }
  return solids;
}

function ball(z, radius) {
  const mesh = new Mesh(new SphereGeometry(radius, 24, 16), new MeshLambertMaterial({color: CUTTER}));
  mesh.position.z = z;
  return mesh;
}

// A cylinder or cone from one height to another, with the radius at each.
function section(from, to, [radius, end_radius], colour) {
  const mesh = new Mesh(new CylinderGeometry(end_radius, radius, to - from, 32), new MeshLambertMaterial({color: colour}));
  mesh.rotation.x = Math.PI / 2;
  mesh.position.z = (from + to) / 2;
  return mesh;
}

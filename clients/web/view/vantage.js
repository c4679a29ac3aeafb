// From where the camera looks.

import {Vector3} from '../vendor/libraries.js';

/** From where, in the stock's frame. */
const SIDES = {front: [0, -1, 0.0001], back: [0, 1, 0.0001], left: [-1, 0, 0.0001], right: [1, 0, 0.0001], top: [0, -0.0001, 1], bottom: [0, -0.0001, -1]};
/** The whole cell is seen so far to the side of the line from the robot over the stock (rad), and from so high for each metre away. */
const UP = new Vector3(0, 0, 1), ASIDE = -0.88, HIGH = 0.47;

/**
 * @param {string} side of SIDES, or `cell`, or `stock`
 * @param {Vector3} centre of the stock (m, in the world) @param {number} size_m its edge
 * @param {import('./robot.js').Robot | null} robot
 * @returns {{target: Vector3, direction: Vector3, radius: number}} what to look at, from where it is looked at (of length 1), and how far around it is to be seen
 */
export function vantage(side, centre, size_m, robot) {
  if (side !== 'cell' || !robot) return {target: centre, direction: new Vector3(...(SIDES[side] ?? [0.62, -0.85, 0.5])).normalize(), radius: size_m};
  // Stock and robot, from the side of the stock that the robot is not on.
  const {base, low, high} = robot.place(), half = size_m / 2;
  low.min(centre.clone().subScalar(half));
  high.max(centre.clone().addScalar(half));
  const away = centre.clone().sub(base).setZ(0);
  if (away.length() < half) away.set(1, 0, 0);
  const direction = away.normalize().applyAxisAngle(UP, ASIDE).setZ(HIGH).normalize();
  return {target: low.clone().add(high).divideScalar(2), direction, radius: Math.max(high.distanceTo(low) / 2, 3 * half)};
}

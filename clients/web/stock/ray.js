// The first standing cell on a straight line: from face to face through the grid (Amanatides and Woo, 1987).

/**
 * @param {import('../plan/timeline.js').Timeline} timeline
 * @param {number} removed voxels cut so far
 * @param {{origin: number[], direction: number[], clip: number[] | null}} ray in cells; `clip`: a plane [a, b, c, d], nothing is seen where
 *   a x + b y + c z > d
 * @returns {[number, number, number] | null}
 */
export function first_on_ray(timeline, removed, ray) {
  const {order, edge} = timeline, {origin, direction, clip} = ray;
  let enter = 0, leave = Infinity;
  for (let axis = 0; axis < 3; ++axis) {
    const [a, b] = [0, edge].map((face) => (face - origin[axis]) / direction[axis]);
    if (direction[axis] === 0) {
      if (origin[axis] < 0 || origin[axis] >= edge) return null;
      continue;
    }
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
  }
  if (clip) {
    const away = clip[0] * origin[0] + clip[1] * origin[1] + clip[2] * origin[2] - clip[3];
    const speed = clip[0] * direction[0] + clip[1] * direction[1] + clip[2] * direction[2];
    if (speed === 0 && away > 0) return null;
    if (speed < 0) enter = Math.max(enter, -away / speed);
    if (speed > 0) leave = Math.min(leave, -away / speed);
  }
  if (enter >= leave) return null;
  const start = origin.map((value, axis) => value + (enter + 1e-6) * direction[axis]);
  const cell = start.map((value) => Math.min(edge - 1, Math.max(0, Math.floor(value))));
  const step = direction.map(Math.sign);
  const next = cell.map((value, axis) => (step[axis] === 0 ? Infinity : (value + (step[axis] > 0 ? 1 : 0) - origin[axis]) / direction[axis]));
  const pace = direction.map((value) => Math.abs(1 / value));
  for (let at = enter; at < leave;) {
    if (order[cell[0] + edge * (cell[1] + edge * cell[2])] > removed) return /** @type {[number, number, number]} */ (cell);
    const axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : next[1] < next[2] ? 1 : 2;
    at = next[axis];
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= edge) return null;
    next[axis] += pace[axis];
  }
  return null;
}

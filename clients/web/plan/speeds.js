// How fast joints would go if each motion took as long as its slowest joint needs: there is no time law yet.

/**
 * @param {Float64Array[]} columns where each joint is, keyframe by keyframe
 * @param {number[]} greatest rad/s or m/s by joint
 * @param {number} points at most so many stretches of keyframes are told apart
 * @returns {{at: number[], shares: number[][], slowest: number[], seconds: number} | null} by stretch its first motion and, by joint, the mean share of the
 *   greatest speed in per cent; by joint the share of the time in which it is the slowest; all of the time. null: some greatest speed is not known
 */
export function speed_shares(columns, greatest, points) {
  if (!greatest.every((value) => value > 0)) return null;
  const motions = columns[0].length - 1, step = Math.max(1, Math.ceil(motions / points));
  const at = [], shares = columns.map(() => /** @type {number[]} */ ([])), slowest = columns.map(() => 0);
  let seconds = 0;
  for (let first = 0; first < motions; first += step) {
    const needed = columns.map(() => 0);
    let stretch = 0;
    for (let motion = first; motion < Math.min(motions, first + step); ++motion) {
      const each = columns.map((column, joint) => Math.abs(column[motion + 1] - column[motion]) / greatest[joint]);
      const longest = Math.max(...each);
      each.forEach((value, joint) => { needed[joint] += value; });
      slowest[each.indexOf(longest)] += longest;
      stretch += longest;
    }
    at.push(first);
    needed.forEach((value, joint) => shares[joint].push(stretch > 0 ? (100 * value) / stretch : 0));
    seconds += stretch;
  }
  return {at, shares, slowest: slowest.map((value) => (seconds > 0 ? value / seconds : 0)), seconds};
}

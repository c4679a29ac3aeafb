// The way of the ball's centre around now, as lines in the stock's frame.

import {BufferAttribute, BufferGeometry, Color, LineBasicMaterial, LineSegments} from '../vendor/libraries.js';

const CUT = new Color('#e0662f'), TRAVEL = new Color('#3f7fc4');

const STEP = 64, AROUND = 192;  // keyframes

export class Path {
  constructor() {
    this.lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({vertexColors: true, depthTest: false, transparent: true}));
    this.lines.renderOrder = 1;  // through what stands before it
    this.lines.frustumCulled = false;
    this.from = -1;
  }

  /**
   * Some keyframes before and behind now; made anew only when now has left their middle.
   * @param {import('../plan/joints.js').Joints} joints
   * @param {import('./robot.js').Robot} robot
   * @param {import('../panels/time_bar.js').TimeBar} time
   * @returns {Promise<boolean>} is there another way to be drawn?
   */
  async follow(joints, robot, time) {
    const from = Math.max(0, STEP * Math.floor(time.at / STEP) - AROUND), to = Math.min(time.keyframes, from + 2 * AROUND + STEP);
    if (!this.lines.visible || from === this.from) return false;
    this.from = from;
    const values = await joints.between(from, to);
    if (this.from !== from) return false;  // it was left meanwhile
    this.set(robot.balls(joints.names, values), Array.from(time.kinds.subarray(from, to), (kind) => (kind & 7) !== 0));
    return true;
  }

  /** @param {any[]} points of three numbers, one more than ways @param {boolean[]} cuts of the way to the next point: does it cut? */
  set(points, cuts) {
    const places = new Float32Array(6 * cuts.length), colours = new Float32Array(6 * cuts.length);
    cuts.forEach((cut, way) => {
      points[way].toArray(places, 6 * way);
      points[way + 1].toArray(places, 6 * way + 3);
      for (const end of [0, 3]) (cut ? CUT : TRAVEL).toArray(colours, 6 * way + end);
    });
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute('position', new BufferAttribute(places, 3));
    this.lines.geometry.setAttribute('color', new BufferAttribute(colours, 3));
  }

  clear() {
    this.from = -1;
    this.set([], []);
  }
}

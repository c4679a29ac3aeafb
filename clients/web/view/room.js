// The stock or the whole cell in one's own room, by WebXR: found a place, placed at true scale, looked at while it plays.

import {EdgesGeometry, CylinderGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Vector3} from '../vendor/libraries.js';

const RETICLE_RADIUS_M = 0.08, AHEAD_M = 1.5, TURN = Math.PI / 12;
const STICK = 2, STICK_REST = 0.2, SHARE_A_SECOND = 0.1;  // of a headset's controller: its axis to the side moves the time

/** @returns {Promise<string>} why this browser has no way into the room, as a sentence; empty: it has */
export async function why_no_room() {
  if (!isSecureContext) return 'Augmented reality needs a page from https:// or from this very machine: give the server a certificate (tls_certificate).';
  const none = 'This browser has no WebXR for your room. Chrome on Android and the Quest browser have; elsewhere take a file along.';
  try {
    return (await /** @type {any} */ (navigator).xr?.isSessionSupported('immersive-ar')) ? '' : none;
  } catch {
    return none;
  }
}

/** Events: `entered`, `placed`, `left`. */
export class Room extends EventTarget {
  /** @param {import('./view.js').View} view @param {import('../panels/time_bar.js').TimeBar} time */
  constructor(view, time) {
    super();
    this.view = view;
    this.time = time;
    this.reticle = new LineSegments(new EdgesGeometry(new CylinderGeometry(RETICLE_RADIUS_M, RETICLE_RADIUS_M, 0.001, 48), 60), new LineBasicMaterial({color: '#ffb000'}));
    this.reticle.matrixAutoUpdate = false;
    /** where it is placed, turned by the user, z up */
    this.spot = new Group();
    this.upright = new Group();
    this.upright.rotation.x = -Math.PI / 2;
    this.spot.add(this.upright);
    /** @type {any} */
    this.session = null;
  }

  /**
   * Asks the browser for the room; only from a click.
   * @param {{thing: 'stock' | 'cell', scale: number, overlay: Element}} wish `overlay`: what a phone shows over the picture of its camera
   * @returns {Promise<void>} throws an Error with a sentence
   */
  async enter({thing, scale, overlay}) {
    const {xr} = this.view.renderer;
    try {
      this.session = await /** @type {any} */ (navigator).xr.requestSession('immersive-ar',
        {requiredFeatures: ['local-floor'], optionalFeatures: ['hit-test', 'anchors', 'dom-overlay'], domOverlay: {root: overlay}});
    } catch (error) {
      throw new Error(`The browser does not open your room: ${error.message}`);
    }
    this.session.addEventListener('end', () => this.#left());
    this.session.addEventListener('select', () => this.#select());
    this.session.addEventListener('squeeze', () => this.place_again());
    this.time.next_frame = (draw) => this.session.requestAnimationFrame(draw);
    xr.enabled = true;
    xr.setReferenceSpaceType('local-floor');
    try {
      await xr.setSession(this.session);
    } catch (error) {
      this.leave();
      throw new Error(`The picture does not go into your room: ${error.message}`);
    }
    this.hits = await this.#find_hits();
    this.#take_body(thing, scale);
    this.place_again();
    this.view.renderer.setAnimationLoop((now, frame) => this.#draw(now, frame));
    this.dispatchEvent(new CustomEvent('entered'));
  }

  /** Where the line of sight meets the room; null where the browser cannot tell. */
  async #find_hits() {
    try {
      return await this.session.requestHitTestSource({space: await this.session.requestReferenceSpace('viewer')});
    } catch {
      return null;
    }
  }

  // Out of its place in the scene, so that its lowest middle (of the stock) or its origin (of the cell) is where one taps.
  #take_body(thing, scale) {
    const {view} = this, {scene} = view;
    const {fov, zoom} = view.camera;  // three moves the camera along with the head
    this.before = {parent: view.body.parent, background: scene.background, floor: view.backdrop.floor.visible, place: view.place, fov, zoom};
    scene.background = null;
    view.backdrop.floor.visible = false;
    view.robot?.show(thing === 'cell' ? 'collision' : 'none');
    const foot = thing === 'cell' ? new Vector3() : view.stock_foot();
    this.upright.scale.setScalar(scale);
    view.body.position.copy(foot.negate());
    this.upright.add(view.body);
    scene.add(this.spot, this.reticle);
  }

  /** Looks for another place. */
  place_again() {
    this.placed = false;
    this.anchor = null;
    this.spot.visible = false;
    this.reticle.visible = false;
  }

  /** @param {1 | -1} way to the left or right, by 15 degrees */
  turn(way) {
    this.upright.rotation.z += way * TURN;
  }

  leave() {
    this.session?.end();
  }

  #select() {
    if (this.placed || (this.hits && !this.reticle.visible)) return;
    if (this.hits) {
      this.spot.position.setFromMatrixPosition(this.reticle.matrix);
      this.#keep_anchor();
    } else {
      const ahead = new Vector3(0, 0, -1).transformDirection(this.view.renderer.xr.getCamera().matrixWorld).setY(0).normalize();
      this.spot.position.setFromMatrixPosition(this.view.renderer.xr.getCamera().matrixWorld).addScaledVector(ahead, AHEAD_M).setY(0);
    }
    this.placed = true;
    this.spot.visible = true;
    this.reticle.visible = false;
    this.dispatchEvent(new CustomEvent('placed'));
  }

  // The room is understood better as one walks: what is anchored stays where it was put.
  async #keep_anchor() {
    try {
      this.anchor = await this.hit?.createAnchor?.();
    } catch { /* it stands by its coordinates then */ }
  }

  #draw(now, frame) {
    const space = this.view.renderer.xr.getReferenceSpace();
    if (frame && !this.placed && this.hits) {
      this.hit = frame.getHitTestResults(this.hits)[0];
      this.reticle.visible = Boolean(this.hit);
      if (this.hit) this.reticle.matrix.fromArray(this.hit.getPose(space).transform.matrix);
    } else if (frame && this.anchor) {
      const pose = frame.getPose(this.anchor.anchorSpace, space);
      if (pose) this.spot.position.setFromMatrixPosition(new Matrix4().fromArray(pose.transform.matrix));
    }
    this.#move_time(now);
    this.view.draw_now();
  }

  #move_time(now) {
    const seconds = (now - (this.last ?? now)) / 1000;
    this.last = now;
    for (const {gamepad} of this.session.inputSources) {
      const push = gamepad?.axes[STICK] ?? 0;
      if (Math.abs(push) > STICK_REST) this.time.step_share(push * SHARE_A_SECOND * seconds);
    }
  }

  #left() {
    const {view, before} = this;
    this.time.stop();
    this.time.next_frame = (draw) => requestAnimationFrame(draw);
    view.renderer.setAnimationLoop(null);
    view.renderer.xr.enabled = false;
    this.session = this.hits = this.anchor = this.hit = null;
    if (before) {
      view.body.position.set(0, 0, 0);
      before.parent.add(view.body);
      view.scene.background = before.background;
      view.backdrop.floor.visible = before.floor;
      this.spot.removeFromParent();
      this.reticle.removeFromParent();
      Object.assign(view.camera, {fov: before.fov, zoom: before.zoom});
      view.place = before.place;
      this.before = null;
    }
    view.resize();
    this.dispatchEvent(new CustomEvent('left'));
  }
}

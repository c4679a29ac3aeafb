// The 3D picture: camera, lights, the robot and the stock. Draws only when something changed.

import {
  BoxGeometry, DirectionalLight, DoubleSide, EdgesGeometry, FrontSide, Group, HemisphereLight, LineBasicMaterial, LineSegments, Mesh,
  OrbitControls, PerspectiveCamera, Scene, Vector2, Vector3, WebGLRenderer,
} from '../vendor/libraries.js';
import {LOOKS, stock_material} from '../stock/material.js';
import {Shell} from '../stock/shell.js';
import {Backdrop} from './backdrop.js';
import {Pictures} from './pictures.js';
import {Smooth} from './smooth.js';
import {vantage} from './vantage.js';

const EDGES = '#8b97a3';

// A canvas whose edges are not smoothed (view/smooth.js does that). three smooths a headset's pictures where the canvas has it, so that it is told so.
function graphics_of(canvas) {
  const context = canvas.getContext('webgl2', {antialias: false, stencil: false});
  if (!context) throw new Error('the canvas has no such context');
  const attributes = context.getContextAttributes.bind(context);
  context.getContextAttributes = () => ({...attributes(), antialias: true});
  return context;
}

/** Events: `lost` and `restored` of the graphics context, `picked` with a ray in cells, `moved` when the camera was, `drawn` when a picture is there. */
export class View extends EventTarget {
  /** @param {HTMLCanvasElement} canvas throws an Error where there is no WebGL 2 */
  constructor(canvas) {
    super();
    this.canvas = canvas;
    const ratio = Math.min(2, devicePixelRatio), {clientWidth: width, clientHeight: height} = canvas.parentElement;
    Object.assign(canvas, {width, height});  // the first one is the right one: another is made anew, and waited for
    this.renderer = new WebGLRenderer({canvas, context: graphics_of(canvas)});
    if (ratio !== 1) this.renderer.setPixelRatio(ratio);
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(38, 1, 0.01, 50);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(1.3, -1.5, 1.1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.controls.addEventListener('end', () => this.#tell('moved'));
    this.scene.add(new HemisphereLight('#ffffff', '#6b7078', 1.7));
    const sun = new DirectionalLight('#fff8ee', 2.1);
    sun.position.set(-1, -1.6, 2.4);
    this.scene.add(sun);
    this.material = stock_material();
    this.shell = new Shell(this.material);
    this.stock = this.shell.body;
    this.grid_frame = new Group();
    this.grid_frame.add(this.stock);
    this.scene.add(this.grid_frame);
    /** @type {import('./robot.js').Robot | null} */
    this.robot = null;
    /** @type {import('../vendor/libraries.js').Mesh | null} in the place of the stock */
    this.machined = null;
    this.edge = 0;
    this.smooth = new Smooth();
    this.pictures = new Pictures(this);
    this.#listen();
    this.backdrop = new Backdrop(this.scene, () => this.draw());
  }

  #listen() {
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.#tell('lost');
    });
    this.canvas.addEventListener('webglcontextrestored', () => { this.#tell('restored'); this.draw(); });
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
    this.canvas.addEventListener('pointerup', (event) => {
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) this.#tell('picked', this.#ray_at(event));
    });
  }

  /** @param {import('./robot.js').Robot} robot */
  set_robot(robot) {
    this.robot?.root.removeFromParent();
    this.robot = robot;
    this.scene.add(robot.root);
    robot.stock_frame.add(this.grid_frame);
    this.draw();
  }

  /** @param {any} header of the trajectory @param {number} edge cells along an edge */
  set_grid(header, edge) {
    this.edge = edge;
    this.size_m = header.voxel_m * header.resolution;
    this.grid_frame.position.fromArray(header.origin_m);
    this.grid_frame.scale.setScalar(this.size_m / edge);
    this.#draw_box();
    this.draw();
  }

  #draw_box() {
    this.box?.removeFromParent();
    if (!this.edge) return;
    this.box = new LineSegments(new EdgesGeometry(new BoxGeometry(this.edge, this.edge, this.edge)), new LineBasicMaterial({color: EDGES}));
    this.box.position.setScalar(this.edge / 2);
    this.grid_frame.add(this.box);
  }

  /** @param {{chunk: number, faces: Uint32Array, ends: number[]}[]} changed */
  put_faces(changed) {
    if (changed.length === 0) return;
    this.shell.put(changed);
    this.draw();
  }

  /** @param {import('../vendor/libraries.js').Mesh | null} surface in the stock's frame (m), in the place of the stock; null: the stock */
  show_machined(surface) {
    if (this.machined === surface) return;
    this.machined?.removeFromParent();
    this.machined = surface;
    this.stock.visible = surface === null;
    if (surface) (this.robot?.stock_frame ?? this.scene).add(surface);
    this.draw();
  }

  /** @param {Record<string, any>} values of the stock's material */
  set_look(values) {
    for (const [name, value] of Object.entries(values)) {
      if (name === 'look') this.material.uniforms.look.value = LOOKS[value];
      else this.material.uniforms[name].value = value;
    }
    this.draw();
  }

  /** @param {boolean} floor @param {boolean} box */
  set_scenery(floor, box) {
    this.backdrop.floor.visible = floor;
    if (this.box) this.box.visible = box;
    this.draw();
  }

  /** @param {number | null} axis @param {number} share of the grid that stays, 0 to 1 */
  set_section(axis, share) {
    const plane = this.material.uniforms.clip.value, side = axis === null ? FrontSide : DoubleSide;
    if (this.material.side !== side) {  // from behind faces are seen only where the stock is cut open
      this.material.side = side;
      this.material.needsUpdate = true;
    }
    plane.set(0, 0, 0, 1);
    if (axis !== null) {
      plane.setComponent(axis, 1);
      plane.w = share * this.edge;
    }
    this.draw();
  }

  /** @returns {number[] | null} the section's plane in cells */
  get section() {
    const {x, y, z, w} = this.material.uniforms.clip.value;
    return x || y || z ? [x, y, z, w] : null;
  }

  /** Draws soon; many calls, one picture. In a headset each frame is drawn anyway. */
  draw() { this.pictures.want(); }

  /** A picture at once. @param {boolean} is_draft without smoothed edges */
  draw_now(is_draft = false) {
    if (this.renderer.getContext().isContextLost()) return;
    this.#aim();
    this.shell.send();
    if (is_draft) this.renderer.render(this.scene, this.camera);
    else this.smooth.draw(this.renderer, this.scene, this.camera);
  }

  // What is drawn depends on where the eye is, in cells: the cut, and which sides are seen. A headset has two eyes.
  #aim() {
    const {xr} = this.renderer, camera = xr.isPresenting ? xr.getCamera() : this.camera, eye = this.material.uniforms.eye.value;
    this.scene.updateMatrixWorld();
    camera.updateMatrixWorld();
    eye.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(this.stock.matrixWorld.clone().invert());
    this.shell.show_to(xr.isPresenting || this.section ? null : eye, this.edge);
  }

  /** To the place that the picture has on the page; not while a headset has the picture. */
  resize() {
    if (this.renderer.xr.isPresenting) return;
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    const before = this.renderer.getSize(new Vector2());
    if (width !== before.x || height !== before.y) this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.pictures.held) this.draw_now(this.pictures.are_slow);
    this.draw();
  }

  /** @returns {any} all that stands in the room: the cell, or without one the stock */
  get body() {
    return this.robot?.root ?? this.grid_frame;
  }

  /** @returns {Vector3} the middle of the grid's lowest side, in the frame of `body`'s parent */
  stock_foot() {
    this.scene.updateMatrixWorld();
    const foot = new Vector3(this.edge / 2, this.edge / 2, 0).applyMatrix4(this.grid_frame.matrixWorld);
    return this.body.parent.worldToLocal(foot);
  }

  #stock_centre() {
    this.grid_frame.updateWorldMatrix(true, false);
    return new Vector3().setScalar(this.edge / 2).applyMatrix4(this.grid_frame.matrixWorld);
  }

  /** @param {string} side of SIDES, or `cell`, or `stock` */
  look_from(side) {
    const {target, direction, radius} = vantage(side, this.#stock_centre(), this.size_m || 0.2, this.robot);
    const distance = radius / Math.tan((this.camera.fov * Math.PI) / 360) / Math.min(1, this.camera.aspect);
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(direction, distance);
    this.controls.update();
    this.draw();
    this.#tell('moved');
  }

  /** @param {number[]} cell */
  fly_to(cell) {
    this.grid_frame.updateWorldMatrix(true, false);
    const target = new Vector3(...cell).addScalar(0.5).applyMatrix4(this.grid_frame.matrixWorld);
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(direction, (this.size_m || 0.2) * 2);
    this.controls.update();
    this.draw();
  }

  /** @returns {string} for a link */
  get place() {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()].map((value) => value.toFixed(3)).join(',');
  }
  set place(text) {
    const values = text.split(',').map(Number);
    if (values.length !== 6 || !values.every(Number.isFinite)) return;
    this.camera.position.fromArray(values);
    this.controls.target.fromArray(values, 3);
    this.controls.update();
    this.draw();
  }

  /** @param {{clientX: number, clientY: number}} event */
  #ray_at(event) {
    this.scene.updateMatrixWorld();
    this.camera.updateMatrixWorld();
    const box = this.canvas.getBoundingClientRect();
    const point = new Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    const to_cells = this.grid_frame.matrixWorld.clone().invert();
    const origin = this.camera.position.clone().applyMatrix4(to_cells);
    const beyond = new Vector3(point.x, point.y, 0.5).unproject(this.camera).applyMatrix4(to_cells);
    return {origin: origin.toArray(), direction: beyond.sub(origin).normalize().toArray()};
  }

  /** @returns {Promise<Blob>} a PNG of what is seen */
  picture() {
    this.draw_now();
    return new Promise((resolve, reject) => this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('the browser gives no picture'))), 'image/png'));
  }

  #tell(name, detail) {
    this.dispatchEvent(new CustomEvent(name, {detail}));
  }
}

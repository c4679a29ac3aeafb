// The cell of a job as objects: its URDF with collision and visual shapes, the tool in its holder, and the frame of the stock.

import {BoxGeometry, Group, Mesh, MeshLambertMaterial, OBJLoader, STLLoader, URDFLoader, Vector3} from '../vendor/libraries.js';
import {get} from '../wire/token.js';
import {milling_tool, thin_tool} from './tool.js';

const BODY = '#c3cbd3', ROOM = '#77828d';
const LOADERS = {stl: () => new STLLoader(), obj: () => new OBJLoader()};

const material = (colour) => new MeshLambertMaterial({color: colour});

/** A cell in its own world: z is up, metres. */
export class Robot {
  constructor() {
    this.root = new Group();
    /** @type {any} */
    this.urdf = null;
    this.stock_frame = new Group();
    this.root.add(this.stock_frame);
    this.tool = new Group();
    this.post = new Group();
    /** @type {any} what `tool` shows, as the header has it */
    this.held = null;
    this.stickout_m = 0;
    /** @type {string[]} what could not be drawn, as sentences */
    this.missing = [];
    /** @type {any} the cell file */
    this.cell = null;
    this.bodies = material(BODY);
    this.room = material(ROOM);
  }

  /** @param {string} job @returns {Promise<Robot>} throws an Error with a sentence */
  static async of_job(job) {
    const robot = new Robot();
    const bundle = await (await get(`/v1/jobs/${job}/cell/`)).json();
    const cell = JSON.parse(bundle.cell);
    robot.cell = cell;
    const fetch_file = async (reference) => {
      const file = bundle.files[reference];
      if (!file) throw new Error(`the cell has no file ${reference}`);
      return (await get(`/v1/jobs/${job}/cell/${file.blob}`)).arrayBuffer();
    };
    await robot.#read_urdf(new TextDecoder().decode(await fetch_file(cell.urdf)), fetch_file);
    const stock_link = robot.urdf.links[cell.stock.link];
    robot.stock_frame.removeFromParent();
    (stock_link ?? robot.root).add(robot.stock_frame);
    if (cell.stock.post) robot.#add_post(cell.stock);
    robot.urdf.links[cell.tool.link]?.add(robot.tool);
    robot.move(Object.entries(cell.home ?? {}));
    return robot;
  }

  // What the block stands on.
  #add_post({origin_m: [x, y, z], size_m, post: {height_m, width_m}}) {
    this.post.add(new Mesh(new BoxGeometry(width_m, width_m, height_m), this.room));
    this.post.position.set(x + size_m / 2, y + size_m / 2, z - height_m / 2);
    this.stock_frame.add(this.post);
  }

  async #read_urdf(text, fetch_file) {
    const loader = new URDFLoader();
    const waiting = [];
    loader.parseCollision = true;
    loader.parseVisual = true;
    loader.loadMeshCb = (path, _manager, _material, done) => {
      waiting.push(this.#load_mesh(path, fetch_file).then((mesh) => done(mesh), (error) => {
        this.missing.push(`${path} is not drawn: ${error.message}`);
        done(null, error);
      }));
    };
    loader.packages = (name) => `package://${name}`;
    loader.workingPath = '';
    this.urdf = loader.parse(text);
    await Promise.all(waiting);
    this.urdf.traverse((part) => part.isMesh && this.#paint(part));
    this.root.add(this.urdf);
    this.show('collision');
  }

  async #load_mesh(path, fetch_file) {
    const kind = path.split('.').pop().toLowerCase();
    if (!(kind in LOADERS)) throw new Error(`the page does not read .${kind}`);
    const bytes = await fetch_file(path);
    const parsed = LOADERS[kind]().parse(kind === 'obj' ? new TextDecoder().decode(bytes) : bytes);
    return parsed.isObject3D ? parsed : new Mesh(parsed);
  }

  #paint(mesh) {
    let above = mesh;
    while (above && !above.isURDFLink) above = above.parent;
    const moves = (link) => link && (link.isURDFJoint && link.jointType !== 'fixed' || moves(link.parent));
    mesh.material = moves(above) ? this.bodies : this.room;
  }

  /** @param {string} kind collision, visual or none */
  show(kind) {
    const has = {collision: false, visual: false};
    const each = (visit) => this.urdf.traverse((part) => {
      if (part.isURDFCollider) visit(part, 'collision');
      if (part.isURDFVisual) visit(part, 'visual');
    });
    each((_, of) => { has[of] = true; });
    const shown = kind === 'visual' && !has.visual ? 'collision' : kind;
    each((part, of) => { part.visible = of === shown; });
    this.tool.visible = this.post.visible = kind !== 'none';
  }

  /** @param {number} share 1 = solid */
  set_opacity(share) {
    for (const of of [this.bodies, this.room]) {
      of.opacity = share;
      of.transparent = share < 1;
      of.depthWrite = share === 1;
      of.needsUpdate = true;
    }
  }

  /** @param {any} header of the trajectory @param {number} number of its milling tools, where it has some: the one in the spindle */
  hold(header, number) {
    const tool = header.tools ? header.tools[number] : header.tool;
    if (tool === this.held) return;
    this.held = tool;
    this.stickout_m = tool.stickout_m;
    this.tool.clear();
    this.tool.add(...(tool.cutter ? milling_tool(tool) : thin_tool(tool, this.cell.tool.holder ?? [])));
  }

  /** @param {Iterable<[string, number]>} values rad or m by joint */
  move(values) {
    for (const [joint, value] of values) this.urdf.joints[joint]?.setJointValue(value);
  }

  /**
   * @param {string[]} joints
   * @param {number[][]} postures rad or m, one value a joint
   * @returns {any[]} the thin tool's ball, or a milling tool's tip, at each as a Vector3, in the stock's frame (m); the robot stands as before
   */
  balls(joints, postures) {
    const before = joints.map((joint) => this.urdf.joints[joint]?.angle ?? 0), name = (values) => joints.map((joint, at) => /** @type {[string, number]} */ ([joint, values[at]]));
    const places = postures.map((values) => {
      this.move(name(values));
      this.tool.updateWorldMatrix(true, false);
      this.stock_frame.updateWorldMatrix(true, false);
      const ball = new Vector3(0, 0, this.stickout_m).applyMatrix4(this.tool.matrixWorld);
      return this.stock_frame.worldToLocal(ball);
    });
    this.move(name(before));
    return places;
  }

  /** @returns {{base: Vector3, low: Vector3, high: Vector3}} where the first joint is that moves the tool, and a box that holds what moves (m, in the world) */
  place() {
    this.root.updateMatrixWorld(true);
    const base = new Vector3(), low = new Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
    for (let part = this.urdf.links[this.cell.tool.link]; part; part = part.parent)
      if (part.isURDFJoint && part.jointType !== 'fixed') base.setFromMatrixPosition(part.matrixWorld);
    this.urdf.traverse((part) => {
      if (!part.isMesh || part.material !== this.bodies) return;
      part.geometry.computeBoundingSphere();
      const {center, radius} = part.geometry.boundingSphere, middle = center.clone().applyMatrix4(part.matrixWorld);
      const reach = radius * part.matrixWorld.getMaxScaleOnAxis();
      low.min(middle.clone().subScalar(reach));
      high.max(middle.clone().addScalar(reach));
    });
    return {base, low, high};
  }

  /** @param {string} joint @returns {{lower: number, upper: number, velocity: number} | null} */
  limits(joint) {
    const found = this.urdf.joints[joint];
    if (!found) return null;
    return {lower: Number(found.limit.lower), upper: Number(found.limit.upper), velocity: Number(found.limit.velocity)};
  }
}

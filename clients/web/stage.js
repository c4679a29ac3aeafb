// The chosen job in the 3D view: its timeline by the worker, its robot, and both at the place of the time bar; above 300 lines, for what is on its way to
// and from the worker is of one job, and all of it is forgotten with the job.

import {FINAL} from './panels/queue.js';
import {Joints} from './plan/joints.js';
import {follow_timeline, read_timeline} from './plan/follow.js';
import {Machined} from './view/machined.js';
import {Path} from './view/path.js';
import {Robot} from './view/robot.js';
import {count} from './dom.js';

const LOADING = 'Loading\u2026';
const FIRST_PICTURE = 'first picture';  // of a finished plan: a mark for who measures

/** Events: `note` with a sentence for the middle of the picture, `started` when the grid is known, `picked` with what the worker found. */
export class Stage extends EventTarget {
  /**
   * @param {import('./view/view.js').View} view @param {Worker} worker stock/worker.js
   * @param {import('./panels/time_bar.js').TimeBar} time @param {import('./wire/connection.js').Connection} connection
   */
  constructor(view, worker, time, connection) {
    super();
    this.view = view;
    this.time = time;
    this.connection = connection;
    this.worker = worker;
    this.worker.onmessage = (message) => this.#on_worker(message.data);
    this.worker.onerror = (event) => {
      view.pictures.go_on();
      this.#note(`The picture of the stock cannot be made: ${event.message}`);
    };
    this.busy = false;
    this.wanted = false;
    this.generation = 0;
    this.tickets = 0;
    this.viewed = false;
    /** @type {Robot | null} of the job before, until the next one's is there */
    this.robot = null;
    this.stop = new AbortController();
    this.path = new Path();
    this.machined = new Machined(view, (sentence) => this.#note(sentence));
    this.#forget();
    time.addEventListener('moved', () => this.#moved());
    view.addEventListener('drawn', () => this.#on_drawn());
    view.addEventListener('picked', (event) => this.worker.postMessage({kind: 'pick', ticket: this.generation, clip: view.section, ...event.detail}));
  }

  /** @param {any} job @param {{at: number | null, place: string | null}} wish keyframes' share and the camera's place, of a link */
  async show(job, wish) {
    this.close();
    this.job = job;
    this.wish = wish;
    const {signal} = this.stop = new AbortController();
    if (['failed', 'cancelled', 'expired', 'quarantined'].includes(job.state) && job.error?.code !== 'verify_failed')
      return this.#note(`This job is ${job.state}, so there is nothing to see.`);
    if (['held', 'queued', 'backoff', 'paused'].includes(job.state) && !job.started_at)
      return this.#note(`This job is ${job.state}: it is shown here as soon as it is planned.`);
    this.#note(LOADING);
    this.#load_robot(job, signal);
    try {
      if (FINAL.has(job.state)) await this.#load_finished(job, signal);
      else await this.#follow(job, signal);
    } catch (error) {
      if (!signal.aborted) this.#note(error.message);
    }
  }

  // Nothing is known of a plan: what is on its way to or from the worker is of another one.
  #forget() {
    ++this.generation;
    this.worker.postMessage({kind: 'reset'});
    /** @type {any} of the timeline */
    this.head = null;
    this.machined.show(null);
    this.final = false;
    this.ends_in = Infinity;  // the picture in which the end of a finished plan is seen
    this.pending = 0;
    /** @type {Joints | null} */
    this.joints = null;
    /** @type {number[] | null} where they are at the end of a plan that grows */
    this.live_joints = null;
    this.whole = true;
    /** @type {number[][] | null} */
    this.chosen = null;
    for (const settle of this.asked?.values() ?? []) settle(null);
    /** @type {Map<number, (body: any) => void>} who waits for an outline, by ticket */
    this.asked = new Map();
    this.tell_pictured?.();
    /** the end of a finished plan is drawn, or the plan was left */
    this.pictured = new Promise((tell) => { this.tell_pictured = tell; });
    this.path.clear();
    this.time.clear();
  }

  /** Nothing is shown any more. */
  close() {
    this.stop.abort();
    this.#forget();
    this.time.set_growing(false);
    this.view.shell.clear();
    this.view.draw();
  }

  /** The state changed: there may be something to see now. @param {any} job */
  update(job) {
    const began = !this.job?.started_at && job.started_at;
    const ended = this.job && !FINAL.has(this.job.state) && FINAL.has(job.state);
    this.job = job;
    if ((began || ended) && !this.head) this.show(job, {at: null, place: null});
  }

  async #load_finished(job, signal) {
    await read_timeline(job.job, (bytes) => this.#add(bytes), signal);
    if (signal.aborted) return;
    this.#become_final();
    await this.pictured;
  }

  async #follow(job, signal) {
    this.time.set_growing(true);
    this.time.set_live(this.wish.at === null);
    await follow_timeline({connection: this.connection, job: job.job, signal}, {
      take: (bytes) => this.#add(bytes),
      start_over: () => this.#forget(),
      joints: (values) => { this.live_joints = values; },
      is_over: () => FINAL.has(this.job.state),
    });
    if (!signal.aborted) this.#become_final();
  }

  // All bytes are there; the worker may still be at them.
  #become_final() {
    this.final = true;
    this.time.set_growing(false);
    if (this.pending === 0) this.#show_whole();
  }

  // Nothing more will come, and all is decoded.
  #show_whole() {
    if (!this.head) return;
    this.joints = new Joints(this.job.job, this.head.header);
    this.whole = true;
    this.time.go((this.wish.at ?? 1) * this.time.keyframes);
  }

  #add(bytes) {
    ++this.pending;
    this.worker.postMessage({kind: 'add', generation: this.generation, bytes}, [bytes.buffer]);
  }

  async #load_robot(job, signal) {
    try {
      const robot = await Robot.of_job(job.job);
      if (signal.aborted) return;
      this.robot = robot;
      this.view.set_robot(robot);
      robot.stock_frame.add(this.path.lines);
      this.#first_view();
      this.dispatchEvent(new CustomEvent('robot'));
      if (robot.missing.length) this.#note(robot.missing[0]);
      this.#move_robot();
    } catch (error) {
      if (!signal.aborted) this.#note(`The robot is not shown: ${error.message}`);
    }
  }

  #first_view() {
    if (this.viewed) return;
    this.viewed = true;
    if (this.wish.place) this.view.place = this.wish.place;
    else this.view.look_from('cell');
  }

  #on_worker(message) {
    if (message.kind === 'grown') this.#on_grown(message);
    else if (message.kind === 'outlined') this.#on_outlined(message);
    else if (message.kind === 'picked') message.ticket === this.generation && this.dispatchEvent(new CustomEvent('picked', {detail: message.hit}));
    else this.#on_faces(message);
  }

  #on_grown(grown) {
    if (grown.generation !== this.generation) return;
    --this.pending;
    if (grown.head) {
      this.head = grown.head;
      this.view.set_grid(grown.head.header, grown.head.edge);
      this.time.remove = grown.head.voxels.remove;
      this.dispatchEvent(new CustomEvent('started'));
    }
    this.time.add(grown);
    if (this.final && this.pending === 0) this.#show_whole();
    else if (this.whole && this.time.growing) this.#ask();
  }

  #on_faces(message) {
    this.busy = false;
    this.view.pictures.go_on();
    if (message.generation === this.generation) {
      this.view.put_faces(message.chunks);
      this.view.set_look({share: message.removed / Math.max(1, this.time.remove)});
      if (this.live_joints && this.time.live) this.#pose(this.live_joints);
      this.shown = message.removed;
      this.ends_in = message.final ? this.view.pictures.begun + 1 : Infinity;
      if (this.said === LOADING) this.#note('');
      this.dispatchEvent(new CustomEvent('shown', {detail: {made_ms: message.made_ms}}));
    }
    if (this.wanted) this.#ask();
  }

  /**
   * What stands now, for a file.
   * @param {'stock' | 'sculpture'} what
   * @returns {Promise<import('./export/outline.js').Outline>} throws an Error with a sentence where nothing is shown
   */
  outline(what) {
    if (!this.head) return Promise.reject(new Error('there is no plan to export: choose a job that is planned'));
    const ticket = this.tickets++;
    return new Promise((resolve, reject) => {
      this.asked.set(ticket, (body) => (body ? resolve(body) : reject(new Error('another job was chosen meanwhile: export again'))));
      this.worker.postMessage({kind: 'outline', generation: this.generation, ticket, moment: {removed: this.time.cut, final: this.final, what}});
    });
  }

  #on_outlined({generation, ticket, body}) {
    if (generation !== this.generation) return;
    this.asked.get(ticket)?.(body);
    this.asked.delete(ticket);
  }

  #moved() {
    this.#ask();
    this.#move_robot();
  }

  // The newest wish only: while the worker is at one, or its faces are drawn, others wait as one.
  #ask() {
    if (this.view.pictures.behind) this.wanted = true;
    else this.#ask_now();
  }

  #on_drawn() {
    if (this.view.pictures.begun >= this.ends_in) this.#on_pictured();
    if (this.wanted) this.#ask_now();
  }

  #on_pictured() {
    this.tell_pictured();
    if (!performance.getEntriesByName(FIRST_PICTURE).length) performance.mark(FIRST_PICTURE);
  }

  #ask_now() {
    if (!this.head) return;
    if (this.busy) {
      this.wanted = true;
      return;
    }
    this.busy = true;
    this.wanted = false;
    this.view.pictures.hold();  // robot and stock move together
    const removed = this.time.cut;
    this.worker.postMessage({kind: 'show', generation: this.generation, removed, final: this.final, chosen: this.chosen, all: this.whole});
    this.whole = false;
  }

  /** @param {number[][] | null} voxels to point out */
  point_out(voxels) {
    this.chosen = voxels;
    this.whole = true;
    this.#ask();
  }

  async #move_robot() {
    if (this.head) this.robot?.hold(this.head.header, this.time.tool);
    if (!this.joints || !this.robot) return;
    if (this.posing) {
      this.pose_again = true;
      return;
    }
    this.posing = true;
    const {joints} = this;
    try {
      do {
        this.pose_again = false;
        const values = await joints.at(this.time.at);
        if (joints !== this.joints) continue;
        this.#pose(values);
        if (this.robot && await this.path.follow(joints, this.robot, this.time)) this.view.draw();
      } while (this.pose_again);
    } catch (error) {
      this.#note(`The robot stands still: ${error.message}`);
    } finally {
      this.posing = false;
    }
  }

  #pose(values) {
    if (this.head) this.robot?.hold(this.head.header, this.time.tool);
    const names = this.head?.header.joints ?? [];
    this.robot?.move(names.map((name, at) => [name, values[at]]));
    this.view.draw();
  }

  /** @param {boolean} wanted the way of the tool around now */
  show_path(wanted) {
    this.path.lines.visible = wanted;
    this.#move_robot();
  }

  /** @param {boolean} wanted the surface at the end, in the place of the stock */
  show_machined(wanted) {
    this.machined.show(wanted ? this.job?.job : null);
  }

  /** @returns {boolean} nothing is on its way any more */
  get settled() {
    return this.head !== null && this.pending === 0 && (this.final || this.time.growing) && !this.busy && !this.wanted && !this.posing && this.shown === this.time.cut;
  }

  #note(text) {
    this.said = text;
    this.dispatchEvent(new CustomEvent('note', {detail: text}));
  }
}

/** @param {any} head of a timeline */
export function sentence_of(head) {
  return head.block > 1 ? `${count(head.header.resolution)}\u00b3 voxels, shown as blocks of ${head.block}\u00b3` : '';
}

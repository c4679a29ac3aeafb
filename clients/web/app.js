// The page: joins connection, queue, 3D view and panels, and keeps the address up to date.

import {by_selector, by_id, make} from './dom.js';
import {ask_token, show_help} from './panels/dialogs.js';
import {read_residue, show_job_head} from './panels/job_head.js';
import {FIRST, show_layers} from './panels/layers.js';
import {show_legend} from './panels/legend.js';
import {show_picked} from './panels/picked.js';
import {Plots} from './panels/plots.js';
import {Queue} from './panels/queue.js';
import {show_report} from './panels/report.js';
import {show_residue} from './panels/residue.js';
import {SubmitForm, take_drops} from './panels/submit.js';
import {show_tab, start_tabs} from './panels/tabs.js';
import {TimeBar} from './panels/time_bar.js';
import {listen_to_keys} from './keys.js';
import {read_link, write_link} from './link.js';
import {Stage, sentence_of} from './stage.js';
import {TakeAlong} from './take_along.js';
import {View} from './view/view.js';
import {Connection} from './wire/connection.js';

const RANK = {read: 0, submit: 1, admin: 2};
const FIRST_PICTURE_MS = 1500;  // until then nothing is drawn that the job of a link is not in

class App {
  constructor() {
    this.wish = read_link();
    this.connection = new Connection();  // it is made, and the worker started, while the rest is
    this.worker = new Worker('/ui/stock/worker.js', {type: 'module'});
    this.queue = new Queue(this.connection);
    this.time = new TimeBar();
    this.plots = new Plots();
    this.form = new SubmitForm(this.connection, (job) => this.choose(job, {at: null, place: null}));
    this.layers = {...FIRST, look: this.wish.look ?? FIRST.look};
    this.scope = 'read';
    this.chosen = '';
    /** the chosen job once the server has said what it is */
    this.on_stage = '';
    this.residue = null;
    by_id('time').hidden = !this.wish.job;  // it takes its place before the picture has its own
    this.#make_view();
    this.#listen();
    start_tabs((tab) => tab === 'plots' && this.#draw_plots());
    this.#offer_layers();
    this.apply_layers();
    this.take_along = new TakeAlong(this);
  }

  #make_view() {
    try {
      this.view = new View(by_id('canvas'));
    } catch (error) {
      this.worker.terminate();
      by_id('stage-note').textContent = `This browser gives no WebGL 2, so there is no picture; everything else works. (${error.message})`;
      return;
    }
    if (this.wish.job) this.view.pictures.hold(FIRST_PICTURE_MS);
    this.stage = new Stage(this.view, this.worker, this.time, this.connection);
    this.view.addEventListener('lost', () => this.say('The browser lost its graphics; it usually comes back by itself. If not, load the page again.'));
    this.view.addEventListener('restored', () => this.say(''));
    this.view.addEventListener('moved', () => this.#write_address());
    this.stage.addEventListener('note', (event) => { by_id('stage-note').textContent = event.detail; });
    this.stage.addEventListener('started', () => {
      by_id('time').hidden = false;
      this.#offer_layers();
      this.apply_layers();
    });
    this.stage.addEventListener('robot', () => this.apply_layers());
    this.stage.addEventListener('picked', (event) => this.#show_picked(event.detail));
    let plotted = 0;
    this.stage.addEventListener('shown', () => {
      if (performance.now() - plotted < 1000) return;
      plotted = performance.now();
      this.#draw_plots();
      this.#write_address();
    });
  }

  #listen() {
    const {connection, queue} = this;
    connection.addEventListener('open', (event) => this.#on_open(event.detail));
    connection.addEventListener('lost', (event) => {
      by_id('server').className = '';
      by_id('server').textContent = 'not connected';
      this.say(`The connection to the server is lost. It is tried again in ${Math.ceil(event.detail / 1000)} s; jobs go on meanwhile.`);
    });
    connection.addEventListener('refused', (event) => {
      this.say(event.detail.message);
      by_id('show-token').hidden = false;
      if (event.detail.code === 'auth_required') ask_token(event.detail.message);
    });
    queue.addEventListener('chosen', (event) => this.choose(event.detail, {at: null, place: null}));
    queue.addEventListener('changed', (event) => event.detail.job === this.on_stage && this.#on_changed(event.detail));
    queue.addEventListener('gone', (event) => {
      if (event.detail === this.chosen) this.say('This job was removed from the server with its results. What is shown stays until you leave it.');
    });
    by_id('new-job').addEventListener('click', () => this.#open_form());
    by_id('show-help').addEventListener('click', show_help);
    by_id('show-token').addEventListener('click', () => ask_token('The server asks for a token: the operator makes one with sculptd token add.'));
    by_id('pause-queue').addEventListener('click', () => this.#toggle_queue());
    for (const button of by_selector('[data-view]')) button.addEventListener('click', () => this.view?.look_from(button.dataset.view));
    addEventListener('hashchange', () => {
      const {job, at, place} = read_link();
      if (job && job !== this.chosen) this.choose(job, {at, place});
    });
    take_drops((file) => this.#open_form(file), () => this.may('submit'));
    listen_to_keys(this);
  }

  /** @param {'read' | 'submit' | 'admin'} scope */
  may(scope) {
    return RANK[this.scope] >= RANK[scope];
  }

  async #on_open(hello) {
    this.scope = hello.scope;
    by_id('server').className = 'open';
    by_id('server').textContent = [hello.server, hello.owner, this.may('admin') ? '' : `may ${this.scope}`].filter(Boolean).join(' \u00b7 ');
    by_id('new-job').hidden = !this.may('submit');
    by_id('pause-queue').hidden = !this.may('admin');
    this.say('');
    const shown = this.on_stage, {job, at, place} = this.wish;
    try {
      const listed = this.queue.start();
      if (!shown && job) this.choose(job, {at, place});  // the picture does not wait for the list
      await listed;
      if (this.may('admin')) this.#show_queue_state((await this.connection.call('server.info')).queue_paused);
      if (shown) await this.queue.look_up(shown);
      else if (!job) await this.#choose_newest();
    } catch (error) {
      this.say(error.message);
    }
  }

  async #choose_newest() {
    const newest = [...this.queue.jobs.keys()].sort().at(-1);
    if (newest) await this.choose(newest, {at: null, place: null});
    else by_id('stage-note').textContent = this.may('submit') ? 'Drop a mesh anywhere to make a job of it.' : 'There are no jobs yet.';
  }

  /** @param {string} id @param {{at: number | null, place: string | null}} wish */
  async choose(id, wish) {
    this.chosen = id;
    this.on_stage = '';
    this.queue.choose(id);
    this.residue = null;
    by_id('picked').hidden = true;
    this.plots.clear();
    let job;
    try {
      job = await this.queue.look_up(id);
    } catch (error) {
      by_id('job-head').replaceChildren(make('p', {class: 'error'}, error.message));
      this.stage?.close();
      by_id('time').hidden = true;
      by_id('stage-note').textContent = error.message;
      return;
    }
    if (this.chosen !== id) return;
    this.on_stage = id;
    this.queue.choose(id);
    this.#show_head(job);
    this.#write_address();
    const shown = this.stage?.show(job, wish);
    this.#load_results(shown);
    await shown;
  }

  #on_changed(job) {
    this.#show_head(job);
    this.stage?.update(job);
    if (job.state !== this.results_state) this.#load_results();
  }

  #show_head(job) {
    show_job_head(job, {connection: this.connection, scope: this.scope, after: (text) => {
      this.say(text);
      this.queue.look_up(job.job).catch(() => { /* the banner says it */ });
    }});
  }

  /** @param {Promise<void>} [picture] what is less urgent comes after it */
  async #load_results(picture) {
    const id = this.chosen, job = this.queue.jobs.get(id);
    this.results_state = job?.state;
    const finished = job?.state === 'succeeded' || job?.error?.code === 'verify_failed';
    show_report(null, finished ? 'Loading\u2026' : 'The figures are there when the plan is finished.');
    show_residue(null, () => {});
    if (!finished) return;
    try {
      const report = await this.connection.call('job.report', {job: id});
      if (this.chosen !== id) return;
      show_report(report, '');
      await picture;
      const residue = await read_residue(id);
      if (this.chosen !== id) return;
      this.residue = residue;
      show_residue(residue, (voxels, at) => {
        this.stage?.point_out(voxels);
        if (at) this.view?.fly_to(at.map((value) => value / (this.stage.head?.block ?? 1)));
      });
    } catch (error) {
      if (this.chosen === id) show_report(null, error.message);
    }
  }

  async #draw_plots() {
    const {stage, plots} = this;
    if (!stage?.head || plots.hidden) return;
    plots.show_volume(this.time.removed, this.time.keyframes, this.time.remove);
    if (!stage.joints || !stage.robot) return;
    const segment = await stage.joints.around(Math.min(this.time.keyframes - 1, Math.floor(this.time.at)));
    const {names} = stage.joints, limits = names.map((name) => stage.robot.limits(name));
    plots.show_joints(segment, names, limits);
    plots.show_speeds(segment, names, limits);
  }

  #show_picked(hit) {
    const block = this.stage.head?.block ?? 1;
    show_picked(hit, {block, time: this.time, final: this.stage.final, reason_of: (cell) => {
      const inside = ({voxel}) => voxel.every((value, axis) => Math.floor(value / block) === cell[axis]);
      return this.residue?.find(inside)?.reason ?? null;
    }});
  }

  /** What the layers say, in the picture. */
  apply_layers() {
    const {view, stage, layers} = this;
    show_legend(layers.machined ? 'machined' : layers.look, stage?.head ? sentence_of(stage.head) : '');
    if (!view) return;
    view.set_look({look: layers.look, soft: layers.smooth ? 1 : 0});
    view.set_section(layers.axis ? 'xyz'.indexOf(layers.axis) : null, layers.cut_at);
    view.set_scenery(layers.floor, layers.box);
    view.robot?.show(layers.robot);
    view.robot?.set_opacity(layers.opacity);
    stage?.show_path(layers.path);
    stage?.show_machined(layers.machined);
    view.draw();
    this.#write_address();
  }

  /** @param {Partial<typeof FIRST>} changed */
  set_layers(changed) {
    Object.assign(this.layers, changed);
    this.#offer_layers();
    this.apply_layers();
  }

  #offer_layers() {
    const milled = Boolean(this.stage?.head?.header.tools);
    this.layers.machined &&= milled;
    show_layers(this.layers, () => this.apply_layers(), milled);
  }

  #open_form(file) {
    this.form.open(file, this.queue.jobs.get(this.chosen)?.robot ?? '').catch((error) => this.say(error.message));
  }

  /** For the key; the buttons are hidden where it may not be. */
  new_job() {
    if (this.may('submit')) this.#open_form();
  }

  /** @param {string} tab */
  show_tab(tab) {
    show_tab(tab);
  }

  async #toggle_queue() {
    try {
      const paused = by_id('pause-queue').getAttribute('aria-pressed') === 'true';
      this.#show_queue_state((await this.connection.call(paused ? 'queue.resume' : 'queue.pause')).paused);
    } catch (error) {
      this.say(error.message);
    }
  }

  #show_queue_state(paused) {
    by_id('pause-queue').textContent = paused ? 'Queue paused: let jobs start' : 'Pause the queue';
    by_id('pause-queue').setAttribute('aria-pressed', String(paused));
  }

  /** On top of the page. @param {string} text empty: nothing any more */
  say(text) {
    by_id('banner').textContent = text;
    by_id('banner').hidden = !text;
  }

  #write_address() {
    if (!this.chosen) return;
    const {time, stage, view, layers} = this, between = time.keyframes && time.at < time.keyframes && !time.growing;
    write_link({
      job: this.chosen, at: between ? time.at / time.keyframes : null, place: stage?.viewed ? view.place : null, look: layers.look === FIRST.look ? null : layers.look,
    });
  }
}

export const app = new App();

// The list of jobs: the newest first, live.

import {ago, by_id, duration, make} from '../dom.js';

const PAGE = 60;
export const FINAL = new Set(['succeeded', 'failed', 'quarantined', 'expired', 'cancelled']);
const MOVES = new Set(['running', 'pausing', 'cancelling']);

/** What is left of a stage at the pace of its beginning, in seconds; null where nobody knows. */
export function time_left(progress, since_ms) {
  if (!progress || !progress.total || progress.done <= progress.from) return null;
  const seconds = (Date.now() - since_ms) / 1000;
  return (seconds * (progress.total - progress.done)) / (progress.done - progress.from);
}

/** Events: `chosen` with a job's id, `changed` with a job that is known better now, `gone` with the id of a removed one. */
export class Queue extends EventTarget {
  /** @param {import('../wire/connection.js').Connection} connection */
  constructor(connection) {
    super();
    this.connection = connection;
    /** @type {Map<string, any>} */
    this.jobs = new Map();
    this.rows = new Map();
    this.chosen = '';
    connection.addEventListener('event', (event) => this.#on_event(event.detail));
    by_id('filter').addEventListener('input', () => this.#show_all());
    by_id('more-jobs').addEventListener('click', () => this.#load_older());
    setInterval(() => this.#show_all(), 10000);
  }

  /** After a connection was made: the list anew, then everything that happens. */
  async start() {
    const page = await this.connection.call('job.list', {order: 'newest', limit: PAGE});
    for (const job of this.jobs.values()) job.followed = false;
    const listed = new Set(page.jobs.map((job) => job.job));
    for (const id of this.jobs.keys()) if (!listed.has(id) && page.jobs.length && id > page.jobs.at(-1).job) this.#forget(id);
    if (!page.jobs.length) for (const id of [...this.jobs.keys()]) this.#forget(id);
    for (const job of page.jobs) this.#learn(job);
    by_id('more-jobs').hidden = !page.more;
    this.#show_all();
    await this.connection.call('events.subscribe', {after: page.last});
  }

  async #load_older() {
    const oldest = [...this.jobs.keys()].sort()[0];
    const page = await this.connection.call('job.list', {order: 'newest', limit: PAGE, ...(oldest ? {before: oldest} : {})});
    for (const job of page.jobs) this.#learn(job);
    by_id('more-jobs').hidden = !page.more;
    this.#show_all();
  }

  /** @param {string} id @returns {Promise<any>} asks the server; throws ServerError for one that is not there */
  async look_up(id) {
    try {
      const job = await this.connection.call('job.get', {job: id});
      this.#learn(job);
      this.#show_all();
      return job;
    } catch (error) {
      if (error.code === 'gone' || error.code === 'not_found') this.#forget(id);
      throw error;
    }
  }

  /** @param {string} id */
  choose(id) {
    this.chosen = id;
    this.#show_all();
  }

  #learn(job) {
    const before = this.jobs.get(job.job);
    job.progress_since = before?.progress_since;
    if (job.progress) this.#note_progress(job, before?.progress, job.progress);
    this.jobs.set(job.job, job);
    if (MOVES.has(job.state) && !before?.followed) {
      job.followed = true;
      this.connection.call('events.subscribe', {job: job.job}).catch(() => { job.followed = false; });
    } else {
      job.followed = before?.followed && MOVES.has(job.state);
    }
    this.#tell('changed', job);
  }

  #note_progress(job, before, progress) {
    if (before?.stage === progress.stage) {
      progress.from = before.from;
    } else {
      progress.from = progress.done;
      job.progress_since = Date.now();
    }
    job.progress = progress;
  }

  #forget(id) {
    this.jobs.delete(id);
    this.rows.get(id)?.remove();
    this.rows.delete(id);
    this.#tell('gone', id);
  }

  #on_event(event) {
    const job = this.jobs.get(event.job);
    if (event.type === 'progress' && job) {
      this.#note_progress(job, job.progress, event.data);
      this.#show(job);
      this.#tell('changed', job);
    } else if (event.type === 'state' && event.number !== undefined) {
      this.look_up(event.job).catch(() => { /* it is gone already */ });
    }
  }

  #show_all() {
    const list = by_id('jobs'), words = by_id('filter').value.toLowerCase().split(/\s+/).filter(Boolean);
    const jobs = [...this.jobs.values()].sort((a, b) => (a.job < b.job ? 1 : -1));
    for (const job of jobs) {
      const row = this.#show(job);
      const text = [job.job, job.mesh, job.state, job.robot, job.owner, job.search, job.key, job.resolution].join(' ').toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
    }
    const rows = jobs.map((job) => this.rows.get(job.job));
    if (rows.some((row, at) => list.children[at] !== row)) list.replaceChildren(...rows);
    by_id('no-jobs').hidden = jobs.length > 0;
  }

  #show(job) {
    let row = this.rows.get(job.job);
    if (!row) {
      row = make('li', {}, make('button', {on: {click: () => this.#tell('chosen', job.job)}, data: {job: job.job}}));
      this.rows.set(job.job, row);
    }
    const button = row.firstChild;
    button.setAttribute('aria-current', String(job.job === this.chosen));
    const moves = MOVES.has(job.state) && job.progress;
    const left = moves ? time_left(job.progress, job.progress_since) : null;
    const state = job.state === 'queued' && job.position !== undefined ? `queued, ${job.position === 0 ? 'next' : `after ${job.position}`}` : job.state;
    const parts = [
      make('span', {class: 'name'}, job.mesh),
      make('span', {class: `state ${job.state}`}, state + (job.pinned ? ' \u{1F4CC}\ufe0e' : '')),
      make('span', {class: 'what'}, [`${job.resolution}\u00b3`, job.robot, job.owner].filter(Boolean).join(' \u00b7 ')),
      make('span', {class: 'when'}, moves ? `${job.progress.stage}${left === null ? '' : `, ${duration(left)} left`}` : ago(job.finished_at ?? job.submitted_at)),
    ];
    if (moves) parts.push(make('progress', {max: Math.max(1, job.progress.total), value: job.progress.done, aria: {label: `${job.progress.stage} of ${job.mesh}`}}));
    button.replaceChildren(...parts);
    return row;
  }

  #tell(name, detail) {
    this.dispatchEvent(new CustomEvent(name, {detail}));
  }
}

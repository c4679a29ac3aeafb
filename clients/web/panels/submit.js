// A mesh becomes a job: a form that knows what the server takes, and the upload.

import {by_id, make, size} from '../dom.js';
import {get} from '../wire/token.js';
import {upload} from '../wire/upload.js';

export const KINDS = ['stl', 'obj', 'ply', 'gltf', 'glb', 'binvox'];
const MOST_SHOWN = 512;

/** Opens the form; what was chosen last time is chosen again. */
export class SubmitForm {
  /** @param {import('../wire/connection.js').Connection} connection @param {(job: string) => void} on_submitted */
  constructor(connection, on_submitted) {
    this.connection = connection;
    this.on_submitted = on_submitted;
    this.dialog = by_id('submit');
    this.last = {robot: '', resolution: '64', search: '', priority: '0', margin: '0', seed: '0', library: '', tolerance: '0.1', feed: ''};
    /** @type {string[]} names of those that are to be used */
    this.tools = [];
  }

  /** @param {File | undefined} file @param {string} likely a cell, for the first time */
  async open(file, likely) {
    this.last.robot ||= likely;
    if (this.dialog.open) this.dialog.close();
    const [info, schema] = await Promise.all([this.connection.call('server.info'), get('/schema.json').then((reply) => reply.json())]);
    const defs = schema.$defs;
    this.file = file;
    this.libraries = info.tool_libraries;
    this.#draw(info.cells, {
      resolutions: defs.resolution.enum.filter((n) => n <= MOST_SHOWN),
      searches: defs.search.enum,
      priority: defs['job.submit.params'].properties.priority,
    });
    this.dialog.showModal();
  }

  #draw(cells, takes) {
    const {last} = this;
    const option = (name, value, text) => make('option', {value, selected: String(value) === last[name]}, text ?? String(value));
    const field = (label, element) => make('div', {}, make('label', {htmlFor: element.id}, label), element);
    const select = (name, ...options) => make('select', {id: `submit-${name}`, name}, ...options);
    const number = (name, given) => make('input', {id: `submit-${name}`, name, type: 'number', value: last[name], ...given});
    this.note = make('p', {class: 'error', role: 'alert'});
    this.bar = make('progress', {max: 1, value: 0, hidden: true, aria: {label: 'Upload'}});
    this.send = make('button', {class: 'primary', type: 'submit'}, 'Submit');
    const chosen = make('input', {id: 'submit-file', type: 'file', accept: KINDS.map((kind) => `.${kind}`).join(','), on: {change: (event) => { this.file = event.target.files[0]; }}});
    this.dialog.replaceChildren(make('form', {method: 'dialog', on: {submit: (event) => this.#submit(event)}},
      make('h2', {id: 'submit-title'}, 'New job'),
      this.file ? make('p', {}, `${this.file.name}, ${size(this.file.size)}`) : field(`Mesh (${KINDS.join(', ')})`, chosen),
      make('div', {class: 'two'},
        field('Cell', select('robot', ...cells.map((name) => option('robot', name)))),
        field('Voxels along an edge', select('resolution', ...takes.resolutions.map((n) => option('resolution', n)))),
        field('Search', select('search', option('search', '', 'the server\u2019s default'), ...takes.searches.map((name) => option('search', name)))),
        field('Priority', number('priority', {min: takes.priority.minimum, max: takes.priority.maximum, step: 1})),
        field('Free margin, mm', number('margin', {min: 0, max: 1000, step: 'any'})),
        field('Seed', number('seed', {min: 0, step: 1})),
        field('Feed on the robot, mm/s', number('feed', {min: 0.1, max: 10000, step: 'any', placeholder: 'not timed'}))),
      ...this.#tool_fields({field, select, number, option}),
      make('p', {class: 'hint'}, 'The mesh is scaled to fill the stock, centred, standing on the floor.'),
      this.bar, this.note,
      make('menu', {}, make('button', {type: 'button', on: {click: () => this.dialog.close()}}, 'Close'), this.send)));
  }

  // A library, and boxes for its tools: without one the thin tool of the cell is used.
  #tool_fields({field, select, number, option}) {
    const names = Object.keys(this.libraries);
    if (names.length === 0) return [];
    const boxes = make('div', {class: 'tools'});
    const library = select('library', option('library', '', 'none: the thin tool of the cell'), ...names.map((name) => option('library', name)));
    const tolerance = field('Tolerance, mm', number('tolerance', {min: 0.001, max: 10, step: 'any'}));
    const show = () => {
      tolerance.hidden = library.value === '';
      boxes.replaceChildren(...tools_of(this.libraries[library.value]).map((name) =>
        make('label', {}, make('input', {type: 'checkbox', name: 'tools', value: name, checked: this.tools.includes(name) || this.tools.length === 0}), name)));
    };
    library.addEventListener('change', () => {
      this.tools = [];
      show();
    });
    show();
    return [make('div', {class: 'two'}, field('Milling tools', library), tolerance), boxes];
  }

  async #submit(event) {
    event.preventDefault();
    const form = new FormData(event.target);
    for (const name of Object.keys(this.last)) this.last[name] = String(form.get(name) ?? this.last[name]);
    this.tools = form.getAll('tools').map(String);
    if (!this.file) {
      this.note.textContent = 'Choose a mesh first.';
      return;
    }
    this.send.disabled = true;
    this.bar.hidden = false;
    this.note.textContent = '';
    try {
      const blob = await upload(this.connection, this.file, (share) => { this.bar.value = share; });
      this.bar.removeAttribute('value');
      const {job} = await this.connection.call('job.submit', {priority: Number(this.last.priority), spec: this.#spec(blob)});
      this.dialog.close();
      this.on_submitted(job);
    } catch (error) {
      this.note.textContent = error.message;
    } finally {
      this.send.disabled = false;
      this.bar.hidden = true;
    }
  }

  #spec(blob) {
    const {robot, resolution, search, margin, seed, library, tolerance, feed} = this.last;
    const mill = {tools: this.tools, library: this.libraries[library], tolerance_m: Number(tolerance) / 1000};
    return {
      mesh: {blob, name: this.file.name}, robot, resolution: Number(resolution), seed: Number(seed),
      ...(library ? {mill} : search ? {search} : {}), ...(feed ? {motion: {feed_m_s: Number(feed) / 1000}} : {}),
      ...(Number(margin) ? {placement: {margin_m: Number(margin) / 1000}} : {}),
    };
  }
}

// Their names, in the order that they are used in; none of what is no library.
function tools_of(library) {
  return Array.isArray(library?.tools) ? library.tools.map(({name}) => String(name)) : [];
}

/** A mesh that is dropped anywhere opens the form. @param {(file: File) => void} on_file @param {() => boolean} is_allowed */
export function take_drops(on_file, is_allowed) {
  const veil = by_id('drop');
  addEventListener('dragenter', (event) => {
    if (is_allowed() && event.dataTransfer?.types.includes('Files')) veil.hidden = false;
  });
  veil.addEventListener('dragleave', () => { veil.hidden = true; });
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    veil.hidden = true;
    const file = event.dataTransfer?.files[0];
    if (file && is_allowed()) on_file(file);
  });
}

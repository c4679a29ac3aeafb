// What can be taken along: pictures, films, bodies; and the way into one's own room.

import {by_id, make, size} from '../dom.js';
import {has_room_viewer, save, show_in_room} from './save.js';

/** Their files are asked for when the first body is. */
const FORMS = {
  glb: {name: 'GLB', pack: async (body, of) => (await import('../export/glb.js')).to_glb(body, of)},
  usdz: {name: 'USDZ', pack: async (body, of) => (await import('../export/usdz.js')).to_usdz(body, of)},
};
/** @type {['stock' | 'sculpture', string][]} */
const BODIES = [['stock', 'Stock as it is now'], ['sculpture', 'Sculpture']];
const SCALES = [['1', '1 : 1'], ['0.5', '1 : 2'], ['0.2', '1 : 5']];

/**
 * @typedef {object} World
 * @property {() => import('../stage.js').Stage | undefined} stage
 * @property {() => string} name of the files, without what follows the dot
 * @property {() => Promise<void>} save_picture
 * @property {() => Promise<void>} film begins one, or ends it
 * @property {(thing: 'stock' | 'cell', scale: number) => Promise<void>} enter_room
 */

/** @param {World} world @param {string} no_room why there is no way into one's room; empty: there is one */
export function show_export(world, no_room) {
  const note = make('p', {id: 'export-note', class: 'hint', role: 'status'});
  const told = (/** @type {() => Promise<string | void>} */ action) => async () => {
    note.textContent = '';
    note.classList.remove('error');
    try {
      note.textContent = (await action()) ?? '';
    } catch (error) {
      note.classList.add('error');
      note.textContent = error.message;
    }
  };
  const body_of = async (what, form) => {
    const stage = world.stage();
    if (!stage) throw new Error('without WebGL 2 nothing is exported: sculpt fetch JOB --artifact stock has the voxels');
    const body = await stage.outline(what), {header} = stage.head;
    return FORMS[form].pack(body, {size_m: header.voxel_m * header.resolution, name: world.name()});
  };
  const save_body = (what, form) => told(async () => {
    const blob = await body_of(what, form);
    save(blob, `${world.name()}-${what}.${form}`);
    return `${FORMS[form].name} of ${size(blob.size)} saved, in metres, y up.`;
  });
  const scale = make('select', {id: 'room-scale'}, ...SCALES.map(([value, text]) => make('option', {value}, text)));
  const enter = (thing) => told(() => world.enter_room(thing, Number(scale.value)));
  const rooms = no_room ? [make('p', {class: 'hint'}, no_room)] : [
    make('div', {class: 'actions'}, make('button', {on: {click: enter('stock')}}, 'Stock'), make('button', {on: {click: enter('cell')}}, 'Whole cell'),
      make('label', {htmlFor: 'room-scale'}, 'Scale'), scale),
    make('p', {class: 'hint'}, 'Point at table or floor and tap: it stands there, as large as it is. Scrub and play as here.'),
  ];
  by_id('panel-export').replaceChildren(
    make('h3', {}, 'Picture and film'),
    make('div', {class: 'actions'}, make('button', {on: {click: told(world.save_picture)}}, 'Picture (PNG)'), make('button', {id: 'film', on: {click: told(world.film)}}, 'Film it')),
    ...BODIES.flatMap(([what, title]) => [make('h3', {}, title), make('div', {class: 'actions'},
      ...Object.keys(FORMS).map((form) => make('button', {data: {export: `${what}-${form}`}, on: {click: save_body(what, form)}}, FORMS[form].name)),
      has_room_viewer() && make('button', {on: {click: told(async () => show_in_room(await body_of(what, 'usdz')))}}, 'In your room'))]),
    make('h3', {}, 'In your room'), ...rooms, note);
}

/** @param {boolean} filming */
export function show_filming(filming) {
  const button = by_id('film');
  if (!button) return;
  button.textContent = filming ? 'End the film' : 'Film it';
  button.setAttribute('aria-pressed', String(filming));
}

// What leaves the page: pictures, films and bodies as files, and the stock in one's own room.

import {by_id} from './dom.js';
import {Film} from './export/film.js';
import {show_export, show_filming} from './panels/export.js';
import {save} from './panels/save.js';
import {Room, why_no_room} from './view/room.js';

const STILL_MS = 50;

export class TakeAlong {
  /** @param {import('./app.js').app} app */
  constructor(app) {
    this.app = app;
    /** @type {Film | null} */
    this.film = null;
    if (app.view) this.#make_room(app);
    this.#show_panel();
  }

  /** @returns {string} of a file, without what follows the dot */
  get name() {
    return this.app.queue.jobs.get(this.app.chosen)?.mesh.replace(/\.[^.]*$/, '') ?? 'sculptd';
  }

  async #show_panel() {
    const {app} = this;
    show_export({
      stage: () => app.stage, name: () => this.name, save_picture: () => this.save_picture(), film: () => this.toggle_film(),
      enter_room: (thing, scale) => this.room.enter({thing, scale, overlay: document.body}),
    }, app.view ? await why_no_room() : 'Without WebGL 2 there is no way into your room.');
  }

  #make_room(app) {
    const room = this.room = new Room(app.view, app.time), note = (text) => { by_id('room-note').textContent = text; };
    const show = (entered) => {
      document.body.classList.toggle('in-room', entered);
      by_id('room-bar').hidden = !entered;
      note('Point at table or floor, and tap.');
      if (!entered) app.apply_layers();
    };
    room.addEventListener('entered', () => show(true));
    room.addEventListener('left', () => show(false));
    room.addEventListener('placed', () => note(''));
    by_id('turn-left').addEventListener('click', () => room.turn(1));
    by_id('turn-right').addEventListener('click', () => room.turn(-1));
    by_id('place-again').addEventListener('click', () => room.place_again());
    by_id('leave-room').addEventListener('click', () => room.leave());
    for (const bar of ['room-bar', 'time']) by_id(bar).addEventListener('beforexrselect', (event) => event.preventDefault());  // no tap on the room
  }

  /** Of what is seen. Throws an Error with a sentence. */
  async save_picture() {
    if (!this.app.view) throw new Error('without WebGL 2 there is no picture: sculpt render JOB draws one');
    save(await this.app.view.picture(), `${this.name}.png`);
  }

  /** Plays from the beginning of the loop or plan to its end, and saves the film of it; while it runs, ends it. Throws an Error with a sentence. */
  async toggle_film() {
    const {time, stage, view} = this.app;
    if (this.film) return time.stop();
    if (!stage?.head) throw new Error('there is no plan to film: choose a job that is planned');
    time.stop();
    const film = this.film = new Film(view.canvas);
    show_filming(true);
    const stopped = new Promise((resolve) => time.addEventListener('stopped', resolve, {once: true}));
    time.go(time.span[0]);
    const still = setInterval(() => view.draw(), STILL_MS);  // what is not drawn anew is not filmed
    await film.begun;
    clearInterval(still);
    time.play(false);
    await stopped;
    this.film = null;
    show_filming(false);
    save(await film.stop(), `${this.name}.${film.extension}`);
  }
}

// What the keys do; panels/dialogs.js lists them for people.

import {by_id} from './dom.js';
import {show_help} from './panels/dialogs.js';

const LOOKS = ['plain', 'time', 'side', 'classes'];
const VIEWS = ['cell', 'stock', 'front', 'right', 'top'];
const TYPES = 'input:not([type=range]):not([type=checkbox]), select, textarea, dialog';

/** @param {typeof import('./app.js').app} app */
export function listen_to_keys(app) {
  const {time} = app, complain = (/** @type {Error} */ error) => app.say(error.message);
  /** @type {Record<string, (event: KeyboardEvent) => void>} */
  const keys = {
    ' ': () => time.toggle_play(),
    ArrowLeft: (event) => (event.shiftKey ? time.step_share(-0.01) : time.step_row(-1)),
    ArrowRight: (event) => (event.shiftKey ? time.step_share(0.01) : time.step_row(1)),
    Home: () => time.go(0),
    End: () => time.go(time.keyframes),
    a: () => time.mark('a'),
    b: () => time.mark('b'),
    f: () => app.take_along.toggle_film().catch(complain),
    l: () => time.set_live(!time.live),
    r: () => app.set_layers({robot: app.layers.robot === 'none' ? 'collision' : 'none'}),
    c: () => app.set_layers({look: LOOKS[(LOOKS.indexOf(app.layers.look) + 1) % LOOKS.length]}),
    w: () => app.set_layers({path: !app.layers.path}),
    n: () => app.new_job(),
    p: () => app.take_along.save_picture().catch(complain),
    j: () => next_job(app, 1),
    k: () => next_job(app, -1),
    '/': () => by_id('filter').focus(),
    '?': () => show_help(),
    Escape: () => { by_id('picked').hidden = true; },
  };
  VIEWS.forEach((view, at) => { keys[String(at + 1)] = () => app.view?.look_from(view); });
  addEventListener('keydown', (event) => {
    const target = /** @type {Element} */ (event.target);
    if (event.ctrlKey || event.altKey || event.metaKey || target.closest?.(TYPES)) return;
    if (event.key === ' ' && target.closest?.('button, a')) return;
    if (target.closest?.('[role=tablist]') && event.key.startsWith('Arrow')) return;
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}

function next_job(app, way) {
  const jobs = [...app.queue.jobs.keys()].sort().reverse();
  const next = jobs[jobs.indexOf(app.chosen) + way];
  if (next) app.choose(next, {at: null, place: null});
}

// The chosen job's name, state and what may be done with it; errors in the server's words.

import {ago, by_id, count, fill, make} from '../dom.js';
import {get} from '../wire/token.js';

const WAITS = ['held', 'queued', 'backoff'];
/** @type {[string, string, string[]][]} method, what the button says, states in which it may be used */
const ACTIONS = [
  ['job.pause', 'Pause', [...WAITS, 'running']],
  ['job.resume', 'Resume', ['paused']],
  ['job.cancel', 'Cancel', [...WAITS, 'paused', 'running', 'pausing']],
  ['job.retry', 'Retry', ['quarantined']],
];
/** @type {[string, string][]} artifact, format */
const RESULTS = [['trajectory', 'ndjson'], ['trajectory', 'binary'], ['trajectory', 'csv'], ['voxels', ''], ['residue', ''], ['report', '']];
/** @type {[string, string][]} */
const OF_TOOLS = [['surface', ''], ['stock', 'zip']];

/**
 * @param {any} job
 * @param {{connection: import('../wire/connection.js').Connection, scope: string, after: (text: string) => void}} world `after`: says what went wrong
 */
export function show_job_head(job, world) {
  const ask = async (method, params) => {
    try {
      await world.connection.call(method, {job: job.job, ...params});
      world.after('');
    } catch (error) {
      world.after(error.message);
    }
  };
  const may = world.scope !== 'read';
  const damaged = job.error?.code === 'artifact_damaged';
  const buttons = may ? ACTIONS.filter(([method, , states]) => states.includes(job.state) || (method === 'job.retry' && damaged)).map(([method, text]) =>
    make('button', {class: method === 'job.cancel' ? 'danger' : '', on: {click: () => ask(method)}}, text)) : [];
  if (may) buttons.push(make('button', {aria: {pressed: String(Boolean(job.pinned))}, title: 'A pinned job is never removed', on: {click: () => ask('artifact.pin', {pinned: !job.pinned})}}, 'Pin'));
  const progress = job.progress && ['running', 'pausing', 'cancelling'].includes(job.state);
  fill(by_id('job-head'),
    make('h2', {}, job.mesh, ' ', make('span', {class: `state ${job.state}`}, job.state)),
    make('div', {class: 'hint'}, `${job.resolution}\u00b3 voxels, ${job.robot}, ${job.search}${job.owner ? `, by ${job.owner}` : ''}, submitted ${ago(job.submitted_at)}`),
    make('div', {class: 'id', title: 'The id of the job'}, job.job),
    job.error ? make('p', {class: 'error'}, `${job.error.code}: ${job.error.message}`) : null,
    progress ? make('div', {class: 'hint'}, `${job.progress.stage}: ${count(job.progress.done)} of ${count(job.progress.total)}`,
      make('progress', {max: Math.max(1, job.progress.total), value: job.progress.done, aria: {label: job.progress.stage}})) : null,
    make('div', {class: 'actions'}, ...buttons, job.state === 'succeeded' ? download_menu(job, world) : null),
  );
}

function download_menu(job, world) {
  const results = job.search === 'mill' ? [...RESULTS, ...OF_TOOLS] : RESULTS;
  const menu = make('select', {aria: {label: 'Download a result'}, on: {change: () => download(job.job, results[Number(menu.value) - 1], menu, world)}},
    make('option', {value: ''}, 'Download\u2026'),
    ...results.map(([artifact, format], at) => make('option', {value: String(at + 1)}, format ? `${artifact} (.${format === 'binary' ? 'sct' : format})` : artifact)));
  return menu;
}

async function download(job, [artifact, format], menu, world) {
  menu.value = '';
  try {
    const link = await world.connection.call('artifact.link', {job, artifact, ...(format ? {format} : {})});
    const name = link.path.split('/').pop();
    make('a', {href: link.path, download: `${job}-${name}`}).click();
    world.after('');
  } catch (error) {
    world.after(error.message);
  }
}

/** @param {string} job @returns {Promise<any[]>} the residue, one entry a voxel */
export async function read_residue(job) {
  const {body} = await get(`/v1/artifacts/${job}/residue?format=gzip`), text = await new Response(body.pipeThrough(new DecompressionStream('gzip'))).text();
  return text.split('\n').filter(Boolean).map((line) => JSON.parse(line));
}

// The figures of a finished job: what `sculpt report` prints.

import {by_id, count, duration, make, percent, size} from '../dom.js';

const STAGES = ['load', 'voxelize', 'octree', 'plan', 'verify'];

const row = (name, value, more) => make('tr', {}, make('th', {scope: 'row'}, name), make('td', {class: 'number'}, value), make('td', {class: 'number'}, more ?? ''));
const table = (title, ...rows) => [make('h3', {}, title), make('table', {}, make('tbody', {}, ...rows))];

/** @param {any} report of job.report @param {string} why what to say where there is none */
export function show_report(report, why) {
  const panel = by_id('panel-report');
  if (!report) return panel.replaceChildren(make('p', {class: 'hint'}, why));
  const {voxels, path, seconds, verify} = report;
  const longest = Math.max(...STAGES.map((stage) => seconds[stage]), 1e-9);
  panel.replaceChildren(
    ...table('Voxels',
      row('grid', `${report.resolution}\u00b3`, count(voxels.total)),
      row('to remove', count(voxels.remove), percent(voxels.remove, voxels.total)),
      row('removed', count(voxels.removed), percent(voxels.removed, voxels.remove)),
      row('residue', count(voxels.residue), percent(voxels.residue, voxels.remove)),
      row('keep', count(voxels.keep), percent(voxels.keep, voxels.total))),
    ...table('Path',
      row('keyframes', count(path.keyframes)),
      row('rows', count(path.rows)),
      row('transits', count(path.transits)),
      row('cut', `${path.cut_m.toFixed(2)} m`),
      row('travel', `${path.travel_m.toFixed(2)} m`),
      row('joint travel', `${count(path.joint_travel_rad)} rad`)),
    ...table('Time to plan', ...STAGES.map((stage) => {
      const bar = make('span', {class: 'share'});
      bar.style.width = `${(100 * seconds[stage]) / longest}%`;
      return make('tr', {}, make('th', {scope: 'row'}, stage), make('td', {class: 'number'}, duration(seconds[stage])), make('td', {class: 'bar'}, bar));
    }), row('in all', duration(seconds.total))),
    ...table('Replay',
      row('verdict', verify.clean ? 'clean' : `${count(verify.collisions)} findings`),
      row('voxels checked', count(verify.voxels_checked))),
    ...verify.findings.slice(0, 5).map((finding) => make('p', {class: 'error'}, finding)),
    ...table('Run',
      row('search', report.search), row('seed', String(report.seed)), row('threads', String(report.threads)), row('memory', size(report.peak_memory_bytes))),
    make('p', {class: 'hint'}, `plan sha256 ${report.plan_sha256.slice(0, 16)}\u2026`),
  );
}

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
    ...of_tools(report),
    ...on_robot(report),
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

/** What a plan with milling tools has besides. @param {any} report @returns {HTMLElement[]} */
function of_tools({tools, surface, cures}) {
  if (!tools) return [];
  const micrometres = (metres) => `${count(metres * 1e6)} \u00b5m`;
  const shares = ({points, within_tolerance, excess_m}) => [
    row('within tolerance', percent(within_tolerance, points), `${count(points)} points`), row('p99 above', micrometres(excess_m.p99), `max ${micrometres(excess_m.max)}`)];
  return [
    ...table('Tools', ...tools.map(({name, removed_m3, cut_m, travel_m}) => row(name, `${(removed_m3 * 1e6).toFixed(1)} cm\u00b3`, `${cut_m.toFixed(1)} m cut, ${travel_m.toFixed(1)} m beside`))),
    ...surface ? [
      ...table('Surface', ...shares(surface)), ...table('Of what these tools reach', ...shares(surface.reachable)),
      ...table('Cut too deep', row('points', count(surface.gouged_points), micrometres(surface.gouge_m)))] : [],
    ...(cures ?? []).length ? [make('h3', {}, 'What is left'), ...cures.map(({share, cure}) => make('p', {class: 'hint'}, `${percent(share, 1)}: ${cure}`))] : [],
  ];
}

/** How long it takes on the robot and what limits it, where the job asked for a feed. @param {any} report @returns {HTMLElement[]} */
function on_robot({time}) {
  if (!time) return [];
  const speed = (metres) => `${(1000 * metres).toFixed(1)} mm/s`, part = (cause, seconds) => row(cause, duration(seconds), percent(seconds, time.total_s));
  const {feed, rapid, ...limits} = time.by, [slowest] = time.worst;
  const by_joint = Object.entries(limits).flatMap(([limit, joints]) => Object.entries(joints).map(([joint, seconds]) => ({cause: `${limit} of ${joint}`, seconds})));
  return table('On the robot',
    row('in all', duration(time.total_s)), row('at most on cuts', speed(time.feed_m_s)), row('on moves', speed(time.rapid_m_s)),
    part('limited by the feed', feed), part('by that of moves', rapid),
    ...by_joint.filter(({seconds}) => seconds > 0).sort((a, b) => b.seconds - a.seconds).map(({cause, seconds}) => part(cause, seconds)),
    ...slowest ? [row('slowest cut', speed(slowest.feed_m_s), `keyframe ${count(slowest.keyframe)}, ${slowest.joint}`)] : []);
}

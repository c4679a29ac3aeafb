// Removed volume over the plan, and the joints around the playhead: where they are and how fast they would have to go.

import {by_id, count, duration, make} from '../dom.js';
import {speed_shares} from '../plan/speeds.js';
import {uPlot} from '../vendor/libraries.js';

const POINTS = 600;
const COLOURS = ['#3b6fb5', '#b5683b', '#4f9463', '#a8475e', '#7a62b0', '#8a8436', '#3f8f96', '#8c8c8c', '#b04fa0', '#5f6b1f'];

/** Remembers the plots, so that the next ones take their place. */
export class Plots {
  constructor() {
    this.panel = by_id('panel-plots');
    this.volume_box = make('div');
    this.joints_box = make('div');
    this.note = make('p', {class: 'hint'});
    this.speeds_box = make('div');
    this.speeds_note = make('p', {class: 'hint'});
    this.panel.replaceChildren(make('h3', {}, 'Removed'), this.volume_box, make('h3', {}, 'Joints around now'), this.joints_box, this.note,
      make('h3', {}, 'Speeds around now'), this.speeds_box, this.speeds_note);
  }

  clear() {
    this.volume_box.replaceChildren();
    this.joints_box.replaceChildren();
    this.speeds_box.replaceChildren();
    this.note.textContent = this.speeds_note.textContent = '';
  }

  get hidden() {
    return this.panel.hidden;
  }

  /** @param {Uint32Array} removed after each keyframe @param {number} keyframes @param {number} remove voxels in all */
  show_volume(removed, keyframes, remove) {
    if (this.hidden || keyframes < 2) return;
    const step = Math.max(1, Math.floor(keyframes / POINTS)), x = [], y = [];
    for (let at = 0; at < keyframes; at += step) {
      x.push(at + 1);
      y.push((100 * removed[at]) / Math.max(1, remove));
    }
    x.push(keyframes);
    y.push((100 * removed[keyframes - 1]) / Math.max(1, remove));
    this.#draw(this.volume_box, [x, y], [{label: '% removed', stroke: COLOURS[0], fill: '#3b6fb533'}], [0, 100]);
  }

  /**
   * @param {{first: number, columns: Float64Array[]}} segment
   * @param {string[]} names
   * @param {({lower: number, upper: number} | null)[]} limits
   */
  show_joints(segment, names, limits) {
    if (this.hidden) return;
    const length = segment.columns[0].length, step = Math.max(1, Math.floor(length / POINTS)), x = [];
    for (let at = 0; at < length; at += step) x.push(segment.first + at + 1);
    const share = (value, limit) => (limit && limit.upper > limit.lower ? (100 * (value - limit.lower)) / (limit.upper - limit.lower) : value);
    const columns = segment.columns.map((column, joint) => x.map((_, at) => share(column[at * step], limits[joint])));
    this.#draw(this.joints_box, [x, ...columns], names.map((label, at) => ({label, stroke: COLOURS[at % COLOURS.length]})), [0, 100]);
    this.note.textContent = `Each joint from its lower (0 %) to its upper limit (100 %), keyframes ${count(x[0])} to ${count(segment.first + length)}.`;
  }

  /**
   * A plan has no times yet: each motion is taken as fast as its joints allow.
   * @param {{first: number, columns: Float64Array[]}} segment
   * @param {string[]} names
   * @param {({velocity: number} | null)[]} limits
   */
  show_speeds(segment, names, limits) {
    if (this.hidden) return;
    const found = speed_shares(segment.columns, limits.map((limit) => limit?.velocity ?? 0), POINTS);
    if (!found) {
      this.speeds_box.replaceChildren();
      this.speeds_note.textContent = 'The robot\u2019s description (URDF) gives no greatest speed of each joint: limit velocity.';
      return;
    }
    const x = found.at.map((at) => segment.first + at + 1);
    this.#draw(this.speeds_box, [x, ...found.shares], names.map((label, at) => ({label, stroke: COLOURS[at % COLOURS.length]})), [0, 100]);
    const slowest = names.map((name, at) => ({name, share: found.slowest[at]})).filter(({share}) => share >= 0.005).sort((a, b) => b.share - a.share);
    this.speeds_note.textContent = `Each motion as fast as its joints\u2019 greatest speeds (100 %) allow: these keyframes then take ${duration(found.seconds)}, at least. `
      + `What limits them: ${slowest.map(({name, share}) => `${name} ${Math.round(100 * share)} %`).join(', ')} of that time.`;
  }

  #draw(box, data, series, range) {
    const ink = getComputedStyle(document.body).color, grid = {stroke: 'rgb(128 128 128 / .22)', width: 1};
    const axis = {stroke: ink, grid, ticks: grid, font: '11px system-ui', size: 48};
    box.replaceChildren();
    new uPlot({
      width: Math.max(220, this.panel.clientWidth || 300), height: 190,
      scales: {x: {time: false}, y: {range}},
      axes: [{...axis, size: 28, values: (_, ticks) => ticks.map((tick) => (tick >= 1000 ? `${tick / 1000}k` : tick))}, {...axis, values: (_, ticks) => ticks.map((tick) => `${tick} %`)}],
      series: [{label: 'keyframe', value: (_, value) => (value === null ? '' : count(value))}, ...series.map((one) => ({width: 1.4, points: {show: false}, value: (_, value) => (value === null ? '' : `${value.toFixed(1)} %`), ...one}))],
      legend: {live: true},
    }, data, box);
  }
}

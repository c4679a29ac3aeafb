// The place in the plan: a slider, playing, rows, and following a plan that is still made.

import {by_id, count, percent} from '../dom.js';

const MOVE = '#b9a06a', CUT = ['#5b88b5', '#3f6f9f', '#6f9a86', '#4b8069', '#8a79ad', '#6c5a94', '#4f7f9c'];
const GROWN_MS = 100;

/** Events: `moved` with the place in keyframes, `stopped` when playing ended, by itself or not. */
export class TimeBar extends EventTarget {
  constructor() {
    super();
    this.at = 0;
    this.live = false;
    this.growing = false;
    this.playing = false;
    /** @type {ReturnType<typeof setTimeout> | null} until what was added is seen */
    this.showing = null;
    /** asks for the next picture's time: a headset has a clock of its own */
    this.next_frame = (/** @type {FrameRequestCallback} */ draw) => requestAnimationFrame(draw);
    this.clear();
    const slider = by_id('playhead');
    slider.addEventListener('input', () => this.#by_hand(Number(slider.value)));
    slider.addEventListener('keydown', (event) => {
      if (event.key !== 'Tab') event.preventDefault();  // the page's own keys work from here too
    });
    by_id('to-start').addEventListener('click', () => this.#by_hand(0));
    by_id('to-end').addEventListener('click', () => this.#by_hand(this.keyframes));
    by_id('row-back').addEventListener('click', () => this.step_row(-1));
    by_id('row-on').addEventListener('click', () => this.step_row(1));
    by_id('play').addEventListener('click', () => this.toggle_play());
    by_id('live').addEventListener('click', () => this.set_live(!this.live));
    by_id('mark-a').addEventListener('click', () => this.mark('a'));
    by_id('mark-b').addEventListener('click', () => this.mark('b'));
    new ResizeObserver(() => this.#draw_strip()).observe(by_id('strip'));
  }

  clear() {
    this.removed = new Uint32Array(1 << 14);
    this.kinds = new Uint8Array(1 << 14);
    /** @type {{keyframe: number, tool: number}[]} of milling tools */
    this.changes = [];
    this.keyframes = 0;
    this.at = 0;
    this.remove = 0;
    /** @type {{a: number | null, b: number | null}} keyframes between which a loop plays */
    this.marks = {a: null, b: null};
    this.stop();
    this.#show();
    this.#show_marks();
  }

  /** Begin or end of what is played: here, or where it is here already, as if it was never set. @param {'a' | 'b'} name */
  mark(name) {
    this.marks[name] = this.marks[name] === this.at ? null : this.at;
    const {a, b} = this.marks;
    if (a !== null && b !== null && a >= b) this.marks[name === 'a' ? 'b' : 'a'] = null;
    if (this.marks.a !== null || this.marks.b !== null) by_id('loop').checked = true;
    this.#show_marks();
  }

  /** @returns {[number, number]} keyframes that are played, from and to */
  get span() {
    return [this.marks.a ?? 0, this.marks.b ?? this.keyframes];
  }

  #show_marks() {
    for (const name of ['a', 'b']) {
      const at = this.marks[name];
      by_id(`mark-${name}`).setAttribute('aria-pressed', String(at !== null));
      by_id(`mark-${name}`).title = at === null ? `The loop ${name === 'a' ? 'begins' : 'ends'} here (${name.toUpperCase()})` : `Keyframe ${count(at)}; again there: take it away`;
    }
    this.#draw_strip();
  }

  /** @param {{removed: Uint32Array, kinds: Uint8Array, changes: {keyframe: number, tool: number}[], keyframes: number}} grown */
  add(grown) {
    this.changes.push(...grown.changes);
    while (this.removed.length < grown.keyframes) {
      for (const name of ['removed', 'kinds']) {
        const larger = new this[name].constructor(2 * this[name].length);
        larger.set(this[name]);
        this[name] = larger;
      }
    }
    this.removed.set(grown.removed, this.keyframes);
    this.kinds.set(grown.kinds, this.keyframes);
    this.keyframes = grown.keyframes;
    if (this.live) this.#go(this.keyframes);
    this.showing ??= setTimeout(() => this.#show_grown(), GROWN_MS);
  }

  // Of many pieces at once: each would be a picture of the page.
  #show_grown() {
    this.showing = null;
    this.#show();
    this.#draw_strip();
  }

  /** @param {boolean} growing a plan that is still made */
  set_growing(growing) {
    this.growing = growing;
    by_id('live').hidden = !growing;
    if (!growing) this.set_live(false);
  }

  /** @param {boolean} live */
  set_live(live) {
    this.live = live && this.growing;
    by_id('live').setAttribute('aria-pressed', String(this.live));
    if (this.live) {
      this.stop();
      this.#go(this.keyframes);
    }
  }

  /** @returns {number} voxels cut at that place; within a cut, those that its share has reached */
  get cut() {
    const whole = Math.min(this.keyframes, Math.floor(this.at));
    const before = whole === 0 ? 0 : this.removed[whole - 1];
    if (whole >= this.keyframes) return before;
    return before + Math.floor((this.at - whole) * (this.removed[whole] - before) + 1e-9);
  }

  /** @returns {number} of the milling tools, the one that is in the spindle now */
  get tool() {
    return this.changes.filter(({keyframe}) => keyframe < this.at).pop()?.tool ?? 0;
  }

  /** @param {number} ordinal of a voxel @returns {number} the keyframe that cuts it, from 0 */
  keyframe_of(ordinal) {
    let low = 0, high = this.keyframes - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.removed[middle] >= ordinal) high = middle;
      else low = middle + 1;
    }
    return low;
  }

  /** @param {number} at keyframes */
  go(at) {
    this.#by_hand(at);
  }

  /** @param {1 | -1} way to the next or last beginning of a row or of a move */
  step_row(way) {
    const is_start = (keyframe) => this.kinds[keyframe] & 8 || (this.kinds[keyframe] === 0) !== (keyframe > 0 && this.kinds[keyframe - 1] === 0);
    let at = way > 0 ? Math.floor(this.at) + 1 : Math.ceil(this.at) - 1;
    while (at > 0 && at < this.keyframes && !is_start(at)) at += way;
    this.#by_hand(at);
  }

  /** @param {number} share of the whole */
  step_share(share) {
    this.#by_hand(this.at + share * this.keyframes);
  }

  toggle_play() {
    if (this.playing) return this.stop();
    this.play(by_id('loop').checked);
  }

  /** From here, or from the beginning where this is the end; `loop`: again and again. @param {boolean} loop */
  play(loop) {
    this.set_live(false);
    const [from, to] = this.span;
    if (this.at >= to || (loop && this.at < from)) this.#go(from);
    this.playing = true;
    let last = /** @type {number | null} */ (null);
    const frame = (/** @type {number} */ now) => {
      if (!this.playing) return;
      const pace = this.keyframes / Number(by_id('speed').value), [begin, end] = this.span;
      let at = Math.min(end, this.at + (pace * (now - (last ?? now))) / 1000);
      last = now;
      if (at >= end && loop) at = begin;
      this.#go(at);
      if (at >= end && !this.growing) return this.stop();
      this.next_frame(frame);
    };
    this.next_frame(frame);
    this.#show_play();
  }

  stop() {
    const was_playing = this.playing;
    this.playing = false;
    this.#show_play();
    if (was_playing) this.dispatchEvent(new CustomEvent('stopped'));
  }

  #by_hand(at) {
    this.set_live(false);
    this.#go(at);
  }

  #go(at) {
    this.at = Math.min(this.keyframes, Math.max(0, at));
    this.#show();
    this.dispatchEvent(new CustomEvent('moved', {detail: this.at}));
  }

  #show_play() {
    by_id('play-icon').setAttribute('d', this.playing ? 'M3 1h4v14H3zM9 1h4v14H9z' : 'M3 1v14l11-7z');
    by_id('play').setAttribute('aria-label', this.playing ? 'Pause' : 'Play');
  }

  #show() {
    const slider = by_id('playhead');
    slider.max = String(Math.max(1, this.keyframes));
    slider.value = String(this.at);
    const text = `keyframe ${count(Math.floor(this.at))} of ${count(this.keyframes)}, ${count(this.cut)} voxels`;
    slider.setAttribute('aria-valuetext', `${text}, ${percent(this.cut, this.remove)}`);
    by_id('clock').textContent = `${text}${this.remove ? `, ${percent(this.cut, this.remove)}` : ''}`;
  }

  // What most of the keyframes of each column do.
  #draw_strip() {
    const canvas = by_id('strip'), width = canvas.clientWidth, pen = canvas.getContext('2d');
    if (!width) return;
    canvas.width = width;
    const most = new Uint32Array(8);
    for (let x = 0; x < width; ++x) {
      const from = Math.floor((x * this.keyframes) / width), to = Math.max(from + 1, Math.floor(((x + 1) * this.keyframes) / width));
      const step = Math.max(1, Math.floor((to - from) / 64));
      most.fill(0);
      for (let at = from; at < to && at < this.keyframes; at += step) ++most[this.kinds[at] & 7];
      const kind = most.indexOf(Math.max(...most));
      pen.fillStyle = this.keyframes === 0 ? '#8884' : kind === 0 ? MOVE : CUT[kind - 1];
      pen.fillRect(x, 0, 1, canvas.height);
    }
    pen.fillStyle = '#000a';
    const [from, to] = this.span.map((at) => (width * at) / Math.max(1, this.keyframes));
    if (this.marks.a !== null) pen.fillRect(0, 0, from, canvas.height);
    if (this.marks.b !== null) pen.fillRect(to, 0, width, canvas.height);
  }
}

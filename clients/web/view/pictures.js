// When pictures are drawn: one at a time, for if the graphics card is slow those that are begun meanwhile would show what is old by then. It gets drafts
// while anything moves, and a fine picture when nothing has moved for a while.

const FENCE_MS = 4, STILL_MS = 100, SLOW_MS = 60, FEW_FACES = 50_000;

export class Pictures {
  #wanted = false;
  #drawing = false;
  #at_work = false;         // the graphics card
  #swift_faces = 0;         // so many are drawn finely in no time, as far as is known: the first picture is a draft
  /** @type {(() => void) | null} ends the wait for a fine picture */
  #wake = null;
  /** @type {Promise<void> | null} */
  #held = null;
  /** @type {(() => void) | null} */
  #let_go = null;

  /** @param {import('./view.js').View} view of which they are; it is told `drawn` when the graphics card is done with one */
  constructor(view) {
    this.view = view;
    this.paused = false;    // who measures wants faces alone
    this.is_draft = false;  // the last one
    this.begun = 0;
  }

  /** Another one, soon. */
  want() {
    if (this.paused || this.view.renderer.xr.isPresenting) return;
    this.#wanted = true;
    if (this.#drawing) this.#wake?.();
    else this.#draw();
  }

  /** None is begun before it is let go: what it shall show is on its way. @param {number} [most_ms] so long and no longer */
  hold(most_ms) {
    if (most_ms) setTimeout(() => this.go_on(), most_ms);
    this.#held ??= new Promise((let_go) => { this.#let_go = let_go; });
  }

  go_on() {
    this.#let_go?.();
    this.#held = this.#let_go = null;
  }

  /** @returns {boolean} none is begun now */
  get held() { return this.#held !== null; }

  /** @returns {boolean} one is about to be drawn, or is drawn */
  get behind() {
    return !this.paused && !this.view.renderer.xr.isPresenting && ((this.#wanted && !this.held) || this.#at_work);
  }

  /** @returns {boolean} a fine one of what is there takes long, as far as is known */
  get are_slow() {
    return this.view.shell.faces > this.#swift_faces;
  }

  async #draw() {
    this.#drawing = true;
    try {
      while (this.#wanted || this.is_draft) {
        if (!this.#wanted) await this.#rest();
        do {
          await this.#held;
          await new Promise(requestAnimationFrame);
        } while (this.held);
        if (this.paused) break;
        await this.#draw_one();
        this.view.dispatchEvent(new CustomEvent('drawn'));
      }
    } finally {
      this.#drawing = this.#at_work = false;
    }
  }

  async #draw_one() {
    const begin = performance.now();
    this.is_draft = this.#wanted && this.are_slow;
    this.#wanted = false;
    this.#at_work = true;
    ++this.begun;
    this.view.draw_now(this.is_draft);
    await this.#done();
    this.#at_work = false;
    if (!this.is_draft) this.#learn(performance.now() - begin);
  }

  #learn(fine_ms) {
    const {faces} = this.view.shell;
    this.#swift_faces = fine_ms > SLOW_MS ? Math.min(this.#swift_faces, faces / 2) : Math.max(this.#swift_faces, faces, FEW_FACES);
  }

  // Until another one is wanted, but not for long.
  #rest() {
    return new Promise((end) => {
      this.#wake = () => end(undefined);
      setTimeout(this.#wake, STILL_MS);
    });
  }

  // The graphics card is done with the last one, which other programs may have held up.
  async #done() {
    const gl = /** @type {WebGL2RenderingContext} */ (this.view.renderer.getContext());
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (fence && !gl.isContextLost() && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) await new Promise((next) => setTimeout(next, FENCE_MS));
    gl.deleteSync(fence);
  }
}

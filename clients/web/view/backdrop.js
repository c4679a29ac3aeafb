// What is behind the cell: paper and floor, dark or light as the page is.

import {Color, GridHelper, LineBasicMaterial} from '../vendor/libraries.js';

const PAPER = {light: '#eef0f2', dark: '#14181d'}, LINES = {light: '#c5cbd1', dark: '#2a313a'};

export class Backdrop {
  /** @param {import('../vendor/libraries.js').Scene} scene @param {() => void} changed */
  constructor(scene, changed) {
    this.scene = scene;
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const paint = () => this.#paint(dark.matches ? 'dark' : 'light');
    dark.addEventListener('change', () => { paint(); changed(); });
    paint();
  }

  /** @param {'light' | 'dark'} theme */
  #paint(theme) {
    this.scene.background = new Color(PAPER[theme]);
    const shown = this.floor?.visible ?? true;
    this.floor?.removeFromParent();
    this.floor = new GridHelper(4, 40);
    this.floor.material = new LineBasicMaterial({color: LINES[theme]});  // its own would need another program than the block's edges
    this.floor.rotation.x = Math.PI / 2;
    this.floor.position.z = -0.051;
    this.floor.visible = shown;
    this.scene.add(this.floor);
  }
}

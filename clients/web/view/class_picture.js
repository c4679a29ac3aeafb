// What is seen along an axis, as numbers: without light, perspective or smoothing, so that it can be held against rays.

import {NearestFilter, OrthographicCamera, Scene, WebGLRenderTarget} from '../vendor/libraries.js';

/**
 * For each of (edge x scale)^2 pixels, row by row from below, four bytes: class + 1 or 0 for nothing, the place along the axis, the side, 255.
 * @param {import('./view.js').View} view
 * @param {number} axis @param {boolean} from_above from its upper end
 * @param {number} scale pixels along a cell
 */
export function class_picture({renderer, shell, material, edge}, axis, from_above, scale) {
  const size = edge * scale;
  const target = new WebGLRenderTarget(size, size, {minFilter: NearestFilter, magFilter: NearestFilter, samples: 0});
  shell.show_to(null, edge);
  shell.send();
  const alone = new Scene(), twin = shell.body.clone();
  twin.visible = true;
  alone.add(twin);
  set_bare(material, true);
  renderer.setRenderTarget(target);
  renderer.setClearColor('#000000', 0);
  renderer.clear();
  renderer.render(alone, camera_along(axis, from_above, edge));
  const pixels = new Uint8Array(size * size * 4);
  renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
  renderer.setRenderTarget(null);
  set_bare(material, false);
  target.dispose();
  return {size, pixels};
}

/** @param {number} axis @param {boolean} from_above @param {number} edge cells */
function camera_along(axis, from_above, edge) {
  const camera = new OrthographicCamera(-edge / 2, edge / 2, edge / 2, -edge / 2, 0.5, 2 * edge);
  const place = [edge / 2, edge / 2, edge / 2];
  place[axis] += (from_above ? 1 : -1) * edge;
  camera.up.set(0, axis === 2 ? 1 : 0, axis === 2 ? 0 : 1);
  camera.position.fromArray(place);
  camera.lookAt(edge / 2, edge / 2, edge / 2);
  return camera;
}

/** @param {import('../vendor/libraries.js').ShaderMaterial} material @param {boolean} bare */
function set_bare(material, bare) {
  material.defines = bare ? {BARE: true} : {};
  material.needsUpdate = true;
}

// A picture with smoothed edges. The canvas itself has none: where there is no graphics card smoothing takes most of a picture's time, of drafts too.

import {GLSL3, Mesh, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, WebGLRenderTarget} from '../vendor/libraries.js';

const SAMPLES = 4;
const COPY_VERTEX = /* glsl */ `
out vec2 at;
void main() {
  at = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;
const COPY_FRAGMENT = /* glsl */ `
in vec2 at;
out vec4 colour;
uniform sampler2D drawn;
void main() { colour = texture(drawn, at); }`;

export class Smooth {
  constructor() {
    // Colours as the canvas has them, so that the same programs draw both: three does so for what a headset shows.
    this.target = Object.assign(new WebGLRenderTarget(1, 1, {colorSpace: 'srgb', internalFormat: 'RGBA8', samples: SAMPLES}), {isXRRenderTarget: true});
    const material = new ShaderMaterial({
      glslVersion: GLSL3, vertexShader: COPY_VERTEX, fragmentShader: COPY_FRAGMENT, uniforms: {drawn: {value: this.target.texture}}, depthTest: false, depthWrite: false,
    });
    this.copy = new Scene();
    this.copy.add(new Mesh(new PlaneGeometry(2, 2), material));
    this.camera = new OrthographicCamera();
  }

  /**
   * @param {import('../vendor/libraries.js').WebGLRenderer} renderer whose canvas gets the picture
   * @param {import('../vendor/libraries.js').Scene} scene @param {import('../vendor/libraries.js').PerspectiveCamera} camera
   */
  draw(renderer, scene, camera) {
    const {width, height} = renderer.domElement;
    this.target.setSize(width, height);
    renderer.setRenderTarget(this.target);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.copy, this.camera);
  }
}

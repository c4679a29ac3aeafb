// How the faces of the stock look: one shader, whose colours are a matter of uniforms, so that another look needs no new faces.

import {Color, GLSL3, ShaderMaterial, Vector3, Vector4} from '../vendor/libraries.js';

export const LOOKS = {plain: 0, time: 1, side: 2, classes: 3};

// Faces are seen from both sides only where a section is, and without light (`BARE`) only where pictures are held against rays.
const NEEDS_PLACE = `
#if defined(BARE) || defined(DOUBLE_SIDED)
#define NEEDS_PLACE
#endif`;

const VERTEX = /* glsl */ `${NEEDS_PLACE}
precision highp int;
in uvec2 face;
uniform float soft;
flat out vec3 v_normal;
#ifdef NEEDS_PLACE
out vec3 v_place;
#endif
flat out uint v_class;
flat out uint v_bucket;
flat out uint v_side;
void main() {
  v_class = face.x >> 30;
  v_side = face.y & 7u;
  v_bucket = (face.y >> 3) & 4095u;
  if (face.x == 0xffffffffu && face.y == 0xffffffffu) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec3 cell = vec3(float(face.x & 1023u), float((face.x >> 10) & 1023u), float((face.x >> 20) & 1023u));
  int axis = int(v_side >> 1);
  bool up = (v_side & 1u) == 1u;
  uint corner = uint(gl_VertexID) & 3u;
  float a = corner == 1u || corner == 2u ? 1.0 : 0.0;
  float b = corner >= 2u ? 1.0 : 0.0;
  if (!up) { float swap = a; a = b; b = swap; }
  vec3 offset = axis == 0 ? vec3(up ? 1.0 : 0.0, a, b) : axis == 1 ? vec3(b, up ? 1.0 : 0.0, a) : vec3(a, b, up ? 1.0 : 0.0);
  vec2 packed_normal = vec2(float((face.y >> 15) & 255u), float((face.y >> 23) & 255u)) / 255.0 * 2.0 - 1.0;
  vec3 smooth_normal = vec3(packed_normal, 1.0 - abs(packed_normal.x) - abs(packed_normal.y));
  if (smooth_normal.z < 0.0) smooth_normal.xy = (1.0 - abs(smooth_normal.yx)) * vec2(smooth_normal.x < 0.0 ? -1.0 : 1.0, smooth_normal.y < 0.0 ? -1.0 : 1.0);
  vec3 flat_normal = vec3(0.0);
  flat_normal[axis] = up ? 1.0 : -1.0;
  v_normal = normalMatrix * normalize(mix(flat_normal, normalize(smooth_normal), soft));
  vec3 place = cell + offset;
#ifdef NEEDS_PLACE
  v_place = place;
#endif
  gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
}`;

const FRAGMENT = /* glsl */ `${NEEDS_PLACE}
precision highp float;
precision highp int;
flat in vec3 v_normal;
#ifdef NEEDS_PLACE
in vec3 v_place;
#endif
flat in uint v_class;
flat in uint v_bucket;
flat in uint v_side;
uniform int look;
uniform float share;
uniform vec4 clip;
uniform vec3 eye;
uniform vec3 excess, keep, residue, chosen, inside;
uniform vec3 sides[6];
uniform vec3 ramp[5];
out vec4 colour;
vec3 along(float t) {
  float at = clamp(t, 0.0, 1.0) * 4.0;
  int low = int(min(3.0, floor(at)));
  return mix(ramp[low], ramp[low + 1], at - float(low));
}
void main() {
#ifdef DOUBLE_SIDED
  if (dot(clip.xyz, v_place) > clip.w) discard;
#endif
#ifdef BARE
  vec3 cell = floor(v_place - 0.5 * (vec3(v_side == 1u, v_side == 3u, v_side == 5u) - vec3(v_side == 0u, v_side == 2u, v_side == 4u)));
  int axis = int(v_side >> 1);
  colour = vec4(float(v_class + 1u), axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z, float(v_side), 255.0) / 255.0;
#else
  vec3 base = v_class == 3u ? chosen : v_class == 2u ? residue : v_class == 1u && look == 3 ? keep : look == 3 ? excess : keep;
  if (v_class < 2u) {
    if (look == 0) base = v_bucket == 4095u ? excess : keep;
    if (look == 1) base = v_bucket == 4095u ? excess : along(float(v_bucket) / 4094.0 / max(share, 0.001));
    if (look == 2) base = v_bucket == 4095u ? excess : sides[v_side];
  }
  vec3 n = normalize(v_normal);
  float key = max(0.0, dot(n, normalize(vec3(-0.45, 0.75, 0.6))));
  float fill = max(0.0, dot(n, normalize(vec3(0.8, 0.1, 0.5))));
  float sky = 0.5 + 0.5 * n.y;
  float rim = pow(1.0 - max(0.0, n.z), 3.0);
  colour = vec4(base * (0.26 + 0.22 * sky + 0.62 * key + 0.14 * fill) + 0.05 * rim, 1.0);
#ifdef DOUBLE_SIDED
  gl_FragDepth = gl_FrontFacing ? gl_FragCoord.z : gl_FragCoord.z - 3e-6;  // before the table that they lie on
  if (!gl_FrontFacing) {
    // A face seen from behind is seen through the cut: what is drawn is the cut, hatched, where the line of sight goes through its plane.
    vec3 way = v_place - eye;
    vec3 on_plane = eye + way * (clip.w - dot(clip.xyz, eye)) / dot(clip.xyz, way);
    float shade = 0.86 + 0.14 * step(0.5, fract((on_plane.x + on_plane.y + on_plane.z) / 4.0));
    colour = vec4(inside * shade, 1.0);
  }
#endif
  colour = linearToOutputTexel(colour);
#endif
}`;

/** Safe for the colour blind: after cividis. */
export const RAMP = ['#00224e', '#434e6c', '#7d7c78', '#bcaf6f', '#fee838'];
export const SIDES = ['#8a6fb0', '#4f8fc4', '#c9924a', '#6aa56a', '#b36a6a', '#d8c27a'];

/** @returns {ShaderMaterial} */
export function stock_material() {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      soft: {value: 1},
      look: {value: LOOKS.plain},
      share: {value: 1},
      clip: {value: new Vector4(0, 0, 0, 1)},
      eye: {value: new Vector3()},
      excess: {value: new Color('#9a8f80')},
      keep: {value: new Color('#e9e2d4')},
      residue: {value: new Color('#d1495b')},
      chosen: {value: new Color('#ffb000')},
      inside: {value: new Color('#b5835a')},
      sides: {value: SIDES.map(linear)},
      ramp: {value: RAMP.map(linear)},
    },
  });
}

/** @param {string} text */
function linear(text) {
  const {r, g, b} = new Color(text);
  return new Vector3(r, g, b);
}

// What a view of the surface shows at each of its pixels.
import * as THREE from 'three';

// The field, the one that it is compared with, or by how much the two differ.
export const FIELD = 0;
export const OTHER = 1;
export const ERROR = 2;

const DEFINES = `
  #define OTHER ${OTHER}
  #define ERROR ${ERROR}
`;

const VERTEX = `${DEFINES}
  attribute float distance;
  attribute float cell;
  attribute float otherDistance;
  attribute float otherCell;
  uniform int shows;
  attribute float error;
  attribute vec2 chart;
  varying float vError;
  varying vec2 vChart;
  varying float vDistance;
  varying float vCell;
  varying vec3 vPosition;
  void main() {
    vDistance = shows == OTHER ? otherDistance : distance;
    vCell = shows == OTHER ? otherCell : cell;
    vError = error;
    vChart = chart;
    vec4 p = modelViewMatrix * vec4(position, 1.0);
    vPosition = p.xyz;
    gl_Position = projectionMatrix * p;
  }`;

// Isolines have a constant width on the screen, whatever the spacing of the values there; where they would run together
// they fade.
const FRAGMENT = `${DEFINES}
  uniform sampler2D colours;
  uniform float farthest, spacing, front, pixel;
  uniform bool showCells;
  uniform int shows;
  uniform bool hasArcs; // which are drawn in place of the lines between values of the first field
  uniform float worst; // the largest error
  uniform float widest; // the largest value with the sign of a side; below 0: sides are not shown
  uniform float tile; // the width of a tile of the pattern, or of the picture; below 0: there is none
  uniform bool hasPicture;
  uniform sampler2D picture;
  varying float vError;
  varying vec2 vChart;
  varying float vDistance;
  varying float vCell;
  varying vec3 vPosition;
  vec3 hue(float turns) { return mix(clamp(abs(6.0 * fract(turns + vec3(0.0, 2.0, 1.0) / 3.0) - 3.0) - 1.0, 0.0, 1.0), vec3(0.55), 0.35); }
  // Blue on the left, red on the right, lighter towards the curve.
  vec3 side(float share) { return mix(vec3(0.97), share < 0.0 ? vec3(0.13, 0.4, 0.67) : vec3(0.7, 0.09, 0.17), sqrt(abs(share))); }
  // A pattern in the coordinates of the log map. Triangles over which they jump, where ways around meet, show none.
  vec3 decal(vec3 ground) {
    vec2 grain = fwidth(vChart);
    if (!(length(vChart) < 1e30) || length(grain) > 3.0 * length(fwidth(vPosition))) return ground;
    vec2 at = vChart / tile;
    if (hasPicture) {
      vec4 ink = texture2D(picture, at + 0.5);
      return all(lessThan(abs(at), vec2(0.5))) ? mix(ground, ink.rgb, ink.a) : ground;
    }
    vec2 edge = abs(fract(at - 0.5) - 0.5) / max(fwidth(at), 1e-9);
    float odd = mod(floor(at.x) + floor(at.y), 2.0);
    return mix(vec3(0.5), mix(vec3(0.96), ground * 0.55, odd), clamp(min(edge.x, edge.y), 0.0, 1.0));
  }
  void main() {
    bool reached = vDistance < 1e30;
    vec3 colour = reached ? texture2D(colours, vec2(clamp(vDistance / farthest, 0.0, 1.0), 0.5)).rgb : vec3(0.6);
    if (showCells && reached) colour = mix(hue(vCell * 0.382), colour, 0.35);
    if (shows == ERROR && reached) colour = abs(vError) <= 1e30 ? texture2D(colours, vec2(worst > 0.0 ? abs(vError) / worst : 0.0, 0.5)).rgb : vec3(0.6);
    if (widest >= 0.0 && reached) colour = side(widest > 0.0 ? vError / widest : 0.0);
    if (tile > 0.0 && reached) colour = decal(colour);
    vec3 normal = normalize(cross(dFdx(vPosition), dFdy(vPosition)));
    float light = 0.35 + 0.65 * abs(normal.z);
    if (reached && spacing > 0.0 && tile <= 0.0 && (!hasArcs || shows == OTHER)) {
      float steps = vDistance / spacing;
      float width = fwidth(steps);
      float line = abs(fract(steps - 0.5) - 0.5) / max(width, 1e-9);
      float ink = (1.0 - smoothstep(0.4 * pixel, 1.1 * pixel, line)) * (1.0 - smoothstep(0.2, 0.5, width)) * step(0.5, steps);
      colour = mix(colour, vec3(0.05), 0.8 * ink);
    }
    if (front >= 0.0) {
      if (vDistance > front) colour = mix(colour, vec3(0.5), 0.85);
      else colour = mix(vec3(1.0, 0.6, 0.1), colour, smoothstep(0.0, 0.04 * farthest, front - vDistance));
    }
    gl_FragColor = vec4(light * colour, 1.0);
  }`;

export const uniformsFor = (pixelRatio) => ({
  shows: { value: FIELD }, colours: { value: null }, farthest: { value: 1 }, spacing: { value: 0 }, hasArcs: { value: false }, front: { value: -1 },
  pixel: { value: pixelRatio }, showCells: { value: false }, worst: { value: 0 },
  widest: { value: -1 }, tile: { value: -1 }, hasPicture: { value: false }, picture: { value: null },
});

// Pushed back by as little as lets lines on the surface be seen.
export const surfaceMaterial = (uniforms) => new THREE.ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });

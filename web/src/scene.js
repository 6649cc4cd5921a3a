// The surface on the screen: colours and isolines by the distance at its vertices, sources, a path, what is under a pixel.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const VERTEX = `
  attribute float distance;
  attribute float cell;
  attribute float error;
  attribute vec2 chart;
  varying float vError;
  varying vec2 vChart;
  varying float vDistance;
  varying float vCell;
  varying vec3 vPosition;
  void main() {
    vDistance = distance;
    vCell = cell;
    vError = error;
    vChart = chart;
    vec4 p = modelViewMatrix * vec4(position, 1.0);
    vPosition = p.xyz;
    gl_Position = projectionMatrix * p;
  }`;

// Isolines have a constant width on the screen, whatever the spacing of the values there; where they would run together
// they fade.
const FRAGMENT = `
  uniform sampler2D colours;
  uniform float farthest, spacing, front, pixel;
  uniform bool showCells;
  uniform float worst; // the largest error; below 0: errors are not shown
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
    if (worst >= 0.0 && reached) colour = abs(vError) <= 1e30 ? texture2D(colours, vec2(worst > 0.0 ? abs(vError) / worst : 0.0, 0.5)).rgb : vec3(0.6);
    if (widest >= 0.0 && reached) colour = side(widest > 0.0 ? vError / widest : 0.0);
    if (tile > 0.0 && reached) colour = decal(colour);
    vec3 normal = normalize(cross(dFdx(vPosition), dFdy(vPosition)));
    float light = 0.35 + 0.65 * abs(normal.z);
    if (reached && spacing > 0.0 && tile <= 0.0) {
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

export class Scene {
  #canvas; #renderer; #camera; #orbit; #scene = new THREE.Scene(); #surface = null; #marks = new THREE.Group(); #walls = new THREE.Group(); #path = null;
  #ray = new THREE.Raycaster(); #drawn = false; #size = 1;

  constructor(canvas) {
    this.#canvas = canvas;
    this.#renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true, alpha: true });
    this.#renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.#renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours of the map come out as they are
    this.#camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.#orbit = new OrbitControls(this.#camera, canvas);
    this.#orbit.addEventListener('change', () => this.draw());
    this.#scene.add(this.#marks, this.#walls);
    this.uniforms = {
      colours: { value: null }, farthest: { value: 1 }, spacing: { value: 0 }, front: { value: -1 },
      pixel: { value: this.#renderer.getPixelRatio() }, showCells: { value: false }, worst: { value: -1 },
      widest: { value: -1 }, tile: { value: -1 }, hasPicture: { value: false }, picture: { value: null },
    };
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
  }

  // Redraws before the next frame, once.
  draw() {
    if (this.#drawn) return;
    this.#drawn = true;
    requestAnimationFrame(() => {
      this.#drawn = false;
      this.#renderer.render(this.#scene, this.#camera);
    });
  }

  // `keepsView`: it is the same surface as before, cut open in another way.
  showMesh(vertices, faces, { low, high }, keepsView = false) {
    this.#surface?.geometry.dispose();
    if (this.#surface) this.#scene.remove(this.#surface);
    const middle = low.map((l, k) => (l + high[k]) / 2);
    this.#size = Math.max(1e-300, Math.hypot(...low.map((l, k) => high[k] - l)) / 2);
    const positions = new Float32Array(vertices.length);
    for (let i = 0; i < vertices.length; ++i) positions[i] = (vertices[i] - middle[i % 3]) / this.#size;
    this.middle = middle;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute('distance', new THREE.BufferAttribute(new Float32Array(vertices.length / 3).fill(1e31), 1));
    geometry.setAttribute('cell', new THREE.BufferAttribute(new Float32Array(vertices.length / 3), 1));
    geometry.setAttribute('error', new THREE.BufferAttribute(new Float32Array(vertices.length / 3), 1));
    geometry.setAttribute('chart', new THREE.BufferAttribute(new Float32Array(2 * (vertices.length / 3)), 2));
    geometry.setIndex(new THREE.BufferAttribute(faces, 1));
    this.#surface = new THREE.Mesh(geometry, new THREE.ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: this.uniforms, side: THREE.DoubleSide }));
    this.#scene.add(this.#surface);
    this.showPath(null);
    if (keepsView) return;
    this.showSources([]);
    this.showWalls([]);
    this.home();
  }

  home() {
    this.#orbit.target.set(0, 0, 0);
    this.#camera.position.set(1.6, 1.1, 2.8);
    this.#orbit.update();
    this.draw();
  }

  showField(distance, source) {
    const to = this.#surface.geometry.getAttribute('distance');
    const cell = this.#surface.geometry.getAttribute('cell');
    for (let v = 0; v < distance.length; ++v) to.array[v] = Number.isFinite(distance[v]) ? distance[v] : 1e31;
    cell.array.set(source);
    to.needsUpdate = cell.needsUpdate = true;
    this.draw();
  }

  // Colours by values with a sign instead, the largest of which is `widest`; null: no longer.
  showSides(values, widest) {
    const to = this.#surface.geometry.getAttribute('error');
    if (values) for (let v = 0; v < values.length; ++v) to.array[v] = Number.isFinite(values[v]) ? values[v] : 0;
    to.needsUpdate = true;
    this.uniforms.widest.value = values ? widest : -1;
    this.draw();
  }

  // A pattern by two coordinates per vertex, in tiles as wide as `tile`, or a picture that wide; null: none.
  showChart(chart, tile) {
    if (chart) {
      const to = this.#surface.geometry.getAttribute('chart');
      for (let i = 0; i < chart.length; ++i) to.array[i] = Number.isNaN(chart[i]) ? 1e31 : chart[i] / this.#size;
      to.needsUpdate = true;
    }
    this.uniforms.tile.value = chart ? tile / this.#size : -1;
    this.draw();
  }

  // An ImageBitmap in place of the tiles; null: tiles again.
  setPicture(bitmap) {
    this.uniforms.picture.value?.dispose();
    const texture = bitmap && new THREE.CanvasTexture(bitmap);
    this.uniforms.picture.value = texture;
    this.uniforms.hasPicture.value = bitmap !== null;
    this.draw();
  }

  // Colours by errors instead, the largest of which is `worst`; null: by distances again.
  showError(errors, worst) {
    const to = this.#surface.geometry.getAttribute('error');
    if (errors) for (let v = 0; v < errors.length; ++v) to.array[v] = Number.isNaN(errors[v]) ? 1e31 : errors[v];
    to.needsUpdate = true;
    this.uniforms.worst.value = errors ? worst : -1;
    this.draw();
  }

  #inView(positions) {
    const out = new Float32Array(positions.length);
    for (let i = 0; i < positions.length; ++i) out[i] = (positions[i] - this.middle[i % 3]) / this.#size;
    return out;
  }

  // A dot at each place, and the curves among the sources.
  showSources(positions, curves = []) {
    this.#empty(this.#marks);
    const p = this.#inView(positions);
    for (let i = 0; i < p.length; i += 3) {
      const mark = new THREE.Mesh(new THREE.SphereGeometry(0.018, 16, 12), new THREE.MeshBasicMaterial({ color: 0xd62728 }));
      mark.position.set(p[i], p[i + 1], p[i + 2]);
      this.#marks.add(mark);
    }
    for (const { positions: line } of curves) if (line.length > 3) this.#marks.add(this.#tube(line, 0.009));
    this.draw();
  }

  showWalls(lines) {
    this.#empty(this.#walls);
    for (const { positions } of lines) if (positions.length > 3) this.#walls.add(this.#tube(positions, 0.012, 0x202020));
    this.draw();
  }

  #empty(group) {
    for (const m of group.children) { m.geometry.dispose(); m.material.dispose(); }
    group.clear();
  }

  showPath(positions) {
    this.#path = this.#replaced(this.#path, positions?.length > 3 ? this.#tube(positions, 0.006) : null);
    this.draw();
  }

  #replaced(old, tube) {
    if (old) {
      this.#scene.remove(old);
      old.geometry.dispose();
      old.material.dispose();
    }
    if (tube) this.#scene.add(tube);
    return tube;
  }

  #tube(positions, radius, color = 0xd62728) {
    const points = this.#inView(positions);
    const curve = new THREE.CurvePath();
    for (let i = 3; i < points.length; i += 3) {
      curve.add(new THREE.LineCurve3(new THREE.Vector3(...points.subarray(i - 3, i)), new THREE.Vector3(...points.subarray(i, i + 3))));
    }
    const steps = Math.min(2000, 4 * (points.length / 3));
    return new THREE.Mesh(new THREE.TubeGeometry(curve, steps, radius, 6), new THREE.MeshBasicMaterial({ color }));
  }

  // The number that a face that is drawn has for others.
  faceOf = (face) => face;

  // {face, weights} under a point of the canvas, in pixels of the page; null: nothing.
  pick(x, y) {
    if (!this.#surface) return null;
    const box = this.#canvas.getBoundingClientRect();
    this.#ray.setFromCamera(new THREE.Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height), this.#camera);
    const [hit] = this.#ray.intersectObject(this.#surface);
    if (!hit) return null;
    const at = this.#surface.geometry.getAttribute('position');
    const corner = (v) => new THREE.Vector3().fromBufferAttribute(at, v);
    const w = THREE.Triangle.getBarycoord(hit.point, corner(hit.face.a), corner(hit.face.b), corner(hit.face.c), new THREE.Vector3());
    if (!w) return null;
    const weights = w.toArray().map((x_) => Math.max(0, x_));
    const sum = weights[0] + weights[1] + weights[2];
    return { face: this.faceOf(hit.faceIndex), weights: weights.map((x_) => x_ / sum) };
  }

  // Where a position of the mesh is on the page.
  onPage(x, y, z) {
    const p = new THREE.Vector3(...this.#inView([x, y, z])).project(this.#camera);
    const box = this.#canvas.getBoundingClientRect();
    return { x: box.left + ((p.x + 1) / 2) * box.width, y: box.top + ((1 - p.y) / 2) * box.height };
  }

  turn(right, up) {
    const offset = this.#camera.position.clone().sub(this.#orbit.target);
    const s = new THREE.Spherical().setFromVector3(offset);
    s.theta += right;
    s.phi = Math.min(Math.PI - 0.01, Math.max(0.01, s.phi - up));
    this.#camera.position.setFromSpherical(s).add(this.#orbit.target);
    this.#orbit.update();
    this.draw();
  }

  zoom(factor) {
    this.#camera.position.sub(this.#orbit.target).multiplyScalar(factor).add(this.#orbit.target);
    this.#orbit.update();
    this.draw();
  }

  set turning(on) {
    this.#orbit.enabled = on;
  }

  async picture() {
    this.#renderer.render(this.#scene, this.#camera);
    return new Promise((resolve) => this.#canvas.toBlob(resolve, 'image/png'));
  }

  setColours(rgba) {
    const texture = new THREE.DataTexture(rgba, rgba.length / 4, 1);
    texture.magFilter = texture.minFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    this.uniforms.colours.value?.dispose();
    this.uniforms.colours.value = texture;
    this.draw();
  }

  #resize() {
    const { clientWidth: w, clientHeight: h } = this.#canvas.parentElement;
    this.#renderer.setSize(w, h, false);
    this.#camera.aspect = w / Math.max(1, h);
    this.#camera.updateProjectionMatrix();
    this.draw();
  }
}

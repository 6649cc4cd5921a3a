// The surface on the screen, in one view or several: colours and isolines by the distance at its vertices, sources, a path,
// what is under a pixel.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';

import { layout } from './panes.js';
import { FIELD, OTHER, surfaceMaterial, uniformsFor } from './shader.js';

const FIELD_OF_VIEW = 35; // degrees
const NONE = 1e31; // as the shader has it: beyond every number

// What vertices have beside their positions, before anything is known, and how many numbers that are.
const ATTRIBUTES = [['distance', NONE, 1], ['cell', 0, 1], ['otherDistance', NONE, 1], ['otherCell', 0, 1], ['error', 0, 1], ['chart', 0, 2]];

export class Scene {
  #canvas; #renderer; #camera; #orbit; #scene = new THREE.Scene(); #surface = null; #marks = new THREE.Group(); #walls = new THREE.Group(); #path = null;
  #ray = new THREE.Raycaster(); #drawn = false; #size = 1; #arcs = null; #panes = [FIELD];

  constructor(canvas) {
    this.#canvas = canvas;
    this.#renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true, alpha: true });
    this.#renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.#renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours of the map come out as they are
    this.#camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
    this.#orbit = new OrbitControls(this.#camera, canvas);
    this.#orbit.addEventListener('change', () => this.draw());
    this.#scene.add(this.#marks, this.#walls);
    this.uniforms = uniformsFor(this.#renderer.getPixelRatio());
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
  }

  // Redraws before the next frame, once.
  draw() {
    if (this.#drawn) return;
    this.#drawn = true;
    requestAnimationFrame(() => {
      this.#drawn = false;
      this.#render();
    });
  }

  // What the views show, from left to right.
  set panes(panes) {
    this.#panes = panes;
    this.#aim();
    this.draw();
  }

  #render() {
    const box = this.#canvas.parentElement;
    const rectangles = layout(box.clientWidth, box.clientHeight, this.#panes.length);
    this.#renderer.setScissorTest(rectangles.length > 1);
    this.#panes.forEach((shows, k) => {
      const { x, y, width, height } = rectangles[k];
      for (const set of ['setViewport', 'setScissor']) this.#renderer[set](x, box.clientHeight - y - height, width, height); // from below
      this.uniforms.shows.value = shows;
      if (this.#arcs) this.#arcs.visible = shows !== OTHER;
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
    for (const [name, value, size] of ATTRIBUTES) {
      geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(size * (vertices.length / 3)).fill(value), size));
    }
    geometry.setIndex(new THREE.BufferAttribute(faces, 1));
    this.#surface = new THREE.Mesh(geometry, surfaceMaterial(this.uniforms));
    this.#scene.add(this.#surface);
    this.showPath(null);
    this.showArcs(null);
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
    this.#set('distance', distance);
    this.#set('cell', source);
    this.draw();
  }

  // What it is compared with, and by how much it differs from that, `worst` at most.
  showOther({ distance, source }, errors, worst) {
    this.#set('otherDistance', distance);
    this.#set('otherCell', source);
    this.#set('error', errors);
    this.uniforms.worst.value = worst;
    this.draw();
  }

  #set(name, values, unit = 1) {
    const to = this.#surface.geometry.getAttribute(name);
    for (let i = 0; i < values.length; ++i) to.array[i] = Number.isFinite(values[i]) ? values[i] / unit : NONE;
    to.needsUpdate = true;
  }

  // Colours by values with a sign instead, the largest of which is `widest`; null: no longer.
  showSides(values, widest) {
    if (values) this.#set('error', values);
    this.uniforms.widest.value = values ? widest : -1;
    this.draw();
  }

  // A pattern by two coordinates per vertex, in tiles as wide as `tile`, or a picture that wide; null: none.
  showChart(chart, tile) {
    if (chart) this.#set('chart', chart, this.#size);
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

  // Isolines as they are, in place of those between the values; null: no longer.
  showArcs(curves) {
    const points = [];
    for (const { positions } of curves ?? []) {
      const p = this.#inView(positions);
      for (let i = 3; i < p.length; i += 3) for (let k = -3; k < 3; ++k) points.push(p[i + k]);
    }
    const lines = points.length === 0 ? null : new LineSegments2(new LineSegmentsGeometry().setPositions(points), new LineMaterial({ color: 0x101010, linewidth: 1.6 }));
    this.#arcs = this.#replaced(this.#arcs, lines);
    this.uniforms.hasArcs.value = curves !== null;
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

  // The view at a point of the page, as a rectangle of the page.
  #paneAt(x, y) {
    const rectangles = this.#onScreen();
    return rectangles.find((r) => x < r.x + r.width && y < r.y + r.height) ?? rectangles.at(-1);
  }

  #onScreen() {
    const box = this.#canvas.getBoundingClientRect();
    return layout(box.width, box.height, this.#panes.length).map((r) => ({ ...r, x: box.left + r.x, y: box.top + r.y }));
  }

  // {face, weights} under a point of the canvas, in pixels of the page; null: nothing.
  pick(x, y) {
    if (!this.#surface) return null;
    const pane = this.#paneAt(x, y);
    this.#ray.setFromCamera(new THREE.Vector2((2 * (x - pane.x)) / pane.width - 1, 1 - (2 * (y - pane.y)) / pane.height), this.#camera);
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

  // Where a position of the mesh is on the page, in each view.
  onPage(x, y, z) {
    const p = new THREE.Vector3(...this.#inView([x, y, z])).project(this.#camera);
    return this.#onScreen().map((r) => ({ x: r.x + ((p.x + 1) / 2) * r.width, y: r.y + ((1 - p.y) / 2) * r.height }));
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
    this.#render();
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
    this.#aim();
    this.draw();
  }

  // As much of the surface across a narrow view as across a square one.
  #aim() {
    const { clientWidth: w, clientHeight: h } = this.#canvas.parentElement;
    const [{ width, height }] = layout(w, h, this.#panes.length);
    this.#camera.aspect = width / Math.max(1, height);
    this.#camera.fov = 2 * THREE.MathUtils.radToDeg(Math.atan(Math.tan(THREE.MathUtils.degToRad(FIELD_OF_VIEW / 2)) / Math.min(1, this.#camera.aspect)));
    this.#camera.updateProjectionMatrix();
  }
}

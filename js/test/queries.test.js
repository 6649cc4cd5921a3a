// What is read off a field: facts that follow from geometry, and from other calls.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { bf, difference, meshes } from './support.js';

const near = (a, b, most = 1e-9) => assert.ok(Math.abs(a - b) <= most * Math.max(1, Math.abs(b)), `${a} is not ${b}`);

for (const [name, make, source] of meshes) {
  test(`${name}: paths are as long as the exact field says, by any door`, () => {
    const mesh = make();
    const field = mesh.field(source);
    const targets = [1, mesh.vertexCount >> 1, mesh.vertexCount - 1].filter((v) => Number.isFinite(field.distance[v]));
    const paths = field.paths(targets);
    targets.forEach((v, k) => {
      near(paths[k].length, field.distance[v]);
      near(mesh.path([source, v]).length, field.distance[v]);
      near(mesh.lengthOf(paths[k]), paths[k].length);
      near(mesh.shorten(paths[k]).length, paths[k].length);
      let sum = 0;
      const p = paths[k].positions;
      for (let i = 3; i < p.length; i += 3) sum += Math.hypot(p[i] - p[i - 3], p[i + 1] - p[i - 2], p[i + 2] - p[i - 1]);
      near(sum, paths[k].length);
    });
    near(field.at(targets).distance[0], field.distance[targets[0]], 0);
    field.free();
    mesh.free();
  });

  test(`${name}: a matrix has the rows that distance() gives`, () => {
    const mesh = make();
    const rows = [source, 0, mesh.vertexCount - 1];
    const matrix = mesh.distanceMatrix({ rows });
    rows.forEach((v, k) => {
      const row = matrix.subarray(k * mesh.vertexCount, (k + 1) * mesh.vertexCount);
      assert.equal(difference(row, mesh.distance(v).distance), 0);
    });
    const { rowStart, column, value } = mesh.distancesWithin(0.4, { rows, method: 'exact' });
    const { distance } = mesh.distance(source, { method: 'exact' });
    const inside = [...distance.keys()].filter((v) => distance[v] <= 0.4);
    assert.deepEqual([...column.subarray(0, rowStart[1])], inside);
    inside.forEach((v, k) => near(value[k], distance[v]));
    assert.equal(mesh.distanceMatrix({ rows, columns: rows, type: 'float32' }).constructor, Float32Array);
    mesh.free();
  });
}

test('isolines lie on their level, and exact arcs on circles of the plane', () => {
  const plane = bf.shape('plane', 30, 30, 2, 2);
  const middle = 15 * 31 + 15;
  const field = plane.field(middle);
  for (const line of plane.isolines(field.distance, { levels: [0.5] })) {
    assert.ok(line.closed && line.level === 0.5);
    near(line.length, Math.PI, 1e-2);
  }
  const [arc] = field.isolines({ levels: [0.5], chordError: 1e-4 });
  for (let i = 0; i < arc.positions.length; i += 3) near(Math.hypot(arc.positions[i] - 1, arc.positions[i + 1] - 1), 0.5, 1e-12);
  plane.free();
});

test('the logarithmic map of the plane is its polar coordinates, and trace() undoes it', () => {
  const plane = bf.shape('plane', 12, 12, 2, 2);
  const middle = 6 * 13 + 6;
  const { radius, angle, totalAngle } = plane.logMap(middle);
  near(totalAngle, 2 * Math.PI);
  const xyz = plane.vertices;
  for (let v = 0; v < plane.vertexCount; ++v) {
    near(radius[v], Math.hypot(xyz[3 * v] - 1, xyz[3 * v + 1] - 1));
    if (v === middle || Math.max(Math.abs(xyz[3 * v] - 1), Math.abs(xyz[3 * v + 1] - 1)) > 0.99) continue; // not at the rim
    const { end, path } = plane.trace(middle, angle[v], radius[v]);
    assert.equal(end, 'length');
    near(path.positions.at(-3), xyz[3 * v], 1e-7);
    near(path.positions.at(-2), xyz[3 * v + 1], 1e-7);
  }
  plane.free();
});

test('cells of two sources on a sphere are halves, and their border is the equator', () => {
  const sphere = bf.shape('latlong-sphere', 40, 60);
  const { area, borders, source } = sphere.voronoi([0, sphere.vertexCount - 1], { method: 'exact' });
  near(area[0], area[1], 1e-6);
  near(area[0] + area[1], sphere.report.area, 1e-9);
  assert.equal(borders.length, 1);
  assert.deepEqual(borders[0].sources, [0, 1]);
  assert.equal(source[0], 0);
  sphere.free();
});

test('farthest points: of a sphere from its pole the other pole', () => {
  const sphere = bf.shape('latlong-sphere', 40, 60);
  const { vertices, separation } = sphere.farthestPoints(2, { method: 'exact' });
  assert.deepEqual([...vertices], [0, sphere.vertexCount - 1]);
  near(separation[1], Math.PI, 1e-3);
  sphere.free();
});

test('a wall makes the way longer, and values come back to the original vertices', () => {
  const plane = bf.shape('plane', 10, 10);
  const at = (x, y) => y * 11 + x;
  const edges = Array.from({ length: 9 }, (_, y) => [at(5, y), at(5, y + 1)]);
  const cut = plane.cut({ edges });
  const { distance, source } = cut.mesh.distance(at(0, 0), { method: 'exact' });
  const back = cut.toOriginal(distance, source);
  assert.equal(back.distance.length, plane.vertexCount);
  near(back.distance[at(10, 0)], 2 * Math.hypot(0.5, 0.9), 1e-9);
  const there = cut.pointsFromOriginal([at(5, 4)]);
  assert.deepEqual([...there.which], [0, 0]);
  const again = cut.pointsToOriginal(there);
  near(plane.position(again)[0], 0.5);
  cut.free();
  plane.free();
});

test('certify: an exact field is possible, a wrong value is found', () => {
  const mesh = bf.shape('torus', 24, 12);
  const { distance } = mesh.distance(0, { method: 'exact' });
  assert.equal(mesh.certify(distance, 0).provenWrong, 0);
  distance[100] *= 1.01;
  const certificate = mesh.certify(distance, 0);
  assert.equal(certificate.tooLong, 1);
  assert.equal(certificate.worstVertex, 100);
  assert.equal(certificate.findingNames[certificate.finding[100]], 'too long');
  near(mesh.certify(distance, 0, { within: 0.02 }).provenWrong, 0);
  mesh.free();
});

test('compare: windows within its tolerance of exact', () => {
  const mesh = bf.shape('folded-sphere', 5);
  const exact = mesh.distance(0, { method: 'exact' });
  const windows = mesh.distance(0, { tolerance: 1e-2 });
  const { relative, compared, weightedRelative } = bf.compare(windows.distance, exact.distance, { vertexWeights: mesh.vertexAreas() });
  assert.equal(compared, mesh.vertexCount - 1);
  assert.ok(relative.max <= 1e-2 && relative.max > 0 && weightedRelative.mean <= relative.max);
  assert.ok(windows.maxErrorBound <= 1e-2 && exact.maxErrorBound < 1e-10);
  mesh.free();
});

test('a mesh from lengths has the distances of that with positions', () => {
  const mesh = bf.shape('cube', 4);
  const [xyz, faces] = [mesh.vertices, mesh.faces];
  const lengths = Float64Array.from(faces, (a, h) => {
    const b = faces[h % 3 === 2 ? h - 2 : h + 1];
    return Math.hypot(xyz[3 * a] - xyz[3 * b], xyz[3 * a + 1] - xyz[3 * b + 1], xyz[3 * a + 2] - xyz[3 * b + 2]);
  });
  const flat = bf.fromLengths(faces, lengths);
  assert.equal(flat.hasPositions, false);
  assert.ok(difference(flat.distance(0, { method: 'exact' }).distance, mesh.distance(0, { method: 'exact' }).distance) < 1e-12);
  flat.free();
  mesh.free();
});

test('arrays of every kind make the same mesh', () => {
  const v = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];
  const kinds = [[v, [[0, 1, 2]]], [v.flat(), [0, 1, 2]], [new Float32Array(v.flat()), new Uint16Array([0, 1, 2])],
    [v.map((p) => new Float64Array(p)), new Int32Array([0, 1, 2])], [v, new BigInt64Array([0n, 1n, 2n])]];
  for (const [vertices, faces] of kinds) {
    const mesh = bf.mesh(vertices, faces);
    assert.deepEqual([...mesh.distance(0, { method: 'exact' }).distance], [0, 1, 1]);
    assert.deepEqual([...mesh.distance(new Uint32Array([1, 2]), { offsets: [0.5, 0] }).source], [1, 0, 1]);
    mesh.free();
  }
});

test('colour maps are those of pictures', () => {
  assert.deepEqual([...bf.colormap('viridis').subarray(0, 4)], [68, 1, 84, 255]);
  assert.deepEqual([...bf.colormap('viridis').subarray(-4)], [253, 231, 37, 255]);
  assert.equal(bf.colormap('magma').length, 1024);
  assert.throws(() => bf.colormap('jet'), { code: 'invalid_argument' });
});

test('welding and subdividing', () => {
  const soup = bf.read(bf.shape('cube', 3).write('stl'), 'cube.stl');
  const loose = bf.mesh([...soup.vertices, ...soup.vertices], [...soup.faces, ...soup.faces.map((v) => v + soup.vertexCount)]);
  const { mesh, joined, vertexMap } = loose.weld(0);
  assert.equal(joined, soup.vertexCount);
  assert.equal(vertexMap.length, 2 * soup.vertexCount);
  assert.equal(mesh.vertexCount, soup.vertexCount);
  assert.equal(soup.subdivide({ rule: 'midpoint' }).faceCount, 4 * soup.faceCount);
});

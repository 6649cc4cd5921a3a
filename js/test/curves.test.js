// Curves as sources: distances of the plane in closed form, mixed with places, and what is refused.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { bf } from './support.js';

const SIDE = 20;

// The unit square in cells with one diagonal each.
function square() {
  const vertices = [];
  const faces = [];
  for (let j = 0; j <= SIDE; ++j) for (let i = 0; i <= SIDE; ++i) vertices.push(i / SIDE, j / SIDE, 0);
  for (let j = 0; j < SIDE; ++j) {
    for (let i = 0; i < SIDE; ++i) {
      const v = j * (SIDE + 1) + i;
      faces.push(v, v + 1, v + SIDE + 2, v, v + SIDE + 2, v + SIDE + 1);
    }
  }
  return bf.mesh(Float64Array.from(vertices), Uint32Array.from(faces));
}

function toSegment([x, y], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const t = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)));
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

const toPolygon = (p, corners, closed) => Math.min(...corners.slice(closed ? 0 : 1).map((c, k) => toSegment(p, corners.at(closed ? k - 1 : k), c)));

const CORNERS = [[0.21, 0.33], [0.77, 0.18], [0.64, 0.81]];

for (const closed of [false, true]) {
  test(`a drawn ${closed ? 'triangle' : 'line'} is as far as in the plane, alone and beside a place`, () => {
    const mesh = square();
    const curve = mesh.path(CORNERS.map(([x, y]) => ({ at: [x, y, 0] })), { closed });
    const p = mesh.vertices;
    for (const beside of [[], [{ vertex: 0, offset: 0.05 }]]) {
      const { distance, source } = mesh.distance([...beside, { curve, closed, offset: 0.1 }], { method: 'exact' });
      for (let v = 0; v < mesh.vertexCount; ++v) {
        const [x, y] = [p[3 * v], p[3 * v + 1]];
        const from = [0.1 + toPolygon([x, y], CORNERS, closed), ...beside.map(() => 0.05 + Math.hypot(x, y))];
        assert.ok(Math.abs(distance[v] - Math.min(...from)) < 1e-12, `vertex ${v}: ${distance[v]}, not ${Math.min(...from)}`);
        if (beside.length > 0 && Math.abs(from[0] - from[1]) > 1e-9) assert.equal(source[v], from[1] < from[0] ? 0 : 1);
      }
    }
    mesh.free();
  });
}

test('paths lead to the nearest place of a curve', () => {
  const mesh = square();
  const curve = mesh.path(CORNERS.map(([x, y]) => ({ at: [x, y, 0] })));
  const field = mesh.field([{ curve }], { method: 'exact' });
  const { length, positions } = field.path(0);
  assert.ok(Math.abs(length - toPolygon([0, 0], CORNERS, false)) < 1e-12);
  const end = Math.min(...[0, positions.length - 3].map((k) => toPolygon([positions[k], positions[k + 1]], CORNERS, false)));
  assert.ok(end < 1e-12, `the path ends ${end} from the curve`);
  field.free();
  mesh.free();
});

test('what is no curve is refused in words', () => {
  const mesh = square();
  const refused = (sources, words) => assert.throws(() => mesh.distance(sources), ({ code, message }) => code === 'invalid_argument' && words.test(message));
  refused([{ curve: [0, 440] }], /share/);
  refused([{ curve: [] }], /has no places/);
  refused([{ curve: [{ vertex: 0, offset: 1 }, 1] }], /one offset/);
  assert.equal(mesh.distance([{ curve: [0, 1, 2] }]).distance[1], 0);
  mesh.free();
});

test('distances have the sign of the side, and a place has none', () => {
  const mesh = square();
  const curve = mesh.path(CORNERS.map(([x, y]) => ({ at: [x, y, 0] })), { closed: true });
  const signed = mesh.signedDistance({ curve, closed: true });
  const p = mesh.vertices;
  const isInside = ([x, y]) => CORNERS.every(([ax, ay], k) => {
    const [bx, by] = CORNERS[(k + 1) % CORNERS.length];
    return (bx - ax) * (y - ay) > (by - ay) * (x - ax);
  });
  let inside = 0;
  for (let v = 0; v < mesh.vertexCount; ++v) {
    const at = [p[3 * v], p[3 * v + 1]];
    inside += isInside(at);
    // Counter-clockwise: its inside is on the left.
    assert.ok(Math.abs(signed[v] - (isInside(at) ? -1 : 1) * toPolygon(at, CORNERS, true)) < 1e-12, `vertex ${v}: ${signed[v]}`);
  }
  assert.ok(inside > 20);
  assert.throws(() => mesh.signedDistance(0), { code: 'invalid_argument' });
  assert.throws(() => mesh.signedDistance({ curve, closed: true }, { method: 'exact' }), /unknown option 'method'/);
  mesh.free();
});

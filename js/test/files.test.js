// Meshes, fields and curves as bytes, in every format that needs no library of its own.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';
import { deflateSync, gzipSync } from 'node:zlib';

import { bf, difference, inFolder, native, withoutNative } from './support.js';

const mesh = bf.shape('torus', 12, 8);
const text = (s) => new TextEncoder().encode(s);

const EXACT = ['ply', 'obj', 'off', 'vtk', 'vtp', 'msh', 'mesh', 'meshb', 'asc'];
const FLOATS = ['gii', 'glb', 'white'];

for (const format of [...EXACT, ...FLOATS]) {
  test(`${format}: what was written is read back`, () => {
    const again = bf.read(mesh.write(format), `mesh.${format}`);
    assert.deepEqual(again.faces, mesh.faces);
    const most = EXACT.includes(format) ? 0 : 1e-7;
    assert.ok(again.vertices.every((x, k) => Math.abs(x - mesh.vertices[k]) <= most));
    again.free();
  });
}

test('stl: corners at the same place become one vertex', () => {
  const again = bf.read(mesh.write('stl'), 'mesh.stl');
  assert.equal(again.vertexCount, mesh.vertexCount);
  assert.equal(again.file.format, 'STL');
  assert.equal(again.file.vertexMap.length, 3 * mesh.faceCount);
  again.free();
});

test('gzip is inflated, and GIFTI as nibabel writes it', () => {
  const again = bf.read(gzipSync(mesh.write('ply')), 'mesh.ply.gz');
  assert.deepEqual(again.vertices, mesh.vertices);
  again.free();
  const array = (numbers, intent, type, columns) => `<DataArray Intent="${intent}" DataType="${type}" ArrayIndexingOrder="RowMajorOrder"
    Dimensionality="2" Dim0="${numbers.length / columns}" Dim1="${columns}" Encoding="GZipBase64Binary" Endian="LittleEndian"
    ExternalFileName="" ExternalFileOffset=""><Data>${deflateSync(new Uint8Array(numbers.buffer)).toString('base64')}</Data></DataArray>`;
  const gifti = `<?xml version="1.0" encoding="UTF-8"?><GIFTI Version="1.0" NumberOfDataArrays="2">
    ${array(Float32Array.from(mesh.vertices), 'NIFTI_INTENT_POINTSET', 'NIFTI_TYPE_FLOAT32', 3)}
    ${array(Int32Array.from(mesh.faces), 'NIFTI_INTENT_TRIANGLE', 'NIFTI_TYPE_INT32', 3)}</GIFTI>`;
  const surface = bf.read(text(gifti), 'lh.surf.gii');
  assert.equal(surface.file.format, 'GIFTI');
  assert.deepEqual(surface.faces, mesh.faces);
  surface.free();
});

test('polygons are split and remember where they come from', () => {
  const square = bf.read(text('v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n'), 'square.obj');
  assert.equal(square.faceCount, 2);
  assert.deepEqual([...square.file.faceOrigin], [0, 0]);
  square.free();
});

test('the content decides about the format, and a wrong name is remarked on', () => {
  const again = bf.read(mesh.write('ply'), 'mesh.obj');
  assert.equal(again.file.format, 'PLY');
  assert.match(again.file.remarks[0], /the name says OBJ, but the content is PLY/);
  again.free();
});

test('fields are read and written', () => {
  const { distance, source } = mesh.distance([0, 50]);
  for (const format of ['npy', 'csv', 'json', 'ply', 'vtk', 'vtp']) {
    const read = bf.readField(mesh.write(format, { values: distance, labels: source }), `field.${format}`);
    assert.equal(difference(read.values, distance), 0, format);
  }
  const holes = Float64Array.from(distance, (d) => (d > 1 ? Infinity : d));
  assert.deepEqual(bf.readField(mesh.write('npy', { values: holes }), 'a.npy').values, holes);
});

test('curves are written as the program writes them', { skip: withoutNative }, () => {
  const file = inFolder('files-torus.ply');
  writeFileSync(file, mesh.write('ply'));
  const lines = mesh.isolines(mesh.distance(0).distance, { every: 0.5 });
  for (const format of ['obj', 'svg', 'dxf', 'json', 'csv', 'vtp', 'ply']) {
    native('isolines', file, '--source', '0', '--every', '0.5', '-o', inFolder(`lines.${format}`));
    assert.equal(new TextDecoder().decode(mesh.writeCurves(format, lines)), readFileSync(inFolder(`lines.${format}`), 'utf8'), format);
  }
});

test('files are what the program writes, byte for byte', { skip: withoutNative }, () => {
  const file = inFolder('files-torus.ply');
  writeFileSync(file, mesh.write('ply'));
  const { distance, source } = mesh.distance(0);
  for (const format of ['ply', 'vtk', 'npy', 'gii', 'obj']) {
    native('distance', file, '--source', '0', '-o', inFolder(`field.${format}`));
    const ours = mesh.write(format, { values: distance, ...(format !== 'gii' && { labels: source }) }); // it has one array
    assert.deepEqual(Buffer.from(ours), readFileSync(inFolder(`field.${format}`)), format);
  }
});

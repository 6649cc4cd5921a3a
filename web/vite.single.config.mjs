// The page as one file that asks for nothing: what `brushfire view` puts a mesh into, and what works from file://.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { defineConfig } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

const parts = fileURLToPath(new URL('./src/parts.single.js', import.meta.url));

const files = { 'virtual:wasm': 'brushfire.wasm', 'virtual:rest': 'brushfire.rest.wasm' };
const inPackage = (name) => fileURLToPath(new URL(`../js/lib/${name}`, import.meta.url));

// The package names its modules by URL, which would have to be fetched: here the page holds them, once, and hands them over.
const held = {
  name: 'brushfire-held',
  enforce: 'pre',
  resolveId(id) {
    if (id in files) return `\0${id}`;
    if (id === './parts.js') return parts;
    return null;
  },
  load(id) {
    const file = id.startsWith('\0') && files[id.slice(1)];
    if (!file) return null;
    return `export default ${JSON.stringify(gzipSync(readFileSync(inPackage(file)), { level: 9 }).toString('base64'))};`;
  },
  transform(code, id) {
    if (!/\/lib\/index\.js$/.test(id)) return null;
    let out = code;
    for (const file of Object.values(files)) {
      const before = out;
      out = before.replace(`new URL('./${file}', import.meta.url)`, 'null');
      if (out === before) throw new Error(`${id} names ${file} in another way now`);
    }
    return { code: out, map: null };
  },
};

export default defineConfig({
  base: './',
  plugins: [held, viteSingleFile()],
  worker: { format: 'iife', plugins: () => [held] },
  build: { target: 'es2022', outDir: 'dist-single', chunkSizeWarningLimit: 4000 },
});

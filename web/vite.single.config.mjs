// The page as one file that asks for nothing: what `brushfire view` puts a mesh into, and what works from file://.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { defineConfig } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

const wasm = fileURLToPath(new URL('../js/lib/brushfire.wasm', import.meta.url));
const parts = fileURLToPath(new URL('./src/parts.single.js', import.meta.url));

// The package names its module by URL, which would have to be fetched: here the page holds it, once, and hands it over.
const held = {
  name: 'brushfire-held',
  enforce: 'pre',
  resolveId(id) {
    if (id === 'virtual:wasm') return '\0virtual:wasm';
    if (id === './parts.js') return parts;
    return null;
  },
  load(id) {
    if (id !== '\0virtual:wasm') return null;
    return `export default ${JSON.stringify(gzipSync(readFileSync(wasm), { level: 9 }).toString('base64'))};`;
  },
  transform(code, id) {
    if (!/\/lib\/index\.js$/.test(id)) return null;
    const out = code.replace("new URL('./brushfire.wasm', import.meta.url)", 'null');
    if (out === code) throw new Error(`${id} names its module in another way now`);
    return { code: out, map: null };
  },
};

export default defineConfig({
  base: './',
  plugins: [held, viteSingleFile()],
  worker: { format: 'iife', plugins: () => [held] },
  build: { target: 'es2022', outDir: 'dist-single', chunkSizeWarningLimit: 4000 },
});

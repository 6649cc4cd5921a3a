import { defineConfig } from 'vite';

export default defineConfig({
  base: './', // the page may lie anywhere
  worker: { format: 'es' },
  build: { target: 'es2022', chunkSizeWarningLimit: 800 },
  optimizeDeps: { exclude: ['brushfire'] }, // its URLs are relative to itself
});

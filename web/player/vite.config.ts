// SPDX-License-Identifier: Apache-2.0
import { defineConfig } from 'vite';

// Relative addresses, so that the page works in any folder of any server. SCONCE_WEB_OUT: where CMake wants it.
export default defineConfig({
  base: './',
  build: {
    outDir: process.env.SCONCE_WEB_OUT ?? '../../build/web',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 1000,
  },
});

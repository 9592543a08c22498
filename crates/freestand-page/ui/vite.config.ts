import { svelte } from '@sveltejs/vite-plugin-svelte';
import { gzipSync } from 'node:zlib';
import { defineConfig, type Plugin } from 'vite';

/** Writes every file a second time, packed: the server hands out what is embedded. */
function packed(): Plugin {
  let folder = 'dist';
  return {
    name: 'packed',
    apply: 'build',
    enforce: 'post',
    configResolved({ build }) { folder = build.outDir; },
    async closeBundle() {
      const { readFile, writeFile } = await import('node:fs/promises');
      for (const name of ['index.html', 'assets/app.js', 'assets/film.js', 'assets/app.css', 'assets/icon.svg']) {
        const bytes = await readFile(`${folder}/${name}`);
        await writeFile(`${folder}/${name}.gz`, gzipSync(bytes, { level: 9 }));
      }
    },
  };
}

export default defineConfig({
  plugins: [svelte(), packed()],
  // Names without hashes: the table of the server lists them, and an ETag tells versions apart.
  build: {
    target: 'es2022',
    cssCodeSplit: false,
    modulePreload: false,
    assetsInlineLimit: 0,
    rollupOptions: {
      output: {
        entryFileNames: 'assets/app.js',
        assetFileNames: (file) => (file.names[0]?.endsWith('.css') ? 'assets/app.css' : 'assets/[name][extname]'),
        // The film in three dimensions, with three.js, is all that is not loaded at once.
        // Licences ask that their notice stays with the code.
        comments: { legal: true },
        chunkFileNames: 'assets/[name].js',
      },
    },
  },
  test: { include: ['src/**/*.test.ts'], environment: 'node' },
} as never);

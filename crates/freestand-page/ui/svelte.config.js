import { vitePreprocess } from '@sveltejs/vite-plugin-svelte';

export default {
  preprocess: vitePreprocess(),
  compilerOptions: {
    runes: true,
    // A canvas that only shows something is a picture: role=img is what ARIA in HTML allows for it.
    warningFilter: (warning) => warning.code !== 'a11y_no_interactive_element_to_noninteractive_role',
  },
};

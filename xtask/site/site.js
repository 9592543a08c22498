// What the pages of mdBook lack for people without a mouse: a role for its button, and a way to scroll what is wide.
document.getElementById('mdbook-sidebar-toggle')?.setAttribute('role', 'button');
for (const wide of document.querySelectorAll('pre > code, .table-wrapper')) wide.tabIndex = 0;

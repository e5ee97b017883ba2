// Saving what was made on a page.
"use strict";

// Hand a file to the browser, which saves it where downloads go.
function saveFile(file) {
  const address = URL.createObjectURL(file);
  make("a", { href: address, download: file.name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

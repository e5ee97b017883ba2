// Buttons that copy: bytes, code, and what else carries `data-copy`.
"use strict";

async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // Where the clipboard is not to be had, an old way in through a field that holds the text.
    const focused = document.activeElement;
    const field = document.body.appendChild(document.createElement("textarea"));
    field.value = text;
    field.select();
    const copied = document.execCommand("copy");
    field.remove();
    focused?.focus({ preventScroll: true });
    return copied;
  }
}

document.addEventListener("click", async (event) => {
  const button = event.target.closest("button.copy");
  if (!button) return;
  const copied = await copyText(button.dataset.copy);
  const text = copied ? "Copied" : "Not copied";
  announce(text);
  if (button.dataset.label === undefined) button.dataset.label = button.textContent;
  button.dataset.name ??= button.ariaLabel || "";
  button.ariaLabel = null;
  button.textContent = text;
  clearTimeout(Number(button.dataset.timer));
  button.dataset.timer = setTimeout(() => {
    button.textContent = button.dataset.label;
    button.ariaLabel = button.dataset.name || null;
  }, 1500);
});

// The search box of every page: hands over what is typed to the page of the search. The key `/`
// leads to it, Escape away from it.
"use strict";

{
  const box = document.getElementById("search-box"), words = document.getElementById("search-words");
  const isTyping = (element) => element.isContentEditable || element.matches("input, textarea, select");

  box?.addEventListener("submit", (event) => {
    event.preventDefault();
    const query = new URLSearchParams({ q: words.value.trim() });
    location.href = words.value.trim() ? `${box.dataset.address}?${query}` : box.dataset.address;
  });

  document.addEventListener("keydown", (event) => {
    if (event.key !== "/" || event.ctrlKey || event.metaKey || event.altKey || isTyping(event.target)) return;
    event.preventDefault();
    words.focus();
    words.select();
  });

  words.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    // A browser would clear the field.
    event.preventDefault();
    words.blur();
  });
}

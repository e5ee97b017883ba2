// What every page does once it is there.
"use strict";

// What needs a script is hidden until there is one, and what stands in for it afterwards.
for (const element of document.querySelectorAll("[data-script]")) element.hidden = false;
for (const element of document.querySelectorAll("[data-no-script]")) element.hidden = true;

// Say something to those who listen; the same words twice are two messages.
function announce(text) {
  const status = document.getElementById("announcement");
  status.textContent = "";
  setTimeout(() => { status.textContent = text; }, 50);
}

// The sidebar shows where one is, and does not move the page for that.
{
  const sidebar = document.getElementById("sidebar");
  const here = sidebar?.querySelector("[aria-current]");
  const show = () => {
    const middle = (sidebar.clientHeight - here.offsetHeight) / 2;
    const place = here.getBoundingClientRect().top - sidebar.getBoundingClientRect().top;
    sidebar.scrollTop += place - middle;
  };
  if (here) {
    show();
    sidebar.addEventListener("toggle", show);
  }
  // Where the display has room for the sidebar beside the page, it is no menu over it.
  matchMedia("(min-width: 64.01rem)").addEventListener("change", () => {
    if (sidebar?.matches(":popover-open")) sidebar.hidePopover();
  });
}

// The contents mark the part that is being read.
{
  // A heading that a link has led to stands below the header of the page, and not as low as this.
  const READ_FROM = 100;
  const links = [...document.querySelectorAll(".contents a")];
  const parts = links.map((link) => document.getElementById(decodeURIComponent(link.hash.slice(1))));
  const mark = () => {
    const above = parts.filter((part) => part?.getBoundingClientRect().top < READ_FROM);
    const current = parts.lastIndexOf(above[above.length - 1]);
    links.forEach((link, at) => {
      if (at === current) link.setAttribute("aria-current", "location");
      else link.removeAttribute("aria-current");
    });
  };
  if (links.length) {
    let waiting = false;
    addEventListener("scroll", () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => { waiting = false; mark(); });
    }, { passive: true });
    mark();
  }
}

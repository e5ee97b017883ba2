// Tabs: sections of `.tabs`, one of which is shown; groups of one name choose together.
"use strict";

{
  const groups = [...document.querySelectorAll(".tabs")];

  // Where a page may keep nothing, the choice lasts as long as the page.
  const recall = (name) => {
    try { return localStorage.getItem(`tabs-${name}`); } catch { return null; }
  };
  const remember = (name, label) => {
    try { localStorage.setItem(`tabs-${name}`, label); } catch { /* It was worth a try. */ }
  };

  const choose = (group, label) => {
    const sections = [...group.querySelectorAll(":scope > [data-tab]")];
    if (!sections.some((section) => section.dataset.tab === label)) return;
    for (const section of sections) section.hidden = section.dataset.tab !== label;
    for (const tab of group.querySelectorAll(":scope > [role=tablist] > [role=tab]")) {
      const chosen = tab.textContent === label;
      tab.setAttribute("aria-selected", String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
    }
  };

  const chooseEverywhere = (name, label) => {
    remember(name, label);
    for (const group of groups) if (group.dataset.tabs === name) choose(group, label);
  };

  groups.forEach((group, number) => {
    const list = document.createElement("div");
    list.setAttribute("role", "tablist");
    if (group.dataset.label) list.setAttribute("aria-label", group.dataset.label);
    const sections = [...group.querySelectorAll(":scope > [data-tab]")];
    sections.forEach((section, place) => {
      const tab = list.appendChild(document.createElement("button"));
      tab.type = "button";
      tab.textContent = section.dataset.tab;
      tab.id = `tab-${number}-${place}`;
      tab.setAttribute("role", "tab");
      section.id = section.id || `panel-${number}-${place}`;
      tab.setAttribute("aria-controls", section.id);
      section.setAttribute("role", "tabpanel");
      section.setAttribute("aria-labelledby", tab.id);
      const heading = section.querySelector(":scope > .heading, :scope > h3, :scope > h4");
      if (heading) heading.hidden = true;
    });
    list.addEventListener("click", (event) => {
      const tab = event.target.closest("[role=tab]");
      if (tab) chooseEverywhere(group.dataset.tabs, tab.textContent);
    });
    list.addEventListener("keydown", (event) => {
      const tabs = [...list.children];
      const at = tabs.indexOf(document.activeElement);
      const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key];
      if (to === undefined || at < 0) return;
      event.preventDefault();
      const tab = tabs[(to + tabs.length) % tabs.length];
      chooseEverywhere(group.dataset.tabs, tab.textContent);
      tab.focus();
    });
    group.prepend(list);
    choose(group, sections[0]?.dataset.tab);
    choose(group, recall(group.dataset.tabs));
  });

  // What an address names may stand in a section that is not shown.
  const reveal = () => {
    let id = location.hash.slice(1);
    try { id = decodeURIComponent(id); } catch { /* It is an id as it stands, or none. */ }
    const named = id && document.getElementById(id);
    const within = (section) => section.hidden && section.contains(named);
    let isMoved = false;
    for (const group of groups) {
      const section = named && [...group.querySelectorAll(":scope > [data-tab]")].find(within);
      if (section) choose(group, section.dataset.tab);
      isMoved = isMoved || Boolean(section);
    }
    if (isMoved) named.scrollIntoView();
  };
  window.addEventListener("hashchange", reveal);
  reveal();
}

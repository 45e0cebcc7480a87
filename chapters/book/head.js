// The theme, before anything is painted: as it was chosen, else as the system has it. In a
// browser that gives each file a storage of its own, the cookie is the one that all share.
(() => {
  const root = document.documentElement, cookie = /(?:^|; )theme=(light|dark)/.exec(document.cookie);
  let theme = cookie && cookie[1];
  try { theme ??= localStorage.getItem("theme"); } catch { /* no storage: the system's */ }
  if (theme === "light" || theme === "dark") root.dataset.theme = theme;
  root.classList.add("js");
})();

// chapters/play/theme.js -- The theme, before anything is painted: as it was chosen here or in the book, else the system's.
const night = matchMedia("(prefers-color-scheme: dark)"), chosen = () => {
  let theme = /(?:^|; )theme=(light|dark)/.exec(document.cookie)?.[1];
  try { theme ??= localStorage.getItem("theme"); } catch { /* no storage */ }
  return theme === "light" || theme === "dark" ? theme : night.matches ? "dark" : "light";
};
const wear = theme => { document.documentElement.className = theme; };
wear(chosen());

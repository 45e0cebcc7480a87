// What a page does beyond being read: menu, theme, copy buttons, equations that show
// themselves when the pointer is on their number, the search field, figures that move.
const root = document.documentElement.dataset.root;
const element = id => document.getElementById(id);

// A script of the site, once. Classic scripts alone may be loaded by a page opened from a disk.
const asked = new Map();
function load(name) {
  if (!asked.has(name)) asked.set(name, new Promise((done, failed) => {
    const script = document.createElement("script");
    script.src = root + name;
    script.onload = done;
    script.onerror = () => failed(new Error(`${name} is not there`));
    document.head.append(script);
  }));
  return asked.get(name);
}

// ---- menu and theme ----

function menu() {
  const button = element("menu"), place = element("contents");
  const open = is => {
    button.setAttribute("aria-expanded", is);
    place.classList.toggle("open", is);
  };
  button.hidden = false;
  button.addEventListener("click", () => open(button.getAttribute("aria-expanded") !== "true"));
  place.addEventListener("click", event => event.target.closest("a") && open(false));
  addEventListener("keydown", event => {
    if (event.key !== "Escape" || button.getAttribute("aria-expanded") !== "true") return;
    open(false);
    button.focus();
  });
  const here = place.querySelector("[aria-current]"); // in sight, without moving the page
  if (here) place.scrollTop = here.offsetTop - place.clientHeight / 3;
}

// In the contents the section that is being read.
function section() {
  const links = new Map([...element("contents").querySelectorAll('a[href^="#"]')].map(link => [link.getAttribute("href").slice(1), link]));
  const headings = [...document.querySelectorAll("main h2[id]")].filter(heading => links.has(heading.id));
  let now, waiting = false;
  const look = () => {
    waiting = false;
    const last = headings.findLast(heading => heading.getBoundingClientRect().top < 0.3 * innerHeight);
    if (last === now) return;
    if (now) links.get(now.id).removeAttribute("aria-current");
    if (last) links.get(last.id).setAttribute("aria-current", "location");
    now = last;
  };
  addEventListener("scroll", () => {
    if (!waiting) requestAnimationFrame(look);
    waiting = true;
  }, { passive: true });
  look();
}

function theme() {
  const button = element("theme"), system = matchMedia("(prefers-color-scheme: dark)");
  const now = () => document.documentElement.dataset.theme ?? (system.matches ? "dark" : "light");
  const say = () => { button.textContent = now() === "dark" ? "Light" : "Dark"; };
  button.hidden = false;
  button.setAttribute("aria-description", "switches the theme");
  button.addEventListener("click", () => {
    const next = now() === "dark" ? "light" : "dark";
    document.documentElement.dataset.theme = next;
    try { localStorage.setItem("theme", next); } catch { /* the cookie, then */ }
    document.cookie = `theme=${next};max-age=31536000;path=/;samesite=lax`;
    say();
    dispatchEvent(new Event("themechange")); // canvases draw again
  });
  system.addEventListener("change", () => { say(); dispatchEvent(new Event("themechange")); });
  say();
}

// ---- code, and what is wider than the page ----

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch { // an old browser, or one that asks for https
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}

function copyButtons() {
  for (const block of document.querySelectorAll("main pre")) {
    const box = document.createElement("div"), button = document.createElement("button");
    box.className = "copied";
    button.type = "button";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
      await copy(block.textContent);
      button.textContent = "Copied";
      setTimeout(() => { button.textContent = "Copy"; }, 1500);
    });
    block.replaceWith(box);
    box.append(block, button);
  }
}

// The keyboard scrolls what has the focus: what is too wide gets it, and nothing else. A formula
// that takes two lines begins both at the left.
function wideOnes() {
  const boxes = document.querySelectorAll(".scroll, .formula, pre");
  const left = part => part.getBoundingClientRect().left;
  const look = () => boxes.forEach(box => {
    box.style.fontSize = "";
    const over = box.scrollWidth - box.clientWidth; // a pixel or two are no reason for a scroll bar
    if (over > 0 && over < 3 && box.matches(".formula")) box.style.fontSize = "99%";
    if (box.scrollWidth > box.clientWidth + 1) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
    const parts = [...box.querySelectorAll(".katex-display > .katex > .katex-html > .base")];
    box.classList.toggle("broken", parts.some((part, i) => i > 0 && left(part) < left(parts[i - 1])));
  });
  look();
  addEventListener("resize", look);
}

// ---- an equation at its number ----

// The formula of a link to an equation, on this page or on another one.
async function equationOf(link) {
  const [, file, number] = /([^/]*?)(?:\.html)?#eq-([\d.]+)$/.exec(link.getAttribute("href"));
  const here = document.getElementById(`eq-${number}`);
  if (here) return here.innerHTML;
  await load(`assets/equations-${file}.js`);
  return FVI_EQUATIONS[number];
}

function previews() {
  const box = document.createElement("div");
  let timer, shown;
  box.id = "preview";
  box.hidden = true;
  document.body.append(box);
  const hide = () => { clearTimeout(timer); box.hidden = true; shown = null; };
  const show = async link => {
    shown = link;
    const formula = await equationOf(link).catch(() => "");
    if (shown !== link || !formula) return; // the pointer is elsewhere by now
    box.innerHTML = formula;
    box.hidden = false;
    const at = link.getBoundingClientRect(), { offsetWidth: wide, offsetHeight: high } = box;
    box.style.left = `${Math.max(8, Math.min(at.left + at.width / 2 - wide / 2, document.documentElement.clientWidth - wide - 8))}px`;
    box.style.top = `${scrollY + (at.top > high + 60 ? at.top - high - 4 : at.bottom + 4)}px`;
  };
  for (const link of document.querySelectorAll("main a.eq")) {
    for (const come of ["pointerenter", "focus"])
      link.addEventListener(come, () => { clearTimeout(timer); timer = setTimeout(show, come === "focus" ? 0 : 150, link); });
    for (const go of ["pointerleave", "blur"])
      link.addEventListener(go, () => { clearTimeout(timer); timer = setTimeout(hide, 150); });
  }
  box.addEventListener("pointerenter", () => clearTimeout(timer));
  box.addEventListener("pointerleave", hide);
  addEventListener("keydown", event => event.key === "Escape" && hide());
}

// ---- search ----

function search() {
  const field = element("query"), form = element("find"), list = element("found");
  form.hidden = false;
  const ready = async () => {
    await load("assets/search.js");
    await load("assets/texts.js");
  };
  const close = () => { list.hidden = true; };
  const links = () => [...list.querySelectorAll("a")];
  field.addEventListener("focus", ready, { once: true });
  field.addEventListener("input", async () => {
    const words = field.value;
    await ready();
    if (field.value !== words) return;
    list.hidden = words.trim() === "";
    list.innerHTML = list.hidden ? "" : FVI_SEARCH.list(words, root);
  });
  form.addEventListener("submit", event => {
    event.preventDefault();
    links()[0]?.click();
  });
  addEventListener("keydown", event => {
    const typing = /^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName);
    if (event.key === "/" && !typing && !event.ctrlKey && !event.metaKey) {
      event.preventDefault();
      field.focus();
      field.select();
    }
    if (list.hidden) return;
    const at = links().indexOf(document.activeElement), step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step && (at >= 0 || document.activeElement === field)) {
      event.preventDefault();
      (at + step < 0 ? field : links()[at + step])?.focus();
    }
    if (event.key === "Escape") {
      close();
      field.focus();
    }
  });
  addEventListener("pointerdown", event => event.target.closest("#find, #found") || close());
  list.addEventListener("click", event => event.target.closest("a") && close());
}

// ---- figures that move ----

function figures() {
  for (const figure of document.querySelectorAll("[data-live]")) {
    FVI_LIVE.frame(figure); // at once, so that nothing moves below it later
    new IntersectionObserver(async (seen, observer) => {
      if (!seen.some(one => one.isIntersecting)) return;
      observer.disconnect();
      try {
        await load(`live/${FVI_LIVE.kernelOf(FVI_LIVE.scenes.get(figure.dataset.live)).name}.js`);
        await FVI_LIVE.begin(figure);
      } catch (error) { // the still picture, then
        figure.classList.remove("is-live");
        console.error(error);
      }
    }, { rootMargin: "300px" }).observe(figure);
  }
}

menu();
section();
theme();
copyButtons();
wideOnes();
previews();
search();
figures();

// Search over all sections of the book, in the browser: words, beginnings of words, and
// words with one slip of the pen (a letter too many, too few, another, or two exchanged).
//
// FVI_TEXTS, from texts.js, is [{ u: address, p: page, t: heading, x: text }]; FVI_PLACES
// the addresses of the equations by their numbers. test_book.mjs runs these lines in node.
const FVI_SEARCH = (() => {
  const plain = text => text.normalize("NFD").replace(/[\u0300-\u036f]/g, "").toLowerCase();
  const wordsOf = text => plain(text).match(/[\p{L}\p{N}]+/gu) ?? [];
  let index; // word -> Map(section -> weight), made at the first question

  function build() {
    index = new Map();
    const add = (text, section, weight) => {
      for (const word of wordsOf(text)) {
        if (!index.has(word)) index.set(word, new Map());
        const at = index.get(word);
        at.set(section, (at.get(section) ?? 0) + weight);
      }
    };
    FVI_TEXTS.forEach((text, section) => {
      add(text.t, section, 8);
      add(text.p, section, 3);
      add(text.x, section, 1);
    });
  }

  // At most one insertion, deletion, change or exchange of neighbours?
  function near(a, b) {
    if (Math.abs(a.length - b.length) > 1) return false;
    let i = 0;
    while (i < a.length && a[i] === b[i]) i++;
    const rest = (s, skip) => s.slice(i + skip);
    return rest(a, 1) === rest(b, 1) || rest(a, 1) === rest(b, 0) || rest(a, 0) === rest(b, 1)
      || (a[i] === b[i + 1] && a[i + 1] === b[i] && rest(a, 2) === rest(b, 2));
  }

  // Section -> how well it has a word that is, begins with, or is nearly the one asked for.
  function hits(word) {
    const found = new Map();
    for (const [known, at] of index) {
      const likeness = known === word ? 1 : known.startsWith(word) ? 0.6
        : word.length > 4 && near(word, known) ? 0.3 : 0;
      if (!likeness) continue;
      const rare = Math.log(1 + FVI_TEXTS.length / at.size);
      for (const [section, weight] of at)
        found.set(section, (found.get(section) ?? 0) + likeness * rare * weight / (weight + 2));
    }
    return found;
  }

  // The sections that have every word, best first.
  function search(question) {
    if (!index) build();
    let all;
    for (const word of new Set(wordsOf(question))) {
      const now = hits(word);
      all = all ? new Map([...all].filter(([s]) => now.has(s)).map(([s, v]) => [s, v + now.get(s)])) : now;
    }
    return [...all ?? []].sort((a, b) => b[1] - a[1]).map(([section]) => FVI_TEXTS[section]);
  }

  const safe = text => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");

  // Some words of the text about the first that was asked for.
  function excerpt(text, question) {
    const words = wordsOf(question), lower = plain(text);
    const at = Math.max(0, Math.min(...words.map(word => lower.indexOf(word)).filter(i => i >= 0), Infinity) - 60);
    return Number.isFinite(at) ? `${at ? "… " : ""}${text.slice(at, at + 150)}${text.length > at + 150 ? " …" : ""}`
      : text.slice(0, 150);
  }

  // The answer as HTML.
  function list(question, root) {
    const number = /^\(?(\d+\.\d+|\d+[a-e])\)?$/.exec(question.trim()), places = [];
    if (number && FVI_PLACES[number[1]])
      places.push({ u: FVI_PLACES[number[1]], p: "", t: `Equation (${number[1]})`, x: "" });
    else places.push(...search(question));
    const rows = places.slice(0, 20).map(({ u, p, t, x }) =>
      `<li><a href="${root}${u}"><b>${safe(t)}</b> <span>${safe(p)}</span><br>${safe(excerpt(x, question))}</a></li>`);
    const many = places.length;
    return `<p role="status">${many === 0 ? "Nothing found." : `${many} ${many === 1 ? "place" : "places"}${many > 20 ? ", the best 20" : ""}`}</p>`
      + `<ol>${rows.join("")}</ol>`;
  }

  return { search, list, near };
})();

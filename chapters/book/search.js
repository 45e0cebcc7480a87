// Search over all sections of the book, in the browser: words, beginnings of words, and
// words with one slip of the pen (a letter too many, too few, another, or two exchanged).
//
// FVI_TEXTS, from texts.js, is [{ u: address, p: page, t: heading, x: text }]; FVI_PLACES
// the addresses of the equations by their numbers. test_book.mjs runs these lines in node.
const FVI_SEARCH = (() => {
  const plain = text => text.normalize("NFD").replace(/[\u0300-\u036f]/g, "").toLowerCase();
  const wordsOf = text => plain(text).match(/[\p{L}\p{N}]+/gu) ?? [];
  let index; // word -> Map(section -> how much it says there), made at the first question

  // A word of a heading says more than one of its page's title or address, and that more than one
  // of the text, where the first few count. The begin of a page answers better than its
  // exercises, a chapter of the Course better than a proof, a page for readers better than one for those who change the
  // code, and a page better than a source, unless a source is asked for.
  const IDLE = new Set("a an and are can do does for how i in is it my of on or the there to we what when where which why with you your".split(" "));
  const NAMED = 3, TITLE = 1, ADDRESS = 1;
  const worth = ({ p, t, u }) => (t === p ? 1.6 : 1)
    * (/^(Exercises|Answers|How we know|What we have now)$/.test(t) ? 0.5 : 1) * (/^\d/.test(u) ? 1.3 : /^(tour|evidence|moving|bibliography)\./.test(u) ? 0.6 : 1);

  function build() {
    index = new Map();
    FVI_TEXTS.forEach((text, section) => {
      const at = new Map(), once = (words, value) => new Set(wordsOf(words)).forEach(word => at.set(word, (at.get(word) ?? 0) + value));
      const counts = new Map();
      for (const word of wordsOf(text.x)) counts.set(word, (counts.get(word) ?? 0) + 1);
      for (const [word, count] of counts) at.set(word, count / (count + 2));
      once(text.t, NAMED);
      once(text.p, TITLE);
      once(text.u.replace(/#.*/, ""), ADDRESS);
      for (const [word, value] of at) {
        if (!index.has(word)) index.set(word, new Map());
        index.get(word).set(section, value * worth(text));
      }
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
        found.set(section, (found.get(section) ?? 0) + likeness * rare * weight);
    }
    return found;
  }

  // The sections that have every word, best first; where there is none, those that have some.
  function search(question) {
    if (!index) build();
    const all = new Map(), asked = [...new Set(wordsOf(question))], telling = asked.filter(word => !IDLE.has(word));
    const words = telling.length ? telling : asked, source = /\w[._]\w/.test(question) ? 1 : 0.08; // of a file or a function
    for (const word of words)
      for (const [section, value] of hits(word)) {
        const [count, sum] = all.get(section) ?? [0, 0];
        all.set(section, [count + 1, sum + value * (FVI_TEXTS[section].u.startsWith("source/") ? source : 1)]);
      }
    const best = [...all].sort((a, b) => b[1][1] - a[1][1]), every = best.filter(([, [count]]) => count === words.length);
    return (every.length ? every : best).map(([section]) => FVI_TEXTS[section]);
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

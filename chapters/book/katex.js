// Render every formula: on standard input a JSON array of pages, each an array of pieces
// of HTML; on standard output { pages: the same, equations: { number: [page, HTML] } }. A formula
// that KaTeX refuses, or a second equation of a number, is named and ends the build.
const katex = require('/usr/share/javascript/katex/katex.min.js');
const pages = JSON.parse(require('fs').readFileSync(0, 'utf8'));

function plain(text) {
  return text.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&#39;/g, "'")
    .replace(/&amp;/g, '&');
}

// A display that is wider than the page goes on in a new line: before what stands behind a
// \quad, and not within it.
function parts(formula) {
  const [, body, tag] = /^([^]*?)(\\tag\{[^}]*\}\s*)?$/.exec(formula), out = [''];
  let depth = 0;
  for (const token of body.match(/\\[a-zA-Z]+|\\[^]|[^\\]/g)) {
    depth += /^(\{|\\left|\\begin)$/.test(token) - /^(\}|\\right|\\end)$/.test(token);
    out[out.length - 1] += token;
    if (depth === 0 && /^\\q?quad$/.test(token)) out.push('');
  }
  return out.map((part, i) => i === 0 ? part : `\\allowbreak{${part}}`).join('') + (tag ?? '');
}

const equations = {};
let bad = 0;
const known = new Map(); // most formulas stand in several places
function rendered(formula, displayMode) {
  const key = displayMode + formula;
  if (!known.has(key))
    known.set(key, katex.renderToString(displayMode ? parts(formula) : formula, { displayMode, throwOnError: true, strict: false })
      .replace(/<mo>\u2061<\/mo>(?=<\/msub>)/g, '')); // of u_{\max}, a third child where MathML has two
  return known.get(key);
}

// No line begins with a stop, or with the box that ends a proof: a browser would break behind any
// formula. So these are set as the end of the formula; behind a word the box is kept with the word.
const BOX = String.raw`<span class="math inline">\\\(\\square\\\)</span>`;
const FORMULA = new RegExp(String.raw`<span class="math (inline|display)">\\[(\[]([^]*?)\\[)\]]</span>(</em>|</strong>)?([.,;:!?)]*)(\s+${BOX})?`, 'g');
const WORD = new RegExp(String.raw`(?<=\s)((?:<a\b[^>]*>[^<]{1,24}</a>)?[^\s<>]+\s+${BOX})`, 'g');

function render(html, page) {
  return html.replace(WORD, '<span class="keep">$1</span>').replace(FORMULA,
    (whole, kind, escaped, close = '', stop, box) => {
      const formula = plain(escaped).trim(), display = kind === 'display';
      try {
        if (!display) {
          if (!box && stop && formula.length < 25) return `<span class="keep">${rendered(formula, false)}${stop}</span>${close}`;
          const end = box ? `${stop}~` : stop;
          return rendered(end ? `${formula}\\text{${end}}${box ? '\\square' : ''}` : formula, false) + close;
        }
        const tag = /\\tag\{(\d+[a-e]|\d+\.\d+)\}/.exec(formula), done = rendered(formula, true);
        if (!tag) return `<span class="formula">${done}</span>${close}${stop}${box ?? ''}`;
        if (equations[tag[1]]) throw new Error(`there is another equation (${tag[1]})`);
        equations[tag[1]] = [page, done];
        return `<span class="formula" id="eq-${tag[1]}" role="group" aria-label="Equation (${tag[1]})">${done}</span>`
          + `<a class="anchor" href="#eq-${tag[1]}" aria-label="Link to equation (${tag[1]})">#</a>${close}${stop}${box ?? ''}`;
      } catch (error) {
        console.error(`the book: bad formula: ${formula}\n  ${error.message}`);
        bad++;
        return whole;
      }
    });
}

const out = JSON.stringify({ pages: pages.map((pieces, i) => pieces.map(html => render(html, i))), equations });
if (bad === 0) process.stdout.write(out);
process.exitCode = bad ? 1 : 0;

// Render every formula of a page: HTML on standard input, HTML on standard output.
// A formula that KaTeX refuses is named and ends the build.
const katex = require('/usr/share/javascript/katex/katex.min.js');
const page = require('fs').readFileSync(0, 'utf8');

function plain(text) {
  return text.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&#39;/g, "'")
    .replace(/&amp;/g, '&');
}

let bad = 0;
const out = page.replace(/<span class="math (inline|display)">\\[(\[]([\s\S]*?)\\[)\]]<\/span>([.,;:!?)]*)/g,
  (whole, kind, escaped, stop) => {
    const formula = plain(escaped).trim(), display = kind === 'display';
    try {
      const tag = /\\tag\{([\d.]+)\}/.exec(formula);
      const rendered = katex.renderToString(formula, { displayMode: display, throwOnError: true, strict: false });
      if (!display) return stop && formula.length < 25 ? `<span class="keep">${rendered}${stop}</span>` : rendered + stop;
      return `<span class="formula"${tag ? ` id="eq-${tag[1]}"` : ''} tabindex="0">${rendered}</span>${stop}`;
    } catch (error) {
      console.error(`the book: bad formula: ${formula}\n  ${error.message}`);
      bad++;
      return whole;
    }
  });
if (bad === 0) process.stdout.write(out);
process.exitCode = bad ? 1 : 0;

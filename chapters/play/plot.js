// chapters/play/plot.js -- Curves on a canvas: axes, ticks, lines, dots.

// The colours of the style sheet; to be read again before each frame.
let colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "soft-ink", "ground", "grid", "axis", "run", "exact", "past", "positive", "negative", "pinned"])
    colours[name] = style.getPropertyValue(`--${name}`).trim();
}

// The least and the most of some arrays, a little wider, never of width zero.
function span(...arrays) {
  let low = Infinity, high = -Infinity;
  for (const values of arrays)
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  if (!(low <= high)) return [-1, 1];
  low = Math.max(low, -1e300); // what blows up must not overflow here
  high = Math.min(high, 1e300);
  const room = Math.max(0.06 * (high - low), 1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-12);
  return [low - room, high + room];
}

// Round numbers in [low, high]; on a logarithmic axis the powers of ten.
function ticks(low, high, log, about) {
  const values = [];
  if (log) {
    const first = Math.ceil(Math.log10(low)), last = Math.floor(Math.log10(high));
    for (let e = first, by = Math.ceil((last - first + 1) / about); e <= last; e += by) values.push(10 ** e);
    return values;
  }
  const rough = (high - low) / about, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find(digit => digit * power >= rough);
  for (let i = Math.ceil(low / step); i <= Math.floor(high / step); i++) values.push(i * step);
  return values;
}

function label(value) {
  const size = Math.abs(value), rounded = Number(value.toPrecision(4));
  if (size !== 0 && (size >= 1e5 || size < 1e-3)) return rounded.toExponential().replace("e+", "e");
  return String(rounded);
}

// How much larger than usual the letters of the page are: on a wall the pictures are, too.
const enlarged = () => parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;

// One picture. axes: { x: [low, high], y: [low, high], log: "", "x", "y" or "xy", names: [x, y],
// bare: without an axis y, room: pixels kept free at the right }. canvas.pen draws in place of the canvas's own; canvas.series, if it is
// there, gets [name, x, y] of all that is drawn.
// Returns what draws into it, in the units of the axes.
function picture(canvas, axes) {
  const unit = enlarged(), dots = window.devicePixelRatio * unit;
  const width = canvas.clientWidth / unit, height = canvas.clientHeight / unit;
  if (canvas.width !== Math.round(width * dots) || canvas.height !== Math.round(height * dots)) {
    canvas.width = Math.round(width * dots);
    canvas.height = Math.round(height * dots);
  }
  const pen = canvas.pen ?? canvas.getContext("2d"), logs = ["x", "y"].map(name => (axes.log ?? "").includes(name));
  const left = axes.bare ? 20 : 52, right = width - (axes.room ?? 10), top = axes.bare ? 2 : 20, bottom = height - (axes.bare ? 18 : 34);
  const place = ([low, high], from, to, log) => {
    const scale = log ? Math.log10 : value => value, a = scale(low), by = (to - from) / (scale(high) - a);
    return value => from + (scale(value) - a) * by;
  };
  const X = place(axes.x, left, right, logs[0]), Y = place(axes.y, bottom, top, logs[1]);

  pen.setTransform(dots, 0, 0, dots, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "12px system-ui, sans-serif";
  pen.lineWidth = 1;
  pen.setLineDash([]);
  const line = (x0, y0, x1, y1) => {
    pen.beginPath();
    pen.moveTo(x0, y0);
    pen.lineTo(x1, y1);
    pen.stroke();
  };
  for (const [of, at, along, log] of [[axes.x, X, true, logs[0]], ...axes.bare ? [] : [[axes.y, Y, false, logs[1]]]])
    for (const value of ticks(...of, log, along ? Math.max(3, width / 90) : 5)) {
      pen.strokeStyle = colours[value === 0 ? "axis" : "grid"];
      pen.fillStyle = colours.ink;
      pen.textAlign = along ? "center" : "right";
      pen.textBaseline = along ? "top" : "middle";
      if (along) line(at(value), top, at(value), bottom);
      else line(left, at(value), right, at(value));
      const words = label(value), wide = pen.measureText(words).width; // none is cut by the edge
      pen.fillText(words, along ? Math.min(at(value), width - wide / 2) : Math.max(left - 5, wide), along ? bottom + 4 : at(value));
    }
  pen.fillStyle = colours["soft-ink"];
  pen.textAlign = "right";
  pen.textBaseline = "bottom";
  pen.fillText(axes.names[0], right, height);
  pen.textAlign = "left";
  pen.fillText(axes.names[1], 4, top - 6); // above a number at the upper end

  const note = text => {
    const wide = pen.measureText(text).width + 8;
    pen.clearRect((left + right - wide) / 2, (top + bottom) / 2 - 10, wide, 20); // no line through it
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.fillText(text, (left + right) / 2, (top + bottom) / 2);
  };
  const inside = draw => (...what) => {
    pen.save();
    pen.beginPath();
    pen.rect(left - 8, top - 8, right - left + 16, bottom - top + 16);
    pen.clip();
    draw(...what);
    pen.restore();
  };
  return {
    note, pen,
    edges: { left, right, top, bottom },
    // Where a point is, in pixels of the pen.
    at: (x, y) => [X(x), Y(y)],
    left: axes.x[0],
    // Where a pixel is on the axis x: 0 at its left end, 1 at its right.
    fraction: pixel => (pixel / unit - left) / (right - left),
    // The same up the axis y: 0 at its lower end, 1 at its upper.
    height: pixel => (bottom - pixel / unit) / (bottom - top),
    curve: inside((x, y, name, dash = [], thickness = 1.8) => {
      pen.strokeStyle = colours[name];
      pen.lineWidth = thickness;
      pen.lineJoin = "round";
      pen.setLineDash(dash);
      pen.beginPath();
      for (let i = 0; i < y.length; i++) pen.lineTo(X(x[i]), Y(y[i]));
      pen.stroke();
      canvas.series?.push([name, x, y]);
    }),
    // Words to the right of a point, or to its left.
    text: (x, y, words, name, left = false) => {
      pen.fillStyle = colours[name];
      pen.textAlign = left ? "right" : "left";
      pen.textBaseline = "middle";
      pen.fillText(words, X(x) + (left ? -8 : 8), Y(y));
    },
    // A dot of that radius, full or hollow.
    dot: inside((x, y, name, radius, hollow = false) => {
      pen.beginPath();
      pen.arc(X(x), Y(y), radius, 0, 2 * Math.PI);
      pen[hollow ? "strokeStyle" : "fillStyle"] = colours[name];
      pen.lineWidth = 1.4;
      if (hollow) pen.stroke();
      else pen.fill();
      canvas.series?.push([name, [x], [y]]);
    }),
  };
}

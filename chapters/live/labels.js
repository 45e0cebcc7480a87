// chapters/live/labels.js -- Axes whose curves are named at their ends, and handles that a finger can take.

// A picture, whose axes the pointer of its canvas then asks. of.ends: the words that will stand at
// the ends of curves, for which room is kept at the right. Beside what picture() of plot.js has:
//
//   ends([[words, colour, x, y], ...])  names each curve at its last visible point, no two on one place
//   handle(x, y, colour, radius)        a dot with a ring; a finger that begins there drags
function axes(canvas, { ends = [], ...of }) {
  const pen = canvas.getContext("2d");
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.font = FONT;
  const room = Math.max(10, ...ends.map(words => pen.measureText(words).width + 12));
  const plot = canvas.axes = picture(canvas, { ...of, room });
  canvas.handles = [];
  plot.ends = curves => nameEnds(plot, of, curves);
  plot.handle = (x, y, colour, radius) => {
    plot.dot(x, y, "ground", radius + 5);
    plot.dot(x, y, colour, radius + 4, true);
    plot.dot(x, y, colour, radius);
    canvas.handles.push(plot.at(x, y).map(pixel => pixel * enlarged()));
  };
  return plot;
}

const FONT = "12px system-ui, sans-serif", APART = 14; // as in plot.js; pixels from one name to the next

function nameEnds({ at, edges, pen }, { x: [fromX, toX], y: [fromY, toY] }, curves) {
  const names = curves.map(([words, colour, x, y]) => {
    let last = y.length - 1;
    while (last >= 0 && !(y[last] >= fromY && y[last] <= toY && x[last] >= fromX && x[last] <= toX)) last--;
    if (last < 0) return null; // none of it is seen
    const [left, top] = at(x[last], y[last]);
    return { words, colour, left, top, place: top };
  }).filter(Boolean).sort((a, b) => a.top - b.top);
  const lowest = edges.bottom + 4;
  names.forEach((name, i) => { name.place = Math.max(name.top, i ? names[i - 1].place + APART : edges.top); });
  for (let i = names.length - 1, most = lowest; i >= 0; i--, most -= APART) names[i].place = most = Math.min(names[i].place, most);
  pen.setLineDash([]);
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  for (const { words, colour, left, top, place } of names) {
    const from = Math.min(left, edges.right);
    pen.fillStyle = pen.strokeStyle = colours[colour];
    if (Math.abs(place - top) > 5) { // which curve it is
      pen.lineWidth = 0.7;
      pen.beginPath();
      pen.moveTo(from, top);
      pen.lineTo(from + 7, place);
      pen.stroke();
    }
    pen.fillText(words, from + 8, place);
  }
}

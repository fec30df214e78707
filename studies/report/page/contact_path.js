// The path of contact on both flanks, drawn on the flanks themselves: tip at the top, face width to the right.

const PATH_HEIGHT = 330;
const PATH_MARGIN = { left: 56, right: 74, top: 26, bottom: 40 };

/** Pieces of a path between its jumps: an edge contact may leave one end of the tooth and continue at the other. */
function continuous_pieces(stations, bounds) {
  const depth = bounds.tip - bounds.form;
  const pieces = [];
  stations.forEach((station, i) => {
    const before = stations[i - 1];
    const jumps = !before || station.contact === "line" || before.contact === "line"
      || Math.abs(station.z - before.z) > 0.3 * bounds.half_face || Math.abs(station.r - before.r) > 0.3 * depth;
    if (jumps) pieces.push([]);
    pieces[pieces.length - 1].push(station);
  });
  return pieces;
}

/** An arrowhead beside the step from one station to the next, on the side of `centre` and clear of the marks. */
function draw_arrow(pen, from, to, centre, size) {
  const middle = { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
  const angle = Math.atan2(to.y - from.y, to.x - from.x);
  const left_of = -Math.sin(angle) * (centre.x - middle.x) + Math.cos(angle) * (centre.y - middle.y);
  pen.save();
  pen.translate(middle.x, middle.y);
  pen.rotate(angle);
  pen.translate(0, (left_of < 0 ? -2.2 : 2.2) * size);
  pen.beginPath();
  pen.moveTo(size, 0);
  pen.lineTo(-0.7 * size, 0.6 * size);
  pen.lineTo(-0.7 * size, -0.6 * size);
  pen.closePath();
  pen.fill();
  pen.restore();
}

/** Arrowheads every `spacing` pixels beside a polyline. */
function draw_direction(pen, line, centre, spacing) {
  let since = 0.5 * spacing;
  for (let i = 1; i < line.length; ++i) {
    const step = Math.hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    since += step;
    if (since < spacing || step === 0) continue;
    draw_arrow(pen, line[i - 1], line[i], centre, 5.5);
    since = 0;
  }
}

function draw_mark(pen, kind, x, y, size, filled) {
  const { colour, style } = CONTACT_KINDS[kind];
  const stroked = /cross|star/.test(style);
  pen.strokeStyle = sequence_colour(colour);
  pen.fillStyle = filled ? sequence_colour(colour) : css_colour("surface");
  pen.lineWidth = stroked ? 1.8 : 1.2;
  Chart.helpers.drawPoint(pen, { pointStyle: style, radius: size, borderWidth: pen.lineWidth, rotation: 0 }, x, y);
}

/** The flank as a rectangle in the frame, with its circles named beside it. */
function draw_flank(pen, bounds, frame, to_x, to_y) {
  const left = to_x(-bounds.half_face), right = to_x(bounds.half_face);
  pen.fillStyle = css_colour("page");
  pen.fillRect(left, to_y(bounds.tip), right - left, to_y(bounds.form) - to_y(bounds.tip));
  pen.strokeStyle = css_colour("muted");
  pen.lineWidth = 1.2;
  pen.strokeRect(left, to_y(bounds.tip), right - left, to_y(bounds.form) - to_y(bounds.tip));
  pen.fillStyle = css_colour("muted");
  pen.font = `11px ${Chart.defaults.font.family}`;
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  const beside = frame.left + frame.width + 6;
  pen.fillText("tip", beside, to_y(bounds.tip));
  const circle = (radius, name, name_y) => {
    const y = to_y(radius);
    pen.setLineDash([5, 4]);
    pen.beginPath();
    pen.moveTo(left, y);
    pen.lineTo(right, y);
    pen.stroke();
    pen.setLineDash([]);
    pen.fillText(name, beside, name_y(y));
  };
  if (bounds.tip_form < bounds.tip) circle(bounds.tip_form, "edge begins", (y) => Math.max(y, to_y(bounds.tip) + 13));
  pen.fillText("form circle", beside, to_y(bounds.form));
  if (is_number(bounds.active_root)) circle(bounds.active_root, "active root", (y) => Math.min(y, to_y(bounds.form) - 13));
}

const LEGEND_SIZE = 14;  // px
const mark_sample = (kind) => (pen) => draw_mark(pen, kind, LEGEND_SIZE / 2, LEGEND_SIZE / 2, 4.5, true);

/** Samples with words. @param entries  [[draw(pen), text]] */
function mark_legend(plot, entries) {
  const sample = (draw) => {
    const { canvas, pen } = sharp_canvas(LEGEND_SIZE, LEGEND_SIZE, "");
    canvas.removeAttribute("role");
    canvas.setAttribute("aria-hidden", "true");
    draw(pen);
    return canvas;
  };
  plot.append(el("p", { class: "mark-legend" }, ...entries.map(([draw, text]) => el("span", {}, sample(draw), ` ${text}`))));
}

function path_legend(plot, kinds) {
  const line = (width, opacity) => (pen) => {
    pen.strokeStyle = faded(css_colour("ink"), opacity);
    pen.lineWidth = width;
    pen.beginPath();
    pen.moveTo(0, LEGEND_SIZE / 2);
    pen.lineTo(LEGEND_SIZE, LEGEND_SIZE / 2);
    pen.stroke();
  };
  mark_legend(plot, [...kinds.map((kind) => [mark_sample(kind), kind_words(kind)]),
    [line(4, 1), "the pair leads (filled)"], [line(1.2, 0.6), "another pair leads (hollow)"]]);
}

function draw_flank_path(plot, run, bounds, gear) {
  const stations = run.map((station) => ({ ...point_on(station, gear), contact: station.contact, carries: station.carries,
    turned: station.turned })).filter((station) => is_number(station.z));
  const depth = bounds.tip - bounds.form;
  const area = { z: [-1.06 * bounds.half_face, 1.06 * bounds.half_face],
    r: [bounds.form - 0.12 * depth, bounds.tip + 0.12 * depth] };
  const available = plot.clientWidth || 560;
  const width = Math.max(240, Math.min(620, available));
  const { canvas, pen } = sharp_canvas(width, PATH_HEIGHT, `Path of contact on the ${gear} flank`);
  const frame = { left: PATH_MARGIN.left, top: PATH_MARGIN.top, width: width - PATH_MARGIN.left - PATH_MARGIN.right,
    height: PATH_HEIGHT - PATH_MARGIN.top - PATH_MARGIN.bottom };
  const to_x = (z) => frame.left + (frame.width * (z - area.z[0])) / (area.z[1] - area.z[0]);
  const to_y = (r) => frame.top + frame.height * (1 - (r - area.r[0]) / (area.r[1] - area.r[0]));
  draw_flank(pen, bounds, frame, to_x, to_y);

  const pixels = stations.map((station) => ({ ...station, x: to_x(station.z), y: to_y(station.r) }));
  const pieces = continuous_pieces(pixels, bounds);
  const ink = css_colour("ink");
  const stroke = (line, line_width, colour) => {
    pen.beginPath();
    line.forEach((at, i) => (i ? pen.lineTo(at.x, at.y) : pen.moveTo(at.x, at.y)));
    pen.strokeStyle = colour;
    pen.lineWidth = line_width;
    pen.stroke();
  };
  pen.lineJoin = pen.lineCap = "round";
  for (const piece of pieces) {
    stroke(piece, 1.2, faded(ink, 0.6));
    piece.forEach((at, i) => i && at.carries && piece[i - 1].carries && stroke([piece[i - 1], at], 4, ink));
  }
  // Marks are thinned to a legible distance; the last one before a change of kind is kept.
  let last = null;
  pixels.forEach((at, i) => {
    const changes = !last || last.contact !== at.contact || last.carries !== at.carries || i === pixels.length - 1;
    if (!changes && Math.hypot(at.x - last.x, at.y - last.y) < 9) return;
    draw_mark(pen, at.contact, at.x, at.y, 4, at.carries);
    last = at;
  });
  pen.fillStyle = ink;
  const centre = { x: frame.left + frame.width / 2, y: frame.top + frame.height / 2 };
  for (const piece of pieces) draw_direction(pen, piece, centre, 70);
  draw_axes(pen, frame, { z: area.z, r: area.r, title: `${capital(gear)} flank`, r_title: `${gear} radius [mm]` });

  const read_out = el("p", { class: "read-out", "aria-live": "off" }, "\u00a0");
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    const x = (event.clientX - box.left) * (width / box.width), y = (event.clientY - box.top) * (PATH_HEIGHT / box.height);
    const near = pixels.reduce((best, at) => {
      const distance = Math.hypot(at.x - x, at.y - y);
      return distance < (best?.distance ?? 14) ? { at, distance } : best;
    }, null);
    read_out.textContent = near === null ? "\u00a0" : `${kind_words(near.at.contact)}, z ${fmt(near.at.z, 3)} mm, radius `
      + `${fmt(near.at.r, 5)} mm, ${fmt(near.at.turned, 3)}° of pinion turn from the pitch point`
      + `${near.at.carries ? ", leads" : ""}`;
  });
  canvas.addEventListener("pointerleave", () => (read_out.textContent = "\u00a0"));
  plot.append(canvas, read_out);
}

/** Both flanks side by side under one legend. */
function draw_contact_paths(plot, results, scene) {
  const run = pair_run(scene, record(record(results.geometry).pinion).teeth);
  const kinds = Object.keys(CONTACT_KINDS).filter((kind) => run.some((station) => station.contact === kind));
  if (kinds.length === 0) {
    plot.append(el("p", { class: "empty" }, "The flanks do not touch in this scene."));
    return;
  }
  path_legend(plot, kinds);
  const flanks = ["pinion", "wheel"].map((gear) => ({ gear, bounds: flank_bounds(results, gear), half: el("div") }))
    .filter((flank) => flank.bounds);
  plot.append(el("div", { class: "flanks" }, ...flanks.map((flank) => flank.half)));
  flanks.forEach(({ gear, bounds, half }) => draw_flank_path(half, run, bounds, gear));
}

// A grid of the flank as a surface in space, seen from above in parallel projection and turned by a slider.

const SURFACE_MARGIN = { top: 42, bottom: 26 };  // for the title and a label above the surface, and a label below it
const SURFACE_TILT = (32 * Math.PI) / 180;  // of the view below the horizontal

/**
 * Projection of the flank with its middle at the origin: face width along u, radius along v, both in half face widths of the
 * drawing, removed material downwards. `height` is that of the picture in which all of the surface is seen, from its highest place (no
 * removal) to its lowest (the largest of the scale), with room for labels.
 */
function surface_view(grid, scale, turn, width) {
  const [z0, z1] = [grid.z[0], grid.z[grid.z.length - 1]], [r0, r1] = [grid.r[0], grid.r[grid.r.length - 1]];
  // Turned so that it is widest it leaves room for a label on either side.
  const half_face = Math.min(200, Math.max(0.28 * width, (0.5 * width - 66) / 1.15)), half_depth = 0.55 * half_face, drop = 105;
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const raised = (z, r, removal) => {
    const u = half_face * ((2 * (z - z0)) / (z1 - z0) - 1), v = half_depth * ((2 * (r - r0)) / (r1 - r0) - 1);
    const across = u * c - v * s, away = u * s + v * c;
    return { x: width / 2 + across, away,
      y: drop * Math.cos(SURFACE_TILT) * ((removal - scale.low) / (scale.high - scale.low)) - away * Math.sin(SURFACE_TILT) };
  };
  const heights = [z0, z1].flatMap((z) => [r0, r1].flatMap((r) => [Math.min(0, scale.low), scale.high].map((removal) => raised(z, r, removal).y)));
  const rise = SURFACE_MARGIN.top - minimum(heights);
  const place = (z, r, removal) => {
    const at = raised(z, r, removal);
    return { ...at, y: at.y + rise };
  };
  return { place, z: [z0, z1], r: [r0, r1], height: maximum(heights) + rise + SURFACE_MARGIN.bottom };
}

/** Quadrangles of the surface, the furthest first. */
function surface_cells(grid, view) {
  const cells = [];
  for (let j = 0; j + 1 < grid.r.length; ++j) {
    for (let i = 0; i + 1 < grid.z.length; ++i) {
      const corners = [[j, i], [j, i + 1], [j + 1, i + 1], [j + 1, i]]
        .map(([row, column]) => ({ removal: list(grid.rows[row])[column], z: grid.z[column], r: grid.r[row] }));
      if (!corners.every((corner) => is_number(corner.removal))) continue;
      const places = corners.map((corner) => view.place(corner.z, corner.r, corner.removal));
      const mean = (values) => values.reduce((a, b) => a + b, 0) / values.length;
      cells.push({ places, away: mean(places.map((p) => p.away)), removal: mean(corners.map((corner) => corner.removal)) });
    }
  }
  return cells.sort((a, b) => b.away - a.away);
}

/** Draws the surface in the colours of `scale`, the unmodified flank as a dashed frame above it, and writes its ends beside it. */
function draw_surface(plot, grid, scale, turn, { title, gear, width }) {
  const view = surface_view(grid, scale, turn, width);
  const { canvas, pen } = sharp_canvas(width, view.height, `${title}: topography of the ${gear} flank as a surface`);
  const trace = (places) => {
    pen.beginPath();
    places.forEach((p, i) => (i ? pen.lineTo(p.x, p.y) : pen.moveTo(p.x, p.y)));
    pen.closePath();
  };
  pen.lineWidth = 0.6;
  pen.lineJoin = "round";
  for (const cell of surface_cells(grid, view)) {
    const colour = `rgb(${map_colour((cell.removal - scale.low) / (scale.high - scale.low)).join(",")})`;
    trace(cell.places);
    pen.fillStyle = pen.strokeStyle = colour;
    pen.fill();
    pen.stroke();
    pen.strokeStyle = "rgba(0,0,0,.16)";
    pen.stroke();
  }
  const [z0, z1] = view.z, [r0, r1] = view.r;
  const corners = [[z0, r0], [z1, r0], [z1, r1], [z0, r1]];
  pen.strokeStyle = css_colour("axis");
  pen.lineWidth = 1;
  pen.setLineDash([5, 4]);
  trace(corners.map(([z, r]) => view.place(z, r, 0)));
  pen.stroke();
  for (const [z, r] of corners) {
    const removal = grid_value(grid, z, r);
    if (removal === null) continue;
    trace([view.place(z, r, 0), view.place(z, r, removal)]);
    pen.stroke();
  }
  pen.setLineDash([]);

  pen.fillStyle = css_colour("ink");
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.font = `600 13px ${Chart.defaults.font.family}`;
  pen.fillText(title, 6, 11);
  pen.font = `12px ${Chart.defaults.font.family}`;
  const centre = view.place((z0 + z1) / 2, (r0 + r1) / 2, 0);
  const taken = [];  // by labels: [left, right, y]
  // Places of the frame, of the surface and between them along an edge.
  const edge_places = (z, r) => {
    const along = Array.from({ length: 25 }, (_, i) => i / 24), is_face_end = z === z0 || z === z1;
    return along.flatMap((t) => {
      const [at_z, at_r] = is_face_end ? [z, r0 + t * (r1 - r0)] : [z0 + t * (z1 - z0), r];
      const removal = grid_value(grid, at_z, at_r) ?? 0;
      return [0, 0.25, 0.5, 0.75, 1].map((part) => view.place(at_z, at_r, part * removal));
    });
  };
  const write = (z, r, text) => {
    // Beside the frame or the surface, whichever stands out further there.
    const removal = grid_value(grid, z, r) ?? 0, is_near = view.place(z, r, 0).y > centre.y;
    const p = view.place(z, r, is_near ? Math.max(0, removal) : Math.min(0, removal));
    const side = p.x < centre.x - 12 ? -1 : p.x > centre.x + 12 ? 1 : 0;
    pen.textAlign = side < 0 ? "right" : side > 0 ? "left" : "center";
    const down = p.y > centre.y ? 1 : -1, wide = pen.measureText(text).width;
    let y = p.y + 12 * down;
    const beside = edge_places(z, r).filter((place) => Math.abs(place.y - y) < 9).map((place) => side * place.x);
    const x = side === 0 ? p.x : side * Math.max(side * p.x, maximum(beside)) + 7 * side;
    const left = side < 0 ? x - wide : side > 0 ? x : x - wide / 2;
    pen.textAlign = "left";
    const inside = Math.min(Math.max(4, left), width - wide - 4);
    while (taken.some(([from, to, at]) => inside < to + 6 && inside + wide > from - 6 && Math.abs(at - y) < 15)) y += 15 * down;
    y = Math.min(Math.max(26, y), view.height - 8);
    taken.push([inside, inside + wide, y]);
    pen.strokeStyle = css_colour("surface");
    pen.lineWidth = 4;
    pen.strokeText(text, inside, y);
    pen.fillStyle = css_colour("ink");
    pen.fillText(text, inside, y);
  };
  write(z0, (r0 + r1) / 2, `z ${fmt(z0)} mm`);
  write(z1, (r0 + r1) / 2, `z ${fmt(z1)} mm`);
  write((z0 + z1) / 2, r1, `tip, r ${fmt(r1)} mm`);
  write((z0 + z1) / 2, r0, `r ${fmt(r0)} mm`);
  plot.append(canvas);
}

/** @param entries  [{title, grid}] drawn side by side on one scale, turned together */
function draw_surfaces(plot, entries, scale, gear, state) {
  const width = Math.min(560, ((plot.clientWidth || 900) - 86) / entries.length - 10);
  const row = el("div", { class: "maps" });
  const input = el("input", { type: "range", min: -180, max: 180, step: 2, value: state.degrees, "aria-label": "Turn the surface" });
  const shown = el("output", {}, `${state.degrees}°`);
  const draw = () => {
    row.replaceChildren();
    for (const { title, grid } of entries) draw_surface(row, grid, scale, (state.degrees * Math.PI) / 180, { title, gear, width });
    row.append(colour_bar(scale, "µm", 330));
  };
  input.addEventListener("input", () => {
    state.degrees = Number(input.value);
    shown.textContent = `${state.degrees}°`;
    draw();
  });
  plot.append(row, el("label", { class: "slider no-print" }, "Turned by ", input, shown));
  draw();
}

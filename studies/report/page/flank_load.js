// Contact stress, line load and gap on the pinion flank: over the whole mesh cycle, or along the contact lines of one mesh position.

const FLANK_QUANTITIES = [
  { unit: "MPa", title: "Contact stress on the pinion flank",
    values_of: (_, columns) => list(columns.contact_stress_MPa),
    caption: "Contact pressure, on rounded tip edges that of the strip on flank and rounding. Over the whole cycle each cell shows the largest value at its place, linear "
      + "between neighbouring contact lines. Grey areas are never loaded. The scale is that of the flank off the tip edges, at the mesh positions; peaks between them are in the summary." },
  { unit: "N/mm", title: "Line load on the pinion flank",
    values_of: (_, columns) => list(columns.load_N_per_mm),
    caption: "Load per unit length of contact line over the whole field of contact. A ridge towards one face end shows "
      + "misalignment that the modifications do not compensate." },
  { unit: "µm", title: "Gap before the load on the pinion flank", is_gap: true,
    values_of: (position, columns) => list(columns.gap_um).map((gap) => (is_number(gap) ? gap - least_gap(position) : null)),
    caption: "Distance of the unloaded flanks along the flank normal, measured from the first contact in that mesh position. The "
      + "load has to close it. Over the whole cycle each cell shows the smallest value at its point. In grey areas the gap is more than a tenth "
      + "above the largest gap that the load closes." },
];

const least_gap = (position) =>
  minimum(list(position.teeth).map((tooth) => minimum(list(record(record(tooth).points).gap_um))));

/** The largest gap that the load closes anywhere in the mesh cycle [um]. */
const closed_gap = (entry) => maximum(list(record(entry).cycle).map(record).flatMap((position) => {
  const least = least_gap(position);
  return list(position.teeth).flatMap((tooth) => {
    const { gap_um, load_N_per_mm } = record(record(tooth).points);
    return list(gap_um).map((gap, i) => (list(load_N_per_mm)[i] > 0 && is_number(gap) ? gap - least : null));
  });
}));

/** Common data of the maps of a quantity in a load case, computed once: {area, scale, designs: [{design, points, raster}]}. */
function flank_clouds(load_case, quantity) {
  load_case.clouds = load_case.clouds || new Map();
  if (load_case.clouds.has(quantity)) return load_case.clouds.get(quantity);
  const designs = designs_of(load_case)
    .map((design) => ({ design, points: contact_points(load_case.designs[design], quantity.values_of) }));
  const all = designs.flatMap(({ points }) => points);
  const area = all.length ? area_of(all) : null;
  const top = quantity.is_gap ? 1.1 * maximum(designs.map(({ design }) => closed_gap(load_case.designs[design])))
    : maximum((all.some((point) => !point.tip_edge && point.value > 0) ? all.filter((point) => !point.tip_edge) : all).map((point) => point.value));
  const scale = { low: 0, high: is_number(top) && top > 0 ? top : 1 };
  const rank = quantity.is_gap ? { is_bare: (gap) => gap > scale.high, outranks: (a, b) => a < b }
    : { is_bare: (value) => value <= 0, outranks: (a, b) => a > b };
  const clouds = { area, scale, rank,
    designs: designs.map((own) => ({ ...own, raster: area ? flank_raster(own.points, area, rank) : null })) };
  load_case.clouds.set(quantity, clouds);
  return clouds;
}

/** The stored phase of a cloud that is nearest to the wanted one, round the cycle. */
function nearest_phase(points, wanted) {
  const apart = (phase) => Math.abs(phase - wanted - Math.round(phase - wanted));
  return points.reduce((best, { phase }) => (best === null || apart(phase) < apart(best) ? phase : best), null);
}

/** The contact lines of one mesh position: each quadrature point is a segment in the colour of its value; unloaded ones are thin and grey. */
function draw_contact_lines(pen, points, { scale, rank }, to_x, to_y) {
  const middle = (a, b) => [(to_x(a.z) + to_x(b.z)) / 2, (to_y(a.r) + to_y(b.r)) / 2];
  const stretch = (line, i) => {
    const from = i > 0 ? middle(line[i - 1], line[i]) : [to_x(line[i].z), to_y(line[i].r)];
    const to = i + 1 < line.length ? middle(line[i], line[i + 1]) : [to_x(line[i].z), to_y(line[i].r)];
    pen.beginPath();
    pen.moveTo(...from);
    pen.lineTo(to_x(line[i].z), to_y(line[i].r));
    pen.lineTo(...to);
    pen.stroke();
  };
  pen.lineJoin = "round";
  for (const tooth of unique(points.map((point) => point.tooth))) {
    const line = points.filter((point) => point.tooth === tooth);
    const shown = line.map((point) => !rank.is_bare(point.value));
    pen.lineCap = "round";
    pen.strokeStyle = css_colour("ink");
    line.forEach((_, i) => {
      pen.lineWidth = shown[i] ? 11 : 2;
      stretch(line, i);
    });
    pen.lineCap = "butt";
    pen.lineWidth = 8;
    line.forEach((point, i) => {
      if (!shown[i]) return;
      pen.strokeStyle = `rgb(${map_colour((point.value - scale.low) / (scale.high - scale.low)).join(",")})`;
      stretch(line, i);
    });
  }
}

/** @param wanted  phase of the mesh position, null: the whole cycle */
function draw_flank_load(plot, load_case, quantity, wanted, height = MAP_HEIGHT) {
  const clouds = flank_clouds(load_case, quantity);
  if (!clouds.area) {
    plot.append(el("p", { class: "empty" }, "No contact points are stored for this load case."));
    return;
  }
  const { area, scale, rank } = clouds;
  const summary = (points) => {
    const largest = (some) => maximum(some.map((point) => point.value).filter((value) => !rank.is_bare(value)));
    if (quantity.is_gap) return wanted === null ? null : `largest shown ${fmt(largest(points), 3)} ${quantity.unit}`;
    const flank = points.filter((point) => !point.tip_edge), edges = points.filter((point) => point.tip_edge);
    return [flank.length > 0 ? `flank ${fmt(largest(flank), 3)}` : null, edges.length > 0 ? `tip edges ${fmt(largest(edges), 3)}` : null].filter(Boolean).join(", ")
      + ` ${quantity.unit} at most`;
  };
  const maps = clouds.designs.map(({ design, points, raster }) => {
    const phase = wanted === null ? null : nearest_phase(points, wanted);
    const here = phase === null ? points : points.filter((point) => point.phase === phase);
    const read = (z, r) => {
      const column = raster_index(z, area.z, raster.columns), row = raster_index(r, area.r, raster.rows);
      const point = raster.owner[row * raster.columns + column];
      if (!point) return "no point near";
      const where = `phase ${fmt(point.phase)}, tooth ${fmt(point.tooth)}`;
      const edge = point.tip_edge ? `, tip edge of the ${point.tip_edge} at ${fmt(point.edge_stress, 3)} MPa` : "";
      return rank.is_bare(point.value) ? `bare (${where})` : `${fmt(point.value)} ${quantity.unit} (${where}${edge})`;
    };
    const told = summary(here);
    return { name: DESIGN_LABEL[design].toLowerCase(), raster, read, opacity: phase === null ? 1 : 0.22,
      title: `${DESIGN_LABEL[design]}${phase === null ? "" : `, phase ${fmt(phase, 3)}`}${told ? `, ${told}` : ""}`,
      edges: on_tip_edges(here),
      overlay: phase === null ? null : (pen, to_x, to_y) => draw_contact_lines(pen, here, clouds, to_x, to_y),
      marks: (pen, to_x, to_y) => draw_edge_marks(pen, on_tip_edges(here), to_x, to_y) };
  });
  flank_maps(plot, { maps, area, scale, unit: quantity.unit, r_title: "pinion radius [mm]", height });
  const kinds = [...TIP_KINDS].filter((kind) => maps.some((map) => map.edges.some((mark) => mark.kind === kind)));
  if (kinds.length > 0) mark_legend(plot, kinds.map((kind) => [mark_sample(kind), `contact reaches the ${kind_words(kind)}`]));
}

/** A slider over the mesh positions of the longest cycle; its first stop is the whole cycle. Calls back with the phase or null. */
function mesh_slider(parent, cases, on_change) {
  const cycles = cases.flatMap((load_case) => designs_of(load_case).map((design) => list(load_case.designs[design].cycle)));
  const phases = cycles.reduce((longest, cycle) => (cycle.length > longest.length ? cycle : longest), [])
    .map((position) => record(position).phase).filter(is_number);
  if (phases.length < 2) return;
  const input = el("input", { type: "range", min: 0, max: phases.length, step: 1, value: 0, id: "mesh-position" });
  const shown = el("output", { for: "mesh-position" }, "whole cycle");
  input.addEventListener("input", () => {
    const at = Number(input.value);
    shown.textContent = at === 0 ? "whole cycle" : `position ${at} of ${phases.length}, phase ${fmt(phases[at - 1], 3)}`;
    on_change(at === 0 ? null : phases[at - 1]);
  });
  parent.append(el("label", { class: "slider no-print" }, "Mesh position ", input, shown));
}

function build_flank_load(results, body, selection) {
  const controls = el("div", { class: "controls" });
  body.append(controls);
  selection.add_choice(controls);
  let phase = null;
  const redraws = [];
  mesh_slider(controls, selection.cases, (wanted) => {
    phase = wanted;
    redraws.forEach((redraw) => redraw());
  });
  body.append(el("p", { class: "remark" }, "The slider moves through the mesh cycle. At each position the contact lines of all teeth in mesh are drawn: thick in the "
    + "colour of their value where they are loaded, thin where they are not. Lines that lie over a tip or root edge without touching it are included."));
  const grid = figure_grid(body);
  const paired = selection.cases.some((load_case) => designs_of(load_case).length > 1);
  for (const quantity of FLANK_QUANTITIES) {
    const caption = `${quantity.caption}${paired ? " Both maps share one scale." : ""}`;
    redraws.push(case_figure(grid, selection, { title: quantity.title, caption, wide: paired },
      (plot) => draw_flank_load(plot, selection.current, quantity, phase)));
  }
}

add_sections({ "flank-load": build_flank_load });

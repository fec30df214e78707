// Unloaded tooth contact: transmission error of single pairs and of the mesh, and where the flanks touch.

/** Kind of contact -> words, colour and mark; the mark tells the kinds apart without colour. */
const CONTACT_KINDS = {
  line: { label: "line contact", colour: 0, style: "rect" },
  surface: { label: "surface contact", colour: 2, style: "circle" },
  pinion_tip: { label: "pinion tip edge", colour: 1, style: "triangle" },
  wheel_tip: { label: "wheel tip edge", colour: 5, style: "rectRot" },
  pinion_root: { label: "pinion root boundary", colour: 3, style: "cross" },
  wheel_root: { label: "wheel root boundary", colour: 4, style: "crossRot" },
  face_end: { label: "face end", colour: 6, style: "star" },
  corner: { label: "corner", colour: 6, style: "rectRounded" },
};

const pair_points = (pair, y_of) => list(pair.positions).map(record).map((position) => ({
  x: position.phi1_deg, y: y_of(position), note: CONTACT_KINDS[position.contact]?.label,
}));

/** Range of the axis: the mesh's own curve with room around it; pairs out of mesh may leave the picture. */
function te_range(mesh_values, pair_values) {
  const low = minimum(mesh_values), high = maximum(mesh_values);
  const full = Math.max(high, maximum(pair_values)) - Math.min(low, minimum(pair_values));
  if (!is_number(low) || !is_number(full) || full === 0) return {};
  const room = Math.max(2 * (high - low), 0.1 * full);
  const clip = (bound, value) => (value === undefined || !is_number(value) ? bound : value);
  return {
    min: clip(low - room, Math.max(low - room, minimum(pair_values) - 0.02 * full)),
    max: clip(high + room, Math.min(high + room, Math.max(high, maximum(pair_values)) + 0.05 * full)),
  };
}

function draw_unloaded_te(plot, pairs, mesh) {
  const curves = pairs.map((pair, i) => ({
    label: `pair ${fmt(pair.tooth)}`,
    points: pair_points(pair, (position) => position.te_arcsec),
    colour: sequence_colour(i),
    width: 1.6,
    dashed: i >= SEQUENCES.light.length,
    order: 2,
  }));
  const phi = list(mesh.phi1_deg), te = list(mesh.te_arcsec);
  const points = phi.map((x, i) => ({ x, y: te[i] }));
  curves.push({ label: "mesh", points, colour: css_colour("ink"), width: 3, order: 1 });
  const transfers = list(mesh.transfers).map(record).map((transfer) => ({
    x: transfer.phi1_deg, y: transfer.te_arcsec,
    note: `from pair ${fmt(transfer.from_tooth)} to pair ${fmt(transfer.to_tooth)}`,
  }));
  if (transfers.length) {
    curves.push({ label: "transfer", points: transfers, colour: css_colour("ink"), fill: css_colour("surface"),
      scatter: true, hollow: true, size: 5, order: 0 });
  }
  xy_chart(plot, {
    label: "Unloaded transmission error",
    curves,
    x: "pinion rotation φ₁ [deg]", y: "TE at the wheel [arcsec]",
    y_range: te_range(te, curves.slice(0, pairs.length).flatMap((curve) => curve.points.map((p) => p.y))),
    read_x: (x) => `φ₁ ${fmt(x)}°`, read_y: (y) => `${fmt(y, 3)} arcsec`, nearest: "xy", height: 320,
  });
}

function draw_contact_path(plot, pairs, gear, geometry) {
  const positions = pairs.flatMap((pair) => list(pair.positions).map(record));
  const kinds = unique(positions.map((position) => position.contact)).filter((kind) => CONTACT_KINDS[kind]);
  const curves = kinds.map((kind) => ({
    label: CONTACT_KINDS[kind].label,
    points: positions.filter((position) => position.contact === kind).map((position) => ({
      x: record(position[gear]).z_mm, y: record(position[gear]).radius_mm, note: `φ₁ ${fmt(position.phi1_deg)}°`,
    })).filter((point) => is_number(point.x) && is_number(point.y)),
    colour: sequence_colour(CONTACT_KINDS[kind].colour),
    scatter: true,
    hollow: /cross|star/i.test(CONTACT_KINDS[kind].style),
    style: CONTACT_KINDS[kind].style,
    size: 4,
  })).filter((curve) => curve.points.length > 0);
  const half = record(geometry.faces)[gear] / 2;
  const z = numbers(curves.flatMap((curve) => curve.points.map((p) => p.x)));
  const reach = is_number(half) ? half : Math.max(1, ...z.map(Math.abs)) * 1.05;
  const bounds = [["tip", "tip_diameter_mm"], ["active root", "active_root_diameter_mm"]];
  for (const [name, key] of bounds) {
    const diameter = record(geometry[gear])[key];
    if (!is_number(diameter)) continue;
    curves.push({ label: name, quiet: true, colour: css_colour("muted"), width: 1, dashed: true, order: 2,
      points: [{ x: -reach, y: diameter / 2 }, { x: reach, y: diameter / 2 }] });
  }
  xy_chart(plot, {
    label: `Contact path on the ${gear} flank`,
    curves,
    x: "face width z [mm]", y: `${gear} radius [mm]`,
    x_range: { min: -reach, max: reach },
    read_x: (x) => `z ${fmt(x, 3)} mm`, read_y: (y) => `radius ${fmt(y, 5)} mm`, nearest: "xy",
  });
}

function mesh_harmonics(plot, mesh) {
  const amplitudes = list(mesh.harmonics_arcsec).slice(0, 10);
  bar_chart(plot, {
    label: "Harmonics of the unloaded transmission error",
    labels: amplitudes.map((_, i) => String(i + 1)),
    series: [{ label: "mesh", values: amplitudes, colour: css_colour("after") }],
    x: "order of the tooth-mesh frequency", y: "amplitude [arcsec]", unit: "arcsec",
  });
}

function build_unloaded(results, body) {
  const unloaded = record(results.unloaded);
  const pairs = list(unloaded.pairs).map(record), mesh = record(unloaded.mesh);
  const used = record(record(results.used).pair);
  const face = (gear) => record(used[gear]).face_width_mm ?? record(used[gear]).face_width;
  const geometry = { ...record(results.geometry), faces: { pinion: face("pinion"), wheel: face("wheel") } };
  const grid = figure_grid(body);
  const harmonics = numbers(mesh.harmonics_arcsec);
  const has_harmonics = harmonics.length > 0 && maximum(harmonics) > 0;
  figure(grid, {
    title: "Unloaded transmission error",
    wide: true,
    caption: "Each tooth pair alone, and the pair that leads at every instant as the bold line of the mesh; where two "
      + "pairs cross, the contact is handed over. Negative where material is removed.",
  }, (plot) => draw_unloaded_te(plot, pairs, mesh));
  for (const gear of ["pinion", "wheel"]) {
    figure(grid, {
      title: `Contact path on the ${gear} flank`,
      caption: `Where the ${gear} flank is touched in the course of the mesh, and by what: points on the dashed lines `
        + "of tip and active root are edge contact.",
    }, (plot) => draw_contact_path(plot, pairs, gear, geometry));
  }
  if (has_harmonics) {
    figure(grid, {
      title: "Harmonics of the unloaded transmission error",
      wide: true,
      caption: "Amplitudes of the mesh curve at multiples of the tooth-mesh frequency, at the wheel.",
    }, (plot) => mesh_harmonics(plot, mesh));
  }
}

// Unloaded tooth contact: transmission error of single pairs and of the mesh, transfer points, and a description in words.

const pair_points = (pair, y_of) => list(pair.positions).map(record).map((position) => ({
  x: position.phi1_deg, y: y_of(position), note: CONTACT_KINDS[position.contact]?.label,
}));

/** Range of the axis: the curve of the mesh with a margin; pairs out of mesh may leave the plot. */
function te_range(mesh_values, pair_values) {
  const low = minimum(mesh_values), high = maximum(mesh_values);
  const full = Math.max(high, maximum(pair_values)) - Math.min(low, minimum(pair_values));
  if (!is_number(low) || !is_number(full) || full === 0) return {};
  // A mesh without transmission error, except for round-off, is scaled by its pairs.
  const room = high - low > 1e-6 * full ? 2 * (high - low) : 0.1 * full;
  const clip = (bound, value) => (value === undefined || !is_number(value) ? bound : value);
  return {
    min: clip(low - room, Math.max(low - room, minimum(pair_values) - 0.02 * full)),
    max: clip(high + room, Math.min(high + room, Math.max(high, maximum(pair_values)) + 0.05 * full)),
  };
}

/** Datum of the curves: 0, or their highest point where backlash is large compared with their variation. */
function te_datum(values) {
  const low = minimum(values), high = maximum(values);
  return high - low > 0 && Math.abs(high) > 20 * (high - low) && Math.abs(high) > 1 ? high : 0;
}

/** Transfer points with the slopes of both pairs. */
const transfer_points = (mesh) => list(mesh.transfers).map(record).map((transfer) => {
  const jump = transfer.slope_jump_arcsec_per_deg;
  const slopes = is_number(jump) ? `, slope ${fmt(transfer.slope_before_arcsec_per_deg, 3)} to `
    + `${fmt(transfer.slope_after_arcsec_per_deg, 3)} arcsec/deg` : "";
  return {
    x: transfer.phi1_deg, y: transfer.te_arcsec, jump,
    note: `from pair ${fmt(transfer.from_tooth)} to pair ${fmt(transfer.to_tooth)}${slopes}`,
  };
});

/** @param pitch  angle of the pinion from one pair to the next, after which the mesh repeats [deg] */
function draw_unloaded_te(plot, scene, pitch, height = 320) {
  const pairs = list(scene.pairs).map(record), mesh = record(scene.mesh);
  const datum = te_datum(list(mesh.te_arcsec));
  const from_datum = (te) => (is_number(te) ? te - datum : null);
  const curves = pairs.map((pair, i) => ({
    label: `pair ${fmt(pair.tooth)}`,
    points: pair_points(pair, (position) => from_datum(position.te_arcsec)),
    colour: sequence_colour(i),
    width: 1.6,
    dashed: i >= SEQUENCES.light.length,
    order: 2,
  }));
  const phi = list(mesh.phi1_deg), te = list(mesh.te_arcsec).map(from_datum);
  const transfers = transfer_points(mesh).map((transfer) => ({ ...transfer, y: from_datum(transfer.y) }));
  const margin = 0.02 * (maximum(phi) - minimum(phi));
  const closing = phi.length > 1 && pitch > 0 ? [{ x: phi[0] + pitch, y: te[0] }] : [];
  const points = [...phi.map((x, i) => ({ x, y: te[i] })), ...closing, ...transfers].filter((p) => is_number(p.x)).sort((a, b) => a.x - b.x);
  curves.push({ label: "mesh", points: points.map(({ x, y }) => ({ x, y })), colour: css_colour("ink"), width: 3, order: 1 });
  if (transfers.length) {
    curves.push({ label: "transfer point", points: transfers, colour: css_colour("ink"), fill: css_colour("surface"),
      scatter: true, hollow: true, size: 5, order: 0 });
  }
  xy_chart(plot, {
    label: "Unloaded transmission error",
    curves,
    x: "pinion rotation φ₁ [deg]", y: datum === 0 ? "TE at the wheel [arcsec]" : `TE from ${fmt(datum, 6)} arcsec [arcsec]`,
    x_range: points.length > 1 ? { min: points[0].x - margin, max: points[points.length - 1].x + margin } : {},
    y_range: te_range(te, curves.slice(0, pairs.length).flatMap((curve) => curve.points.map((p) => p.y))),
    read_x: (x) => `φ₁ ${fmt(x)}°`, read_y: (y) => `${fmt(y, 3)} arcsec`, nearest: "xy", height,
    labels: transfers.filter((transfer) => is_number(transfer.jump)).sort((a, b) => b.jump - a.jump)
      .map((transfer) => ({ x: transfer.x, y: transfer.y, text: `slope jumps by ${fmt(transfer.jump, 3)} arcsec/deg` })),
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

const largest_jump = (scene) => maximum(list(record(scene.mesh).transfers).map((t) => record(t).slope_jump_arcsec_per_deg));

function transfer_words(scene, speed_ratio) {
  const count = list(record(scene.mesh).transfers).length;
  if (count === 0) return "The contact passes from pair to pair without a slope jump.";
  const jump = largest_jump(scene);
  if (!is_number(jump)) return `${plural(count, "transfer point")} a pitch.`;
  // arcsec of the wheel per degree of the pinion, relative to the wheel's mean speed
  const step = is_number(speed_ratio) ? ` The wheel's speed steps up by ${fmt((100 * jump) / 3600 / speed_ratio, 2)} % there.` : "";
  return `${plural(count, "transfer point")} a pitch; the slope of the transmission error jumps by up to `
    + `${fmt(jump, 3)} arcsec/deg.${step}`;
}

function parabola_words(parabola) {
  const { wanted_arcsec_per_deg2: wanted, found_arcsec_per_deg2: found, shift_deg: shift, residual_arcsec: residual } = parabola;
  if (!parabola.holds) return `The designed parabola is not achieved: ${parabola.why || "no reason is stored"}.`;
  const centred = Math.abs(shift) < 0.001;  // deg: smaller shifts cannot be manufactured or measured
  const vertex = centred ? "in" : `${fmt(Math.abs(shift), 2)}° ${shift < 0 ? "before" : "after"}`;
  const kept = residual < 0.001 ? "below 0.001" : fmt(residual, 2);  // arcsec
  return `The designed parabola is achieved: a = ${fmt(found, 3)} arcsec/deg² (designed ${fmt(wanted, 3)}), vertex `
    + `${vertex} the middle of the mesh, residual ${kept} arcsec.`;
}

function draw_words(plot, scene, speed_ratio) {
  const say = (label, text, name) => el("li", { class: name }, el("strong", {}, `${label}: `), text);
  const parabola = scene.parabolic_te ? record(scene.parabolic_te) : null;
  plot.append(el("ul", { class: "notes" },
    say("A pair through the mesh", sequence_words(scene.sequence)),
    say("While it leads", sequence_words(scene.carrying_sequence)),
    say("Transfer point", transfer_words(scene, speed_ratio)),
    parabola ? say("Parabola", parabola_words(parabola), parabola.holds ? "good" : "bad") : null));
}

function scene_table(body, scenes) {
  const has_parabola = scenes.some(({ data }) => data.parabolic_te);
  table(body, {
    title: "Unloaded contact in numbers",
    columns: [{ label: "Scene" }, { label: "TE peak to peak", unit: "arcsec" }, { label: "1st harmonic", unit: "arcsec" },
      { label: "Transfer points" }, { label: "Slope jump", unit: "arcsec/deg", digits: 3 },
      { label: "Pinion marked", unit: "%", digits: 3 }, { label: "Wheel marked", unit: "%", digits: 3 },
      ...(has_parabola ? [{ label: "Parabola" }] : []), { label: "Contact of the leading pair" }],
    rows: scenes.map(({ label, data }) => {
      const mesh = record(data.mesh), pattern = record(data.bearing_pattern), parabola = record(data.parabolic_te);
      const jump = largest_jump(data);
      const verdict = { text: parabola.holds ? "achieved" : data.parabolic_te ? "not achieved" : "–",
        class: parabola.holds ? "good" : data.parabolic_te ? "bad" : "off" };
      return [label, mesh.peak_to_peak_arcsec ?? null, list(mesh.harmonics_arcsec)[0] ?? null, list(mesh.transfers).length,
        is_number(jump) ? jump : null, record(pattern.pinion).covered_percent ?? null,
        record(pattern.wheel).covered_percent ?? null, ...(has_parabola ? [verdict] : []),
        sequence_words(data.carrying_sequence)];
    }),
  });
}

function build_unloaded(results, body) {
  const scenes = unloaded_scenes(results);
  const selection = case_selection(scenes, worst_unloaded(scenes), scenes.length > 1 ? " (largest TE)" : "");
  const teeth = (gear) => record(record(results.geometry)[gear]).teeth;
  const speed_ratio = teeth("pinion") / teeth("wheel");
  selection.add_choice(body);
  const grid = figure_grid(body);
  case_figure(grid, selection, {
    title: "Contact in words",
    wide: true,
    caption: "Kinds of contact in the order of a tooth pair's run through the mesh, the transfer from pair to pair, and the check of a "
      + "predesigned parabolic transmission error.",
  }, (plot, { data }) => draw_words(plot, data, speed_ratio));
  case_figure(grid, selection, {
    title: "Path of contact",
    wide: true,
    caption: "Contact point of one tooth pair on both flanks, tip at the top, arrows in the direction of motion. The path is bold where the pair "
      + "leads. Marks on the outline are edge contact. Each axis has its own scale.",
  }, (plot, { data }) => draw_contact_paths(plot, results, data));
  case_figure(grid, selection, {
    title: "Unloaded transmission error",
    wide: true,
    caption: "Thin lines are single tooth pairs; the bold line of the mesh follows the leading pair. At a transfer point two "
      + "pairs cross and the slope jumps. Values are negative where material is removed.",
  }, (plot, { data }) => draw_unloaded_te(plot, data, 360 / teeth("pinion")));
  if (scenes.some(({ data }) => data.bearing_pattern)) {
    for (const gear of ["pinion", "wheel"]) {
      case_figure(grid, selection, {
        title: `Bearing pattern of the ${gear}`,
        caption: "Smallest separation of the flanks on a run through the mesh. The contour line is the edge of the pattern that the marking "
          + "compound shows. Outlines are contact ellipses for the same thickness, dots are contact at other edges than the tips', which have marks of their own. Blank areas are "
          + "further apart than three times the thickness.",
      }, (plot, { data }) => draw_pattern(plot, results, data, gear));
    }
  }
  if (scenes.some(({ data }) => maximum(list(record(data.mesh).harmonics_arcsec)) > 0)) {
    case_figure(grid, selection, {
      title: "Harmonics of the unloaded transmission error",
      wide: true,
      caption: "Amplitudes of the mesh curve at multiples of the tooth-mesh frequency, at the wheel.",
    }, (plot, { data }) => mesh_harmonics(plot, record(data.mesh)));
  }
  scene_table(body, scenes);
}

add_sections({ unloaded: build_unloaded });

// Contact stress and line load on the pinion flank: the envelope over the mesh cycle, painted point by point.

/** All contact points of a mesh cycle on the pinion flank: [{z, r, value, phase, tooth}]. */
function contact_points(entry, key) {
  const points = [];
  for (const position of list(record(entry).cycle).map(record)) {
    for (const tooth of list(position.teeth).map(record)) {
      const columns = record(tooth.points);
      list(columns[key]).forEach((value, i) => {
        const z = list(columns.z_mm)[i], r = list(columns.pinion_radius_mm)[i];
        if (is_number(value) && is_number(z) && is_number(r)) {
          points.push({ z, r, value, phase: position.phase, tooth: tooth.tooth });
        }
      });
    }
  }
  return points;
}

/** Typical spacing of neighbouring points on the flank, along the face width and along the radius [mm]. */
function point_spacing(points, area) {
  const steps = [];
  for (let i = 1; i < points.length; ++i) {
    const same_line = points[i].phase === points[i - 1].phase && points[i].tooth === points[i - 1].tooth;
    const step = Math.abs(points[i].z - points[i - 1].z);
    if (same_line && step > 0) steps.push(step);
  }
  steps.sort((a, b) => a - b);
  const width = area.z[1] - area.z[0], depth = area.r[1] - area.r[0];
  const dz = steps.length ? steps[Math.floor(steps.length / 2)] : width;
  return { dz, dr: Math.min(depth, Math.max(depth / 60, (width * depth) / (points.length * dz))) };
}

/**
 * Every raster cell carries the point nearest to it, distances counted in point spacings; cells further than `reach`
 * spacings from any point stay empty. Of points at the same place the larger value counts. A bare point yields to a
 * loaded one within a spacing: tip edges that hover over a flank outside the path of contact do not hide what the flank carries.
 */
function nearest_points(points, area, columns = 240, rows = 120, reach = 1.6) {
  const { dz, dr } = point_spacing(points, area);
  const cell_z = (area.z[1] - area.z[0]) / columns, cell_r = (area.r[1] - area.r[0]) / rows;
  const owner = new Array(columns * rows).fill(null);
  const distance = new Float64Array(columns * rows).fill(Infinity);
  const clamp = (x, count) => Math.min(Math.max(x, 0), count);
  for (const point of points) {
    const first = clamp(Math.floor((point.z - reach * dz - area.z[0]) / cell_z), columns);
    const last = clamp(Math.ceil((point.z + reach * dz - area.z[0]) / cell_z), columns);
    const bottom = clamp(Math.floor((point.r - reach * dr - area.r[0]) / cell_r), rows);
    const top = clamp(Math.ceil((point.r + reach * dr - area.r[0]) / cell_r), rows);
    for (let row = bottom; row < top; ++row) {
      for (let column = first; column < last; ++column) {
        const across = (area.z[0] + (column + 0.5) * cell_z - point.z) / dz;
        const up = (area.r[0] + (row + 0.5) * cell_r - point.r) / dr;
        const apart = across * across + up * up;
        const cell = row * columns + column;
        if (apart > reach * reach) continue;
        const d = point.value > 0 ? apart : apart + 1;
        // Closer than a hundredth of a spacing counts as the same place.
        const same_place = Math.abs(d - distance[cell]) < 1e-4;
        if (same_place ? point.value > owner[cell].value : d < distance[cell]) {
          distance[cell] = d;
          owner[cell] = point;
        }
      }
    }
  }
  return { columns, rows, owner, values: owner.map((point) => (point ? point.value : null)) };
}

/** Rectangle of the flank that the points span; a single line gets half a millimetre on both sides. */
function area_of(points) {
  const range = (values) => {
    const low = minimum(values), high = maximum(values);
    return high > low ? [low, high] : [low - 0.5, high + 0.5];
  };
  return { z: range(points.map((p) => p.z)), r: range(points.map((p) => p.r)) };
}

const raster_index = (x, range, count) =>
  Math.min(count - 1, Math.floor((count * (x - range[0])) / (range[1] - range[0])));

function draw_flank_load(plot, selection, quantity) {
  const load_case = selection.current;
  const designs = designs_of(load_case);
  const clouds = designs.map((design) => contact_points(load_case.designs[design], quantity.key));
  const all = clouds.flat();
  if (all.length === 0) {
    plot.append(el("p", { class: "empty" }, "No contact points are stored for this load case."));
    return;
  }
  const area = area_of(all);
  const scale = { low: 0, high: maximum(all.map((p) => p.value)) || 1 };
  const maps = designs.map((design, i) => {
    const raster = nearest_points(clouds[i], area);
    const peak = maximum(clouds[i].map((p) => p.value));
    const read = (z, r) => {
      const column = raster_index(z, area.z, raster.columns), row = raster_index(r, area.r, raster.rows);
      const point = raster.owner[row * raster.columns + column];
      if (!point) return "no point near";
      const where = `phase ${fmt(point.phase)}, tooth ${fmt(point.tooth)}`;
      return point.value > 0 ? `${fmt(point.value)} ${quantity.unit} (${where})` : `bare (${where})`;
    };
    const label = DESIGN_LABEL[design];
    return { name: label.toLowerCase(), title: `${label}, peak ${fmt(peak, 3)} ${quantity.unit}`, raster, read };
  });
  flank_maps(plot, { maps, area, scale, unit: quantity.unit, r_title: "pinion radius [mm]", bare_zero: true });
}

function build_flank_load(results, body, selection) {
  selection.add_choice(body);
  const grid = figure_grid(body);
  const paired = selection.cases.some((load_case) => designs_of(load_case).length > 1);
  const scale = paired ? " Both maps share one scale." : "";
  const quantities = [
    { key: "contact_stress_MPa", unit: "MPa", title: "Contact stress on the pinion flank",
      caption: "Largest Hertzian pressure that each place of the flank meets during the mesh cycle; each cell is one "
        + `quadrature point of a contact line, grey is never loaded.${scale}` },
    { key: "load_N_per_mm", unit: "N/mm", title: "Line load on the pinion flank",
      caption: "Load per unit length of contact line over the whole field of contact; a ridge towards one face end is "
        + `misalignment that the flanks do not take up.${scale}` },
  ];
  for (const quantity of quantities) {
    case_figure(grid, selection, { title: quantity.title, caption: quantity.caption, wide: paired },
      (plot) => draw_flank_load(plot, selection, quantity));
  }
}

// Contact points of a mesh cycle on the pinion flank, and the raster in which each cell has the value of the point nearest to it.

/**
 * All contact points of a mesh cycle: [{z, r, value, phase, tooth, tip_edge, edge_stress}]; tip_edge is the gear whose tip edge contact reaches, or null.
 * @param values_of  (position, columns of one tooth's points) -> values of a quantity; points without a number are left out
 */
function contact_points(entry, values_of) {
  const points = [];
  for (const position of list(record(entry).cycle).map(record)) {
    for (const tooth of list(position.teeth).map(record)) {
      const columns = record(tooth.points);
      values_of(position, columns).forEach((value, i) => {
        const z = list(columns.z_mm)[i], r = list(columns.pinion_radius_mm)[i];
        if (is_number(value) && is_number(z) && is_number(r)) {
          points.push({ z, r, value, phase: position.phase, tooth: tooth.tooth, tip_edge: list(columns.tip_edge)[i] ?? null,
            edge_stress: list(columns.edge_stress_MPa)[i] ?? null });
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
 * Every raster cell has the value of the point nearest to it, distances counted in point spacings; cells further than `reach`
 * spacings from any point stay empty. Among coincident points the higher-ranking one counts. An unloaded point is replaced by another
 * within a spacing: tip edges over a flank outside the path of contact do not hide the load on the flank.
 * @param is_bare   value -> whether its point is unloaded
 * @param outranks  (a, b) -> whether value a ranks above b
 */
function nearest_points(points, area, { is_bare, outranks }, columns = 240, rows = 120, reach = 1.6) {
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
        const d = is_bare(point.value) ? apart + 1 : apart;
        // Points closer than a hundredth of a spacing coincide.
        const coincide = Math.abs(d - distance[cell]) < 1e-4;
        if (coincide ? outranks(point.value, owner[cell].value) : d < distance[cell]) {
          distance[cell] = d;
          owner[cell] = point;
        }
      }
    }
  }
  return { columns, rows, owner, values: owner.map((point) => (point ? point.value : null)), is_bare };
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


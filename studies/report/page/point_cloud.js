// Contact points of a mesh cycle on the pinion flank, and the raster of their values between the contact lines.

/**
 * All contact points of a mesh cycle: [{z, r, value, phase, tooth, tip_edge, edge_stress}]; tip_edge is the gear whose tip edge contact reaches, or null.
 * @param values_of  (position, columns of one tooth's points) -> values of a quantity; points without a number are left out
 * @param radius  column of the radius: that of the pinion's flank or of the wheel's
 */
function contact_points(entry, values_of, radius = "pinion_radius_mm") {
  const points = [];
  for (const position of list(record(entry).cycle).map(record)) {
    for (const tooth of list(position.teeth).map(record)) {
      const columns = record(tooth.points);
      values_of(position, columns).forEach((value, i) => {
        const z = list(columns.z_mm)[i], r = list(columns[radius])[i];
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

/** The contact lines that sweep one flank, in their order: each the points of a tooth at a phase, by face width; {place, points}. */
function swept_lines(points) {
  const lines = new Map();
  for (const point of points) {
    const key = `${point.phase} ${point.tooth}`;
    if (!lines.has(key)) lines.set(key, { place: point.phase + point.tooth, points: [] });
    lines.get(key).points.push(point);
  }
  for (const line of lines.values()) line.points.sort((a, b) => a.z - b.z);
  return [...lines.values()].sort((a, b) => a.place - b.place);
}

/** A point at a share of the face width that a line covers, between its two neighbours there. */
function along_line({ points }, share) {
  if (points.length === 1) return { ...points[0], owner: points[0] };
  const z = points[0].z + share * (points[points.length - 1].z - points[0].z);
  let i = 0;
  while (i + 2 < points.length && points[i + 1].z < z) ++i;
  const [a, b] = [points[i], points[i + 1]], t = b.z > a.z ? Math.min(1, Math.max(0, (z - a.z) / (b.z - a.z))) : 0, mix = (key) => a[key] + t * (b[key] - a[key]);
  return { z: mix("z"), r: mix("r"), value: mix("value"), owner: t < 0.5 ? a : b };
}

/**
 * Values between contact lines that follow each other, linear in between. Places that several lines sweep have the highest-ranking value; unloaded
 * ones do not hide loaded ones: tip edges over a flank outside the path of contact. Where no lines follow each other closely enough, cells have the
 * value of the nearest point.
 * @param is_bare   value -> whether its point is unloaded
 * @param outranks  (a, b) -> whether value a ranks above b
 */
function flank_raster(points, area, { is_bare, outranks }, columns = 240, rows = 120) {
  const furthest = 0.26, lines = swept_lines(points);  // base pitches: four positions over a mesh cycle
  const strips = lines.slice(1).map((line, i) => [lines[i], line]).filter(([a, b]) => b.place > a.place && b.place - a.place < furthest);
  if (strips.length < 2) return nearest_points(points, area, { is_bare, outranks }, columns, rows);
  const owner = new Array(columns * rows).fill(null), values = new Array(columns * rows).fill(null);
  const to_column = (z) => (columns * (z - area.z[0])) / (area.z[1] - area.z[0]) - 0.5;
  const to_row = (r) => (rows * (r - area.r[0])) / (area.r[1] - area.r[0]) - 0.5;
  const put = (cell, value, point) => {
    const known = values[cell];
    const better = known === null || (is_bare(known) !== is_bare(value) ? is_bare(known) : outranks(value, known));
    if (!better) return;
    values[cell] = value;
    owner[cell] = point;
  };
  const fill = (corners) => {
    const [a, b, c] = corners.map((corner) => ({ ...corner, x: to_column(corner.z), y: to_row(corner.r) }));
    const twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (Math.abs(twice) < 1e-9) return;
    const rim = 0.75;  // of a cell: neighbouring triangles leave none between them, and borders lose none
    const from = (key) => Math.max(0, Math.ceil(Math.min(a[key], b[key], c[key]) - rim));
    const to = (key, count) => Math.min(count - 1, Math.floor(Math.max(a[key], b[key], c[key]) + rim));
    const longest = Math.max(Math.hypot(b.x - a.x, b.y - a.y), Math.hypot(c.x - b.x, c.y - b.y), Math.hypot(a.x - c.x, a.y - c.y));
    const slack = (rim * longest) / Math.abs(twice);
    for (let y = from("y"); y <= to("y", rows); ++y) {
      for (let x = from("x"); x <= to("x", columns); ++x) {
        const of_b = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / twice, of_c = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / twice;
        const shares = [1 - of_b - of_c, of_b, of_c];
        if (shares.some((share) => share < -slack)) continue;
        const kept = shares.map((share) => Math.max(0, share)), sum = kept[0] + kept[1] + kept[2];
        const value = (kept[0] * a.value + kept[1] * b.value + kept[2] * c.value) / sum;
        put(y * columns + x, value, [a, b, c][kept.indexOf(Math.max(...kept))].owner);
      }
    }
  };
  for (const [a, b] of strips) {
    const steps = Math.max(2, a.points.length, b.points.length);
    for (let k = 0; k + 1 < steps; ++k) {
      const [from, to] = [k / (steps - 1), (k + 1) / (steps - 1)];
      const [p, q, u, v] = [along_line(a, from), along_line(a, to), along_line(b, from), along_line(b, to)];
      fill([p, q, u]);
      fill([q, v, u]);
    }
  }
  return { columns, rows, owner, values, is_bare };
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


// The bearing pattern: the area from which a marking compound is wiped off, and the contact ellipses along the path.

/** Separations beyond this multiple of the compound's thickness are left blank. */
const PATTERN_REACH = 3;

/** Outline of a contact ellipse on one gear's flank [{z, r}]; a line where the ellipse has no end. */
function ellipse_outline(station, gear, reach) {
  const ellipse = record(station.ellipse), point = point_on(station, gear);
  const major = record(record(ellipse.major)[gear]), minor = record(record(ellipse.minor)[gear]);
  if (!point || !is_number(ellipse.semi_minor_mm) || ![major.radius, major.z, minor.radius, minor.z].every(is_number)) {
    return null;
  }
  const along = is_number(ellipse.semi_major_mm) ? ellipse.semi_major_mm : Infinity;
  const at = (a, b) => ({ z: point.z + a * major.z + b * minor.z, r: point.r + a * major.radius + b * minor.radius });
  if (along > 4 * reach) {
    const b = ellipse.semi_minor_mm, a = 4 * reach;
    return { closed: true, points: [at(-a, -b), at(a, -b), at(a, b), at(-a, b)] };
  }
  const points = [];
  for (let k = 0; k < 48; ++k) {
    const angle = (2 * Math.PI * k) / 48;
    points.push(at(along * Math.cos(angle), ellipse.semi_minor_mm * Math.sin(angle)));
  }
  return { closed: true, points };
}

/** Every n-th station of the leading pair, about `count` of them, always with the first and the last. */
function spread(stations, count) {
  if (stations.length <= count) return stations;
  return Array.from({ length: count }, (_, k) => stations[Math.round((k * (stations.length - 1)) / (count - 1))]);
}

function outline(pen, trace) {
  pen.beginPath();
  trace();
  pen.strokeStyle = "rgba(0,0,0,.55)";
  pen.lineWidth = 2.6;
  pen.stroke();
  pen.strokeStyle = "#fff";
  pen.lineWidth = 1.2;
  pen.stroke();
}

function draw_ellipses(pen, stations, gear, reach, to_x, to_y) {
  for (const station of stations) {
    const ellipse = ellipse_outline(station, gear, reach);
    const point = point_on(station, gear);
    if (ellipse) {
      outline(pen, () => {
        ellipse.points.forEach((p, i) => (i ? pen.lineTo(to_x(p.z), to_y(p.r)) : pen.moveTo(to_x(p.z), to_y(p.r))));
        pen.closePath();
      });
    } else if (point) {
      outline(pen, () => pen.arc(to_x(point.z), to_y(point.r), 3, 0, 2 * Math.PI));
    }
  }
}

function draw_pattern(plot, results, scene, gear) {
  const all = record(scene.bearing_pattern), pattern = record(all[gear]), thickness = all.marking_thickness_um;
  const grid = { z: numbers(pattern.z_mm), r: numbers(pattern.radius_mm), rows: list(pattern.separation_um) };
  if (grid.z.length < 2 || grid.r.length < 2 || grid.rows.length !== grid.r.length || !is_number(thickness)) {
    plot.append(el("p", { class: "empty" }, "No bearing pattern is stored for this scene."));
    return;
  }
  const area = { z: [grid.z[0], grid.z[grid.z.length - 1]], r: [grid.r[0], grid.r[grid.r.length - 1]] };
  const scale = { low: 0, high: PATTERN_REACH * thickness };
  const raster = grid_raster(grid, area);
  raster.values = raster.values.map((value) => (is_number(value) && value <= scale.high ? value : null));
  const run = pair_run(scene, record(record(results.geometry).pinion).teeth), carrying = run.filter((station) => station.carries);
  const marked = spread(carrying.filter((station) => !TIP_KINDS.has(station.contact)), 5);
  const edges = run.filter((station) => TIP_KINDS.has(station.contact))
    .map((station) => ({ ...point_on(station, gear), kind: station.contact, filled: station.carries })).filter((mark) => is_number(mark.z));
  flank_maps(plot, {
    maps: [{
      name: gear,
      title: `${capital(gear)}, ${fmt(pattern.covered_percent, 3)} % of the flank marked`,
      raster,
      read: (z, r) => {
        const separation = grid_value(grid, z, r);
        return separation === null ? "never near the mate" : `${fmt(separation, 3)} µm apart at the closest`;
      },
      overlay: (pen, to_x, to_y) => {
        draw_contours(pen, grid, [thickness], to_x, to_y);
        draw_ellipses(pen, marked, gear, area.z[1] - area.z[0], to_x, to_y);
      },
      marks: (pen, to_x, to_y) => draw_edge_marks(pen, edges, to_x, to_y),
    }],
    area, scale, unit: "µm", r_title: `${gear} radius [mm]`,
  });
  const kinds = [...TIP_KINDS].filter((kind) => edges.some((mark) => mark.kind === kind));
  if (kinds.length > 0) mark_legend(plot, kinds.map((kind) => [mark_sample(kind), `${kind_words(kind)}, filled where the pair leads`]));
}

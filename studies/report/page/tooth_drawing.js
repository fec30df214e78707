// The pair in the transverse section, and its geometry in numbers.

/** Half tooth angle at the radius, measured from the tooth's centre line [rad], interpolated on the profile. */
function half_angle(profile, radius) {
  const points = list(profile.x_mm).map((x, i) => [x, list(profile.y_mm)[i]])
    .filter(([x, y]) => is_number(x) && is_number(y) && x >= 0)
    .map(([x, y]) => ({ r: Math.hypot(x, y), angle: Math.atan2(x, y) }))
    .sort((a, b) => a.r - b.r);
  for (let i = 1; i < points.length; ++i) {
    const [a, b] = [points[i - 1], points[i]];
    if (radius < a.r || radius > b.r || b.r === a.r) continue;
    return a.angle + ((b.angle - a.angle) * (radius - a.r)) / (b.r - a.r);
  }
  return null;
}

/** Outline of a tooth and `count` more on each side, turned by `turn` (counter-clockwise), as a path at the centre. */
function teeth_path(gear, turn, count, centre, flip) {
  const profile = record(gear.profile);
  const tooth = list(profile.x_mm).map((x, i) => [x, list(profile.y_mm)[i]]);
  const commands = [];
  // Teeth run clockwise like the points of one tooth do from left to right.
  for (let k = -count; k <= count; ++k) {
    const angle = turn - (2 * Math.PI * k) / gear.teeth + (flip ? Math.PI : 0);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    for (const [x, y] of tooth[0][0] > 0 ? [...tooth].reverse() : tooth) {
      const at = [c * x - s * y + centre[0], s * x + c * y + centre[1]];
      commands.push(`${commands.length ? "L" : "M"}${at[0].toFixed(3)} ${(-at[1]).toFixed(3)}`);
    }
  }
  return commands.join("");
}

/**
 * Both gears in contact at the pitch point: the pinion below with its centre at the origin, the wheel above it.
 * The pinion's tooth lies right of the line of centres and touches with its left flank.
 */
function draw_teeth(plot, geometry) {
  const pinion = record(geometry.pinion), wheel = record(geometry.wheel);
  const a = geometry.centre_distance_mm;
  const r_w = [a * pinion.teeth, a * wheel.teeth].map((x) => x / (pinion.teeth + wheel.teeth));
  const angles = [half_angle(record(pinion.profile), r_w[0]), half_angle(record(wheel.profile), r_w[1])];
  if (!angles.every(is_number)) {
    plot.append(el("p", { class: "empty" }, "The profiles do not reach the pitch circle."));
    return;
  }
  const pitch = (2 * Math.PI * r_w[0]) / pinion.teeth;
  const half_width = 1.9 * pitch, half_height = 0.95 * pitch;
  const view = [-half_width, -r_w[0] - half_height, 2 * half_width, 2 * half_height];
  const line = 0.006 * pitch;
  const picture = svg("svg", { viewBox: view.join(" "), class: "teeth", role: "img",
    "aria-label": "Tooth pair in mesh" });
  const circle = (cy, diameter, name) => svg("circle", { cx: 0, cy: -cy, r: diameter / 2, class: name,
    "stroke-width": line, "stroke-dasharray": name === "pitch-circle" ? `${5.5 * line} ${3.5 * line}` : `${1.2 * line} ${2.4 * line}` });
  const close = (gear, centre) => ` L 0 ${-centre} Z`;

  // A tooth is centred at +y: turning by the half angle brings its left flank onto the line of centres.
  picture.append(
    svg("path", { d: teeth_path(pinion, -angles[0], 4, [0, 0], false) + close(pinion, 0), class: "pinion",
      "stroke-width": 2 * line }),
    svg("path", { d: teeth_path(wheel, -angles[1], 4, [0, a], true) + close(wheel, a), class: "wheel",
      "stroke-width": 2 * line }));
  for (const [gear, cy, r] of [[pinion, 0, r_w[0]], [wheel, a, r_w[1]]]) {
    picture.append(circle(cy, 2 * r, "pitch-circle"), circle(cy, gear.base_diameter_mm, "base-circle"));
  }
  const alpha = (geometry.working_transverse_pressure_angle_deg * Math.PI) / 180;
  if (is_number(alpha)) {
    const on_line = (t) => [-t * Math.cos(alpha), r_w[0] + t * Math.sin(alpha)];
    const [from, to] = [on_line(-r_w[0] * Math.sin(alpha)), on_line(r_w[1] * Math.sin(alpha))];
    picture.append(svg("line", { x1: from[0], y1: -from[1], x2: to[0], y2: -to[1], class: "line-of-action",
      "stroke-width": 2 * line }));
  }
  picture.append(svg("circle", { cx: 0, cy: -r_w[0], r: 3.5 * line, class: "pitch-point" }));
  // Below and above the pitch point, on the gear bodies and clear of the teeth.
  const words_at = (y, text, name) => svg("text", { x: 0, y: -y, class: name, "text-anchor": "middle",
    style: `font-size:${(0.1 * pitch).toFixed(3)}px` }, text);
  picture.append(words_at(r_w[0] - 0.85 * half_height, `pinion, ${pinion.teeth} teeth`, "name"),
    words_at(r_w[0] + 0.85 * half_height, `wheel, ${wheel.teeth} teeth`, "name"));
  plot.append(picture);
}

const GEAR_ROWS = [
  ["Teeth", "teeth", ""], ["Hand of helix", "hand", ""], ["Reference diameter", "reference_diameter_mm", "mm"],
  ["Base diameter", "base_diameter_mm", "mm"], ["Tip diameter", "tip_diameter_mm", "mm"],
  ["Tooth thickness allowance E_sn", "tooth_thickness_allowance_um", "µm"], ["Generating profile shift x_E", "generating_profile_shift", ""],
  ["Root diameter", "root_diameter_mm", "mm"], ["Root form diameter", "form_diameter_mm", "mm"],
  ["Active root diameter", "active_root_diameter_mm", "mm"], ["Tip thickness", "tip_thickness_mm", "mm"],
  ["Undercut", "undercut", ""],
];

const PAIR_ROWS = [
  ["Centre distance", "centre_distance_mm", "mm"], ["Circumferential backlash j_wt", "backlash_um", "µm"],
  ["Normal backlash j_bn", "normal_backlash_um", "µm"], ["Radial backlash j_r", "radial_backlash_um", "µm"],
  ["Working transverse pressure angle", "working_transverse_pressure_angle_deg", "deg"],
  ["Base helix angle", "base_helix_angle_deg", "deg"], ["Transverse base pitch", "transverse_base_pitch_mm", "mm"],
  ["Transverse contact ratio ε_α", "transverse_contact_ratio", ""], ["Overlap ratio ε_β", "overlap_ratio", ""],
  ["Total contact ratio ε_γ", "total_contact_ratio", ""],
];

function build_gear_pair(results, body) {
  const geometry = record(results.geometry), pinion = record(geometry.pinion), wheel = record(geometry.wheel);
  if (list(record(pinion.profile).x_mm).length > 2 && list(record(wheel.profile).x_mm).length > 2
      && is_number(geometry.centre_distance_mm)) {
    figure(figure_grid(body), {
      title: "The pair in mesh",
      wide: true,
      caption: "Transverse section at mid face, in contact at the pitch point, with pitch circles (dashed), base "
        + "circles (dotted) and the line of action.",
    }, (plot) => draw_teeth(plot, geometry));
  }
  build_bodies(results, body);
  build_unit(results, body);
  const pair = el("div", { class: "tables" });
  body.append(pair);
  table(pair, {
    title: "Gears",
    columns: [{ label: "Quantity" }, { label: "Pinion", digits: 7 }, { label: "Wheel", digits: 7 }, { label: "Unit" }],
    rows: GEAR_ROWS.filter(([, key]) => key in pinion || key in wheel)
      .map(([label, key, unit]) => [{ text: label, draw: () => symbols(label) }, pinion[key] ?? null, wheel[key] ?? null, unit]),
  });
  table(pair, {
    title: "Pair",
    columns: [{ label: "Quantity" }, { label: "Value", digits: 7 }, { label: "Unit" }],
    rows: PAIR_ROWS.filter(([, key]) => key in geometry).map(([label, key, unit]) =>
      [{ text: label, draw: () => symbols(label) }, geometry[key], unit]),
  });
}

add_sections({ "gear-pair": build_gear_pair });

// Half sections of the gear bodies: rim, web and hub.

/** Where a gear's material is in the half section, as boxes: [name, lower z, upper z, inner radius, outer radius]. */
function body_boxes(gear, sizes) {
  const body = record(gear.body), web = body.web === undefined ? null : record(body.web);
  const half = gear.face_width_mm / 2, root = sizes.root_diameter_mm / 2, bore = body.bore_diameter_mm / 2;
  const held = body.hold === "rigid_bore";
  const carrier = held ? bore : body.shaft_diameter_mm / 2;
  const boxes = [["tooth", -half, half, root, sizes.tip_diameter_mm / 2]];
  let reach = half;
  if (web === null) {
    boxes.push(["body", -half, half, carrier, root]);
  } else {
    const underside = root - web.rim_thickness_mm, hub = web.hub_diameter_mm / 2;
    const [middle, half_web] = [web.web_offset_mm, web.web_thickness_mm / 2];
    reach = Math.max(half, web.hub_width_mm / 2);
    boxes.push(["body", -half, half, underside, root], ["body", middle - half_web, middle + half_web, hub, underside],
      ["body", -web.hub_width_mm / 2, web.hub_width_mm / 2, carrier, hub]);
    const holes = record(web.holes);
    if (is_number(holes.diameter_mm)) {
      const [circle, radius] = [holes.circle_diameter_mm / 2, holes.diameter_mm / 2];
      boxes.push(["hole", middle - half_web, middle + half_web, circle - radius, circle + radius]);
    }
  }
  if (!held) boxes.push(["shaft", -reach - body.shaft_overhang_mm, reach + body.shaft_overhang_mm, bore, carrier]);
  return boxes;
}

/** Half section of one gear, its axis below and z to the right. */
function draw_body(plot, name, gear, sizes) {
  const boxes = body_boxes(gear, sizes);
  if (!boxes.every((box) => box.slice(1).every(is_number))) {
    plot.append(el("p", { class: "empty" }, "The body has no complete measures."));
    return;
  }
  const low = Math.min(...boxes.map((box) => box[1])), high = Math.max(...boxes.map((box) => box[2]));
  const top = Math.max(...boxes.map((box) => box[4])), margin = 0.08 * Math.max(top, high - low);
  const line = 0.006 * Math.max(top, high - low);
  const picture = svg("svg", { viewBox: [low - margin, -top - margin, high - low + 2 * margin, top + 2 * margin].join(" "),
    class: "teeth body-section", role: "img", "aria-label": `Half section of the ${name}` });
  for (const [part, from, to, inner, outer] of boxes) {
    picture.append(svg("rect", { x: from, y: -outer, width: to - from, height: outer - inner, class: `${name} ${part}`, "stroke-width": line,
      ...(part === "hole" ? { "stroke-dasharray": `${3 * line} ${2 * line}` } : {}) }));
  }
  picture.append(svg("line", { x1: low - margin, y1: 0, x2: high + margin, y2: 0, class: "pitch-circle", "stroke-width": line,
    "stroke-dasharray": `${8 * line} ${2 * line} ${2 * line} ${2 * line}` }));
  plot.append(picture);
}

/** Draws both bodies where one of them is more than a solid disc on its shaft. */
function build_bodies(results, body) {
  const pair = record(record(results.used).pair), geometry = record(results.geometry);
  const gears = ["pinion", "wheel"].map((name) => ({ name, gear: record(pair[name]), sizes: record(geometry[name]) }));
  const is_plain = (gear) => gear.body === undefined || (record(gear.body).web === undefined && record(gear.body).hold === undefined);
  if (gears.every(({ gear }) => is_plain(gear))) return;
  const grid = figure_grid(body);
  for (const { name, gear, sizes } of gears) {
    if (gear.body === undefined) continue;
    figure(grid, {
      title: `Body of the ${name}`,
      caption: "Half section, axis below, z to the right: teeth, body as its finite elements have it, and shaft. "
        + (record(gear.body).hold === "rigid_bore" ? "The bore is held rigidly. " : "")
        + (record(record(gear.body).web).holes === undefined ? "" : "Dashed: the band that the holes soften."),
    }, (plot) => draw_body(plot, name, gear, sizes));
  }
}

// The optimum compared with designs found without an optimiser: rules of thumb and a full-factorial search.

/** Round numbers from low to high, at most `most`, so few that their labels do not touch on an axis of so many pixels. */
function fitting_ticks(low, high, most, pixels) {
  for (let count = most; count > 1; --count) {
    const ticks = round_ticks(low, high, count), widest = 7.2 * Math.max(...ticks.map((tick) => fmt(tick).length)) + 12;
    if (ticks.length < 2 || widest <= (pixels * (ticks[1] - ticks[0])) / (high - low)) return ticks;
  }
  return low < 0 && high > 0 ? [0] : [low];
}

/** A label in two lines, split at a space, where it has more characters than fit into one. */
function label_lines(label, most) {
  if (label.length <= most + 0.5) return [label];
  const at = label.lastIndexOf(" ", most);
  return at > 0 ? [label.slice(0, at), label.slice(at + 1)] : [label];
}

/**
 * Horizontal bars from zero.
 * @param rows  [{label, value, colour, hollow?, note?}], or several bars in a row: [{label, values, bars: [{value, colour, what}]}];
 *              a missing value leaves its row empty
 * @param limit  longer bars, positive or negative, end there with a break
 */
function draw_bars(plot, { rows, unit, label, limit = Infinity }) {
  const width = Math.max(320, plot.clientWidth || 900), top = 8, bottom = 40, per_character = 7.1;
  const longest = Math.max(...rows.map((row) => row.label.length));
  const left = Math.min(0.6 * width, 20 + per_character * longest), right = 90;
  const lines = rows.map((row) => label_lines(row.label, (left - 20) / per_character));
  const row_height = lines.some((of) => of.length > 1) ? 36 : 24;
  const height = top + bottom + row_height * rows.length;
  const shown = (value) => Math.min(limit, Math.max(-limit, value));
  const values = numbers(rows.flatMap((row) => row.values || [row.value])).map(shown);
  if (values.length === 0) return;
  const low = Math.min(0, minimum(values)), high = Math.max(0, maximum(values)) || 1;
  const to_x = (value) => left + ((width - left - right) * (value - low)) / (high - low || 1);
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, width: "100%", role: "img", "aria-label": label });
  for (const tick of fitting_ticks(low, high, width < 560 ? 4 : 6, width - left - right)) {
    picture.append(svg("line", { x1: to_x(tick), x2: to_x(tick), y1: top, y2: height - bottom, class: "grid-line" }),
      svg("text", { x: to_x(tick), y: height - bottom + 15, "text-anchor": "middle", class: "muted" }, fmt(tick)));
  }
  picture.append(svg("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle", class: "muted" },
    unit ? `[${unit}]` : ""));
  rows.forEach((row, i) => {
    const y = top + row_height * (i + 0.5);
    lines[i].forEach((line, k) => picture.append(svg("text", { x: left - 12, y: y + 4 + 16 * (k - (lines[i].length - 1) / 2), "text-anchor": "end" }, line)));
    const bars = row.bars || [row], thickness = 14 / bars.length;
    bars.forEach((bar, k) => {
      if (!is_number(bar.value)) return;
      const [from, to] = [to_x(Math.min(0, shown(bar.value))), to_x(Math.max(0, shown(bar.value)))];
      picture.append(svg("rect", { x: from, y: y - 7 + k * thickness, width: Math.max(1, to - from), height: thickness,
        rx: 2, fill: bar.colour,
        ...(bar.hollow ? { "fill-opacity": 0.25, stroke: bar.colour } : {}) },
        svg("title", {}, `${row.label}${bar.what ? `, ${bar.what}` : ""}: ${fmt(bar.value)} ${unit}`)));
    });
    const broken = numbers(bars.map((bar) => bar.value)).find((value) => Math.abs(value) > limit);
    if (broken !== undefined) {
      const x = to_x(shown(broken)) - 14 * Math.sign(broken);
      picture.append(svg("path", { d: `M${x - 5},${y + 9} l6,-18 M${x},${y + 9} l6,-18`, class: "bar-break" }));
    }
    const end = Math.max(0, ...numbers(bars.map((bar) => shown(bar.value))));
    if (row.note) picture.append(svg("text", { x: to_x(end) + 8, y: y + 4, class: "muted" }, row.note));
  });
  plot.append(picture);
}

/** Designs that the optimum is compared with: [{name, objective, feasible, kind, basis, design}], best first. */
function compared_designs(optimise) {
  const comparison = record(optimise.comparison);
  const rules = list(comparison.rules).map(record).map((rule) => ({ ...rule, kind: "rule" }));
  const variants = list(comparison.variants).map(record).filter((search) => search.best)
    .map((search) => ({ ...record(search.best), kind: "variants",
      name: `best of ${fmt(search.tried, 7)} variants, ${search.levels_from}` }));
  const order = (design) => (is_number(design.objective) ? design.objective : Infinity);
  return [...rules, ...variants].sort((a, b) => order(a) - order(b));
}

const modifications_in_words = (design) => list(design.modifications).map(record)
  .map((m) => `${words(m.name)} ${fmt(m.value, 3)} ${pretty_unit(m.unit)}`).join(", ") || "none";

function comparison_caption(comparison) {
  const basis = record(comparison.basis);
  const parts = [];
  if (is_number(basis.torque_Nm)) {
    parts.push(`The rules work with the largest torque of the scenes, ${fmt(basis.torque_Nm)} N·m, the largest misalignment, `
      + `${fmt(basis.misalignment_um, 3)} µm, the mean deflection of the unmodified pair, ${fmt(basis.mean_deflection_um, 3)} µm, `
      + `and that of a single pair, ${fmt(basis.single_pair_deflection_um, 3)} µm.`);
  }
  for (const search of list(comparison.variants).map(record)) {
    const levels = Object.values(record(search.levels)).join(" × ");
    parts.push(`Full-factorial search, levels ${search.levels_from}: ${levels} = ${fmt(search.tried, 7)} analyses of all scenes in `
      + `${fmt(search.seconds, 2)} s.`);
  }
  return parts.join(" ");
}

function build_comparison(results, body) {
  const optimise = record(results.optimise), after = record(optimise.after);
  const unit = pretty_unit(optimise.objective_unit), name = words(optimise.objective_name);
  const designs = compared_designs(optimise);
  // Of the design that the others are compared with, over the listed scenes: before gears were drawn where they were.
  const value = record(optimise.comparison).optimum_objective ?? after.objective;
  const note = (other) => percent_change(value, other);
  // Without a design that keeps the constraints the one shown is no optimum.
  const infeasible = optimise.status === "infeasible", shown = infeasible ? "design shown" : "optimum";
  if (optimise.scatter && typeof optimise.assessed_design === "string") body.append(el("p", { class: "fine" }, `The optimum here is ${optimise.assessed_design}.`));
  figure(figure_grid(body), {
    title: `${capital(name)} of the ${shown} and other designs`,
    wide: true,
    caption: `All designs are analysed over the same scenes. A rule may use modifications that the study does not vary. ${comparison_caption(record(optimise.comparison))} Hollow bars violate a constraint.`,
  }, (plot) => draw_bars(plot, {
    label: "Objective of every design compared", unit,
    rows: [{ label: shown, value, colour: design_colour("after"), hollow: infeasible, note: `${fmt(value)} ${unit}` },
      ...designs.map((design) => ({ label: design.name, value: design.objective, hollow: design.feasible === false,
        colour: design.kind === "rule" ? design_colour("before") : sequence_colour(2), note: note(design.objective) }))],
  }));
  table(body, {
    title: "Designs compared",
    columns: [{ label: "Design" }, { label: capital(name), unit }, { label: `Compared with the ${shown}` }, { label: "Constraints met" },
      { label: "Modifications" }, { label: "Basis" }],
    rows: designs.map((design) => [design.name, design.objective ?? null, note(design.objective),
      design.failure ? design.failure : design.feasible ? "yes" : "no", modifications_in_words(design), in_symbols(design.basis || "–")]),
  });
}

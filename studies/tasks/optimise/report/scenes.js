// The optimisation: the objective of every scene, the constraints and the history of the search.

/** Dumbbells: one row a scene, from the value before to the value after. */
function draw_scene_objectives(plot, scenes, unit) {
  const width = Math.max(320, plot.clientWidth || 900), row_height = 26, top = 8, bottom = 40;
  const longest = Math.max(...scenes.map((scene) => scene.label.length));
  const left = Math.min(0.4 * width, 20 + 7 * longest), right = 84;
  const height = top + bottom + row_height * scenes.length;
  const values = numbers(scenes.flatMap((scene) => [scene.before, scene.after]));
  if (values.length === 0) return;
  const low = Math.min(0, minimum(values)), high = maximum(values) || 1;
  const to_x = (value) => left + ((width - left - right) * (value - low)) / (high - low);
  const text = (x, y, content, attributes = {}) => svg("text", { x, y, ...attributes }, content);
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, width: "100%", role: "img",
    "aria-label": "Objective of every scene before and after" });

  for (const tick of round_ticks(low, high, 6)) {
    picture.append(svg("line", { x1: to_x(tick), x2: to_x(tick), y1: top, y2: height - bottom, class: "grid-line" }),
      text(to_x(tick), height - bottom + 15, fmt(tick), { "text-anchor": "middle", class: "muted" }));
  }
  picture.append(text((left + width - right) / 2, height - 6, unit ? `[${unit}]` : "",
    { "text-anchor": "middle", class: "muted" }));
  scenes.forEach((scene, i) => {
    const y = top + row_height * (i + 0.5);
    picture.append(text(left - 12, y + 4, scene.label, { "text-anchor": "end" }));
    const both = is_number(scene.before) && is_number(scene.after);
    if (both) {
      picture.append(svg("line", { x1: to_x(scene.before), x2: to_x(scene.after), y1: y, y2: y, class: "dumbbell" }));
    }
    for (const design of ["before", "after"]) {
      if (!is_number(scene[design])) continue;
      picture.append(svg("circle", { cx: to_x(scene[design]), cy: y, r: 5.5, fill: design_colour(design) },
        svg("title", {}, `${scene.label}, ${design}: ${fmt(scene[design])} ${unit}`)));
    }
    const end = maximum([scene.before, scene.after]);
    const note = both ? percent_change(scene.before, scene.after) : null;
    if (note) picture.append(text(to_x(end) + 12, y + 4, note, { class: "muted" }));
  });
  plot.append(el("p", { class: "key" },
    el("span", { class: "dot", style: `background:${design_colour("before")}` }), " Before   ",
    el("span", { class: "dot", style: `background:${design_colour("after")}` }), " After"), picture);
}

function build_scenes(results, body) {
  const optimise = record(results.optimise);
  const unit = pretty_unit(optimise.objective_unit), name = words(optimise.objective_name);
  const raw = list(optimise.scenes).map(record);
  const known = (value, error) => (is_number(value) && is_number(error) ? { value, text: with_error(value, error, 4) } : value ?? null);
  const label = scene_labels(raw);
  const scenes = raw.map((scene) => ({ ...scene, label: label(scene) }));
  if (scenes.length > 0) {
    figure(figure_grid(body), {
      title: `${capital(name)} of every scene`,
      wide: true,
      caption: `Change of the ${name} by the optimised flanks in each scene; `
        + (optimise.status === "infeasible" ? "the search was for the least excess over the limits, and the objective decided only between designs of the same excess."
          : "a scene that moves to the right becomes worse in favour of the others."),
    }, (plot) => draw_scene_objectives(plot, scenes, unit));
    table(body, {
      title: `${capital(name)} by scene`,
      columns: [{ label: "Scene" }, { label: "Torque", unit: "N·m", digits: 6 }, { label: "Before", unit },
        { label: "After", unit }, { label: "Change" }],
      rows: scenes.map((scene) => [`${scene.name}`, scene.torque_Nm ?? null, known(scene.before, scene.before_error), known(scene.after, scene.after_error),
        percent_change(scene.before, scene.after)]),
    });
  }
  const before = record(record(optimise.before).constraints);
  const rows = constraint_rows(optimise);
  if (rows.length > 0) {
    table(body, {
      title: "Constraints",
      columns: [{ label: "Quantity" }, { label: "Before" }, { label: "After" }, { label: "At least" }, { label: "At most" }, { label: "Unit" },
        { label: "Met" }],
      rows: rows.map((row) => [words(row.name), known(record(before[row.name]).value, record(record(optimise.before).constraints_error)[row.name]),
        known(row.value, record(record(optimise.after).constraints_error)[row.name]),
        row.min ?? null, row.max ?? null, row.unit, { text: row.met === null ? "–" : row.met ? "yes" : "no",
          class: row.met === false ? "bad" : "" }]),
    });
  }
}

function build_convergence(results, body) {
  const optimise = record(results.optimise);
  const history = list(optimise.history).map(record);
  const unit = pretty_unit(optimise.objective_unit);
  const grid = figure_grid(body);
  const violations = numbers(history.map((step) => step.constraint_violation));
  const violated = maximum(violations) > 0;
  figure(grid, {
    title: "Objective over the evaluations",
    wide: !violated,
    caption: "All analyses of the solver, by the scenes that took part; open points violate a constraint.",
  }, (plot) => {
    const points = history.map((step) => ({ x: step.evaluation, y: step.objective }));
    const feasible = (i) => !(history[i].constraint_violation > 0);
    const colour = css_colour("after");
    const curves = [
      { label: "path", points, colour: faded(colour, 0.45), width: 1.2, quiet: true, order: 2 },
      { label: "feasible", points: points.filter((_, i) => feasible(i)), colour, scatter: true },
      { label: "violates a constraint", points: points.filter((_, i) => !feasible(i)), colour: css_colour("before"),
        scatter: true, hollow: true, fill: "transparent" },
    ];
    xy_chart(plot, {
      label: "Objective over the evaluations",
      curves: curves.filter((curve) => curve.points.length > 0),
      x: "evaluation", y: unit ? `objective [${unit}]` : "objective",
      read_x: (x) => `evaluation ${x}`, read_y: (y) => `${fmt(y)} ${unit}`, height: 250,
    });
  });
  if (!violated) return;
  figure(grid, {
    title: "Constraint violation",
    caption: "Largest excess over a limit; zero means that every constraint is met.",
  }, (plot) => xy_chart(plot, {
    label: "Constraint violation over the evaluations",
    curves: [{ label: "violation", colour: css_colour("before"),
      points: history.map((step) => ({ x: step.evaluation, y: step.constraint_violation })) }],
    x: "evaluation", y: "violation", y_range: { beginAtZero: true },
    read_x: (x) => `evaluation ${x}`, read_y: (y) => fmt(y, 3), height: 250,
  }));
}

add_sections({ scenes: build_scenes, convergence: build_convergence });

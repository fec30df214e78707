// How widely an optimum was sought, what rounding it to the grinder's steps costs, and what a gain in one objective costs in another.

function draw_front(plot, front) {
  const [first, second] = list(front.objectives).map(record);
  const named = ({ name, unit }) => `${words(name)} [${pretty_unit(unit)}]`;
  const points = list(front.points).map(record).map((point) => ({ x: point.values[0], y: point.values[1], dominated: point.dominated }));
  const best = points.filter((point) => !point.dominated);
  const colour = css_colour("after");
  const curves = [
    { label: "front", points: best, colour: faded(colour, 0.45), width: 1.2, quiet: true, order: 2 },
    { label: "compromise", points: best, colour, scatter: true, size: 5 },
    { label: "dominated", points: points.filter((point) => point.dominated), colour: css_colour("before"), scatter: true,
      hollow: true, fill: "transparent" },
  ];
  xy_chart(plot, {
    label: "Pareto front",
    curves: curves.filter((curve) => curve.points.length > 0),
    x: named(first), y: named(second), nearest: "xy",
    read_x: (x) => `${words(first.name)} ${fmt(x)} ${pretty_unit(first.unit)}`,
    read_y: (y) => `${words(second.name)} ${fmt(y)} ${pretty_unit(second.unit)}`, height: 320,
  });
}

function front_table(body, front) {
  const paths = Object.keys(record(record(list(front.points)[0]).variables));
  table(body, {
    title: "Compromises",
    columns: [...list(front.objectives).map(record).map(({ name, unit }) => ({ label: capital(words(name)), unit: pretty_unit(unit) })),
      ...paths.map((path) => ({ label: words(path) }))],
    rows: list(front.points).map(record).map((point) => [...point.values, ...paths.map((path) => point.variables[path])]),
    note: "Units of the modifications as in the study.",
  });
}

function build_search(results, body) {
  const optimise = record(results.optimise), unit = pretty_unit(optimise.objective_unit);
  if (optimise.pareto) {
    const front = record(optimise.pareto);
    if (list(front.objectives).length === 2) {
      figure(figure_grid(body), {
        title: "What a gain in one costs in the other",
        wide: true,
        caption: `Each point is a design of its own; none of them is better in both.${front.message ? ` ${capital(front.message)}.` : ""}`,
      }, (plot) => draw_front(plot, front));
    }
    if (list(front.points).length > 0) front_table(body, front);
  }
  if (optimise.rounded) {
    const exact = record(record(optimise.exact).variables), ground = record(record(optimise.rounded).variables);
    table(body, {
      title: "Rounded to what can be ground",
      columns: [{ label: "Modification" }, { label: "Optimum" }, { label: "To grind", digits: 6 }],
      rows: [...Object.keys(ground).map((path) => [words(path), exact[path], ground[path]]),
        [`${words(optimise.objective_name)} [${unit}]`, record(optimise.exact).objective, record(optimise.rounded).objective]],
      note: `Rounding costs ${fmt(record(optimise.rounded).loss_percent)} % of the objective.`,
    });
  }
  const starts = list(optimise.starts).map(record);
  if (starts.length < 2) return;
  const optima = list(optimise.optima).map(record);
  table(body, {
    title: "Optima from several starts",
    columns: [{ label: "Objective", unit }, { label: "Found by" }, ...Object.keys(record(record(optima[0]).variables)).map((path) => ({ label: words(path) }))],
    rows: optima.map((optimum) => [optimum.objective, `${optimum.found_by} of ${starts.length}`, ...Object.values(record(optimum.variables))]),
    note: optimise.multimodal ? "The starts found different optima: the problem is multimodal, and more starts may find a better one."
      : "All starts that ended well found the same optimum.",
  });
}

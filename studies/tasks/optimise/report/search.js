// The starts of a search, the loss by rounding to the grinder's steps, and the Pareto front of several objectives.

/** By how much a point of the front exceeds a limit [%]; 0 where it keeps all of them within the tolerance of the search. */
const beyond_limit = (point) => (point.constraint_violation > 1e-6 ? 100 * point.constraint_violation : 0);

/** The front over two of its objectives, by their indices in the list; with two objectives the points are joined. */
function draw_front(plot, front, [across, up], height = 320) {
  const objectives = list(front.objectives).map(record), [first, second] = [objectives[across], objectives[up]];
  const named = ({ name, unit }) => (pretty_unit(unit) ? `${words(name)} [${pretty_unit(unit)}]` : words(name));
  const points = list(front.points).map(record)
    .map((point) => ({ x: point.values[across], y: point.values[up], dominated: point.dominated, beyond: beyond_limit(point),
      note: [...[across, up].filter((k) => is_number(list(point.errors)[k])).map((k) => `${words(objectives[k].name)} known to ± ${fmt(point.errors[k], 2)}`),
        ...objectives.filter((_, i) => i !== across && i !== up)
        .map((other) => `${words(other.name)} ${fmt(point.values[objectives.indexOf(other)])} ${pretty_unit(other.unit)}`),
        ...(beyond_limit(point) > 0 ? [`beyond a limit by ${fmt(beyond_limit(point), 2)} %`] : [])].join(", ") || null }));
  const best = points.filter((point) => !point.dominated);
  const colour = css_colour("after");
  const curves = [
    { label: "front", points: objectives.length === 2 ? best : [], colour: faded(colour, 0.45), width: 1.2, quiet: true, order: 2 },
    { label: "compromise", points: best.filter((point) => point.beyond === 0), colour, scatter: true, size: 5 },
    { label: "beyond a limit", points: best.filter((point) => point.beyond > 0), colour: css_colour("bad"), scatter: true, size: 5,
      hollow: true, fill: "transparent" },
    { label: "dominated", points: points.filter((point) => point.dominated), colour: css_colour("before"), scatter: true,
      hollow: true, fill: "transparent" },
  ];
  xy_chart(plot, {
    label: "Pareto front",
    curves: curves.filter((curve) => curve.points.length > 0),
    x: named(first), y: named(second), nearest: "xy",
    read_x: (x) => `${words(first.name)} ${fmt(x)} ${pretty_unit(first.unit)}`,
    read_y: (y) => `${words(second.name)} ${fmt(y)} ${pretty_unit(second.unit)}`, height,
  });
}

function front_table(body, front, units) {
  const paths = Object.keys(record(record(list(front.points)[0]).variables));
  const limited = list(front.points).map(record).some((point) => beyond_limit(point) > 0);
  const outputs = Object.entries(record(record(list(front.points)[0]).constraints)).map(([name, raw]) => ({ name, unit: record(raw).unit }));
  const output_of = (point, name) => {
    const { value, least, max } = record(record(point.constraints)[name]);
    return (is_number(max) ? value : least ?? value) ?? null;
  };
  table(body, {
    title: "Compromises",
    columns: [...list(front.objectives).map(record).map(({ name, unit }) => ({ label: capital(words(name)), unit: pretty_unit(unit) })),
      ...paths.map((path) => ({ label: words(path), unit: pretty_unit(units[path]) })), ...outputs.map(({ name, unit }) => ({ label: capital(words(name)), unit: pretty_unit(unit), digits: 4 })),
      ...(limited ? [{ label: "Beyond a limit by", unit: "%" }] : [])],
    rows: list(front.points).map(record).map((point) => [...point.values.map((value, k) => ({ value, text: with_error(value, list(point.errors)[k], 4) })), ...paths.map((path) => settled(point.variables[path], units[path])),
      ...outputs.map(({ name }) => output_of(point, name)), ...(limited ? [beyond_limit(point)] : [])]),
  });
}

/** Start and end of each search, and the different optima. */
function starts_tables(body, optimise, units) {
  const starts = list(optimise.starts).map(record), unit = pretty_unit(optimise.objective_unit);
  if (starts.length === 0) return;
  const paths = Object.keys(record(starts[0].from));
  const of_variables = paths.map((path) => ({ label: words(path), unit: pretty_unit(units[path]), digits: 3 }));
  const ends = starts.some((start) => start.status === "infeasible") ? "a local optimum, or in the least excess over the limits that it found" : "a local optimum";
  const bumpy = /sigma$/.test(optimise.over || "") ? " Mean + kσ has more local optima than the worst case, because it may fall where a single scene rises." : "";
  table(body, {
    title: "Where the searches started",
    note: starts.length === 1 ? `One search was made, from the values of the file. It ends in ${ends}; more starts may find a better one.${bumpy}`
      : `The first search starts from the values of the file, the others from a space-filling set. Each ends in ${ends}.${bumpy}`,
    columns: [{ label: "Start" }, ...of_variables, { label: "Ended at", unit }, { label: "Analyses" }, { label: "Status" }],
    rows: starts.map((start, i) => [i + 1, ...paths.map((path) => settled(record(start.from)[path], units[path])),
      start.objective ?? null, start.evaluations ?? null, words(start.status)]),
  });
  const optima = list(optimise.optima).map(record);
  if (starts.length < 2 || optima.length === 0) return;
  table(body, {
    title: "Optima from several starts",
    note: optimise.multimodal ? "The starts found different optima: the problem is multimodal, and more starts may find a better one."
      : "All converged starts found the same optimum.",
    columns: [{ label: "Found by" }, ...of_variables, { label: "Objective", unit }],
    rows: optima.map((optimum) => [`${optimum.found_by} of ${starts.length}`,
      ...paths.map((path) => settled(record(optimum.variables)[path], units[path])), optimum.objective ?? null]),
  });
}

const objective_row = (name, unit, exact, ground) => [unit ? `${words(name)} [${unit}]` : words(name), exact, { value: ground, text: fmt(ground) }];

function build_search(results, body) {
  const optimise = record(results.optimise), unit = pretty_unit(optimise.objective_unit);
  const units = record(record(optimise.before).variable_units);
  if (optimise.pareto) {
    const front = record(optimise.pareto);
    const names = list(front.objectives).map((objective) => words(record(objective).name));
    const pairs = names.length === 2 ? [[0, 1]] : [[0, 1], [0, 2], [1, 2]];
    const grid = figure_grid(body);
    for (const pair of pairs) {
      figure(grid, {
        title: names.length === 2 ? "What a gain in one costs in the other" : capital(`${names[pair[1]]} against ${names[pair[0]]}`),
        wide: names.length === 2,
        caption: (names.length === 2 ? "Each point is a different design; none of them is better in both."
          : "Every design of the front; none of them is better in all three. Points that look worse here are better in the third objective.")
          + (front.message ? ` ${capital(front.message)}.` : ""),
      }, (plot) => draw_front(plot, front, pair));
    }
    if (list(front.points).length > 0) front_table(body, front, units);
  }
  if (optimise.rounded) {
    const exact = record(record(optimise.exact).variables), ground = record(record(optimise.rounded).variables);
    const loss = record(optimise.rounded).loss_percent, what = list(optimise.grinding_choices).length > 0 ? "What cannot be ground" : "Rounding";
    const stages = list(optimise.stages).map(record), later = (design) => list(record(design).later_objectives);
    table(body, {
      title: list(optimise.grinding_choices).length > 0 ? "Made grindable" : "Rounded to the grinder's steps",
      columns: [{ label: "Modification" }, { label: "Optimum" }, { label: "To grind", digits: 6 }],
      rows: [...Object.keys(ground).map((path) => [`${words(path)} [${pretty_unit(units[path])}]`, settled(exact[path], units[path]), ground[path]]),
        objective_row(optimise.objective_name, unit, record(optimise.exact).objective, record(optimise.rounded).objective),
        ...stages.slice(1).map((stage, i) => objective_row(stage.objective, pretty_unit(stage.unit), later(optimise.exact)[i], later(optimise.after)[i]))],
      note: is_number(loss) ? `${what} ${loss < 0 ? "reduces" : "raises"} the ${stages.length > 1 ? words(optimise.objective_name) : "objective"} by ${fmt(Math.abs(loss), 3)} %.` : undefined,
    });
  }
  starts_tables(body, optimise, units);
}

add_sections({ search: build_search });

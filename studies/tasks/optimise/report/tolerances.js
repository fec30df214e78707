// The search over drawn gears: what it gains, how well it predicts, and what each tolerance class costs.

/** The search over drawn gears that gave the design; null where there was none. */
const scatter_of = (optimise) => (is_number(record(optimise.scatter).value) ? record(optimise.scatter) : null);

/** The statistic of a design ("before", "without scatter", "after") over fresh draws; null without them. */
const fresh_statistic = (scatter, design) => list(record(scatter.fresh).designs).map(record).find(({ name }) => name === design)?.statistic ?? null;

/** The best known statistic of what a limit bounds: what is predicted, or that over the draws of the search. */
const known_value = (limit) => record(limit.predicted).value ?? limit.value;

/** Limits of the statistic that the design exceeds, the most exceeded first: over the draws of the search, or by a prediction by more than draws tell apart. */
function exceeded_over_draws(scatter) {
  const excess = (limit, value) => (is_least(limit) ? limit.min - value : value - limit.max) / Math.abs(bound_of(limit) || 1);
  // Slack for the last digit that the results store, not for the solver; of a prediction what the search leaves.
  const stored = 1e-5, told_apart = 2.5e-3;
  const is_beyond = (limit, value, slack) => is_number(value) && excess(limit, value) > slack;
  return list(scatter.constraints).map(record)
    .filter((limit) => is_number(bound_of(limit)) && (is_beyond(limit, limit.value, stored) || is_beyond(limit, record(limit.predicted).value, told_apart)))
    .sort((a, b) => excess(b, known_value(b)) - excess(a, known_value(a)));
}

const is_least = (limit) => is_number(limit.min), bound_of = (limit) => (is_least(limit) ? limit.min : limit.max);
/** "at most 0.9" */
const bound_words = (limit) => `${is_least(limit) ? "at least" : "at most"} ${fmt(bound_of(limit))}`;

/** "the 95 % quantile of peak-to-peak TE over drawn gears to at most 0.9 µm: 3.15 µm" */
const drawn_limit_words = (scatter, limit) =>
  `${drawn_statistic(scatter, limit)} of ${words(limit.name)} over drawn gears to ${in_unit(bound_words(limit), pretty_unit(limit.unit))}: ${in_unit(fmt(known_value(limit), 3), pretty_unit(limit.unit))}`;

/** "the 95 % quantile"; of a lower limit the quantile from below, and any other statistic by the reciprocal. */
function drawn_statistic(scatter, limit) {
  if (!is_least(limit)) return `the ${scatter.statistic_in_words}`;
  const level = /^([\d.]+) % quantile$/.exec(`${scatter.statistic_in_words}`);
  return level ? `the ${fmt(100 - Number(level[1]), 4)} % quantile` : `the reciprocal of the ${scatter.statistic_in_words} of 1/value`;
}

/** The best known statistic of the design, and of the one found without scatter, over the same draws: fresh ones, those of the prediction, or those of the search. */
const statistic_of_design = (scatter) => fresh_statistic(scatter, "after") ?? record(scatter.predicted).value ?? scatter.value;
const statistic_without_scatter = (scatter) => fresh_statistic(scatter, "without scatter") ?? record(scatter.without_scatter).predicted ?? record(scatter.without_scatter).value;

/** "95 % quantile of peak contact stress over drawn gears: 4550 → 1590 MPa (−65 %)"; without fresh draws beside the design that was searched without scatter. */
function scatter_headline(optimise, scatter) {
  const [exceeded] = exceeded_over_draws(scatter);
  if (exceeded) return `No design found keeps ${drawn_limit_words(scatter, exceeded)}`;
  const unit = pretty_unit(scatter.unit), before = fresh_statistic(scatter, "before"), after = fresh_statistic(scatter, "after");
  const subject = capital(`${scatter.statistic_in_words} of ${words(optimise.objective_name)} over drawn gears`), change = (from, to) => (percent_change(from, to) ? ` (${percent_change(from, to)})` : "");
  if (is_number(before) && is_number(after)) return `${subject}: ${fmt(before, 3)} → ${fmt(after, 3)} ${unit}${change(before, after)}`;
  const found = statistic_of_design(scatter), without = statistic_without_scatter(scatter);
  return `${subject}: ${fmt(found, 3)} ${unit}${is_number(without) ? `, ${fmt(without, 3)} ${unit} with the design found without scatter${change(without, found)}` : ""}`;
}

/** What was minimised over drawn gears, and its limits: facts for the first screen. */
function drawn_facts(scatter) {
  const unit = pretty_unit(scatter.unit), predicted = record(scatter.predicted), before = fresh_statistic(scatter, "before");
  const between = is_number(predicted.low) && is_number(predicted.high) ? `, between ${fmt(predicted.low, 4)} and ${fmt(predicted.high, 4)}` : "";
  const exceeded = exceeded_over_draws(scatter);
  return [
    is_number(before) ? ["Drawn gears, before", `${fmt(before, 4)} ${unit}`] : null,
    ["Without scatter in the search", `${fmt(statistic_without_scatter(scatter), 4)} ${unit}`],
    ["With scatter in the search", `${fmt(statistic_of_design(scatter), 4)} ${unit}`],
    is_number(predicted.value) ? ["Predicted", `${fmt(predicted.value, 4)}${between} ${unit}`] : null,
    ...list(scatter.constraints).map(record).map((limit) => [`${capital(words(limit.name))}, drawn gears`, `${in_unit(fmt(known_value(limit), 3), pretty_unit(limit.unit))}, ${bound_words(limit)}`,
      exceeded.includes(limit) ? "bad" : "good"]),
  ];
}

/** "Each draw has 2 load cases in 2 operating states (drive, coast); its value is the worst of them."; empty where a draw has one. */
function load_cases_of_draw(scatter) {
  const count = scatter.load_cases_of_a_draw, states = list(scatter.states);
  if (!(count > 1)) return "";
  return ` Each draw has ${count} load cases in ${states.length > 1 ? `${states.length} operating states (${states.join(", ")})` : "one operating state"}; its value is the ${scatter.within_draw} of them.`;
}

/** What is drawn, and from which distribution. */
function tolerances_table(body, tolerances) {
  table(body, {
    title: "What scatters",
    note: tolerances.some(({ added }) => added) ? "A value that is added is the difference from the design, or from the misalignment of the scene." : undefined,
    columns: [{ label: "Quantity" }, { label: "Distribution" }, { label: "Unit" }],
    rows: tolerances.map((tolerance) => [words(`${tolerance.name}`), `${pretty_unit(`${tolerance.distribution}`)}${tolerance.added ? ", added" : ""}`, pretty_unit(tolerance.unit ?? "")]),
  });
}

function build_tolerances(results, body) {
  const scatter = record(record(results.optimise).scatter), unit = pretty_unit(scatter.unit), fresh = record(scatter.fresh);
  const without = record(scatter.without_scatter), predicted = record(scatter.predicted);
  const interval = is_number(predicted.low) && is_number(predicted.high)
    ? ` With ${fmt(100 * predicted.confidence, 3)} % confidence it lies between ${fmt(predicted.low, 4)} and ${fmt(predicted.high, 4)} ${unit}.` : "";
  table(body, {
    title: `${capital(`${scatter.statistic_in_words}`)} over the draws`,
    note: `${fmt(scatter.draws, 5)} draws, the same for every design; the search took ${fmt(scatter.seconds, 2)} s, that without scatter before it ${fmt(without.seconds, 2)} s. Over the draws of the search its own design is the best of many, and better than it will be over others.${load_cases_of_draw(scatter)}`
      + (is_number(predicted.value) ? ` The prediction is from ${fmt(predicted.draws, 5)} draws that the search has not seen.${interval}` : "")
      + (is_number(fresh.prediction_error_percent) ? ` Beside ${fmt(fresh.draws, 5)} fresh draws it is ${fmt(Math.abs(fresh.prediction_error_percent), 2)} % off.` : ""),
    columns: [{ label: "Design" }, { label: "Draws of the search" }, { label: "Predicted" }, { label: "Fresh draws" }, { label: "Unit" }],
    rows: [["without scatter", without.value, without.predicted, "without scatter"], ["with scatter", scatter.value, predicted.value, "after"]].map(([label, value, expected, name]) =>
      [label, value ?? null, expected ?? null, list(fresh.designs).map(record).find((design) => design.name === name)?.statistic ?? null, unit]),
  });
  const limits = list(scatter.constraints).map(record), exceeded = exceeded_over_draws(scatter).map(({ name }) => name);
  if (limits.length > 0) {
    table(body, {
      title: "Limits over the draws",
      note: "Each limit holds for a statistic over the draws. Where the prediction exceeded a limit, the search went on with a tighter one.",
      columns: [{ label: "Output" }, { label: "Statistic" }, { label: "Draws of the search" }, { label: "Predicted" }, { label: "Limit" }, { label: "Limit of the search" }, { label: "Unit" }, { label: "" }],
      rows: limits.map((limit) => [words(limit.name), drawn_statistic(scatter, limit), limit.value, record(limit.predicted).value ?? null, bound_words(limit), limit.searched_limit ?? null, pretty_unit(limit.unit),
        exceeded.includes(limit.name) ? { text: "exceeded", class: "bad" } : { text: "kept", class: "" }]),
    });
  }
  tolerances_table(body, list(scatter.tolerances).map(record));
  const classes = list(scatter.classes).map(record);
  if (classes.length === 0) return;
  table(body, {
    title: "What a class costs",
    note: "Each row is the design that is right for its class, or the nearest found where none keeps the limits. All figures are the statistic over the draws of that class.",
    columns: [{ label: "ISO 1328-1 class" }, { label: "Limits" }, { label: `Objective [${unit}]` }, { label: `Of the design without scatter [${unit}]` }, { label: "Peak contact stress [MPa]" }, { label: "Transmission error, peak to peak [µm]" }],
    rows: classes.map((row) => [row.iso_1328_class, keeps_limits(row) ? { text: "kept", class: "" } : { text: "exceeded", class: "bad" }, row.statistic_value ?? row.value, row.without_scatter_value, row.peak_contact_stress_MPa, row.te_peak_to_peak_um]),
  });
  const grid = figure_grid(body);
  for (const [key, title] of [["peak_contact_stress_MPa", "Peak contact stress [MPa]"], ["te_peak_to_peak_um", "Transmission error, peak to peak [µm]"]]) {
    const hollow = classes.every(keeps_limits) ? "" : " Hollow marks: no design of the class was found that keeps the limits.";
    figure(grid, { title, caption: `Statistic over the draws of each class, of the design that is right for it.${hollow}` }, (plot) => class_plot(plot, classes, key));
  }
}

/** Whether the design of a class keeps the limits over the draws, also of the prediction. */
const keeps_limits = (row) => row.status !== "infeasible" && exceeded_over_draws(row).length === 0;

/** The figure of each class as a line with marks. */
function class_plot(plot, classes, key) {
  const width = plot.clientWidth || 420, height = 220, frame = { left: 56, top: 12, width: width - 72, height: height - 52 };
  const known = classes.filter((row) => is_number(row[key]) && is_number(row.iso_1328_class));
  const grades = known.map((row) => row.iso_1328_class), values = known.map((row) => row[key]);
  const ticks = round_ticks(minimum(values), maximum(values), 5), low = Math.min(minimum(values), ...ticks), high = Math.max(maximum(values), ...ticks, low + 1e-9);
  const first = minimum(grades), last = Math.max(maximum(grades), first + 1);
  const to_x = (grade) => frame.left + (frame.width * (grade - first)) / (last - first), to_y = (value) => frame.top + frame.height * (1 - (value - low) / (high - low));
  const { canvas, pen } = sharp_canvas(width, height, `${words(key)} over the tolerance class`);
  pen.strokeStyle = pen.fillStyle = getComputedStyle(document.body).color;
  pen.font = "12px sans-serif";
  pen.strokeRect(frame.left, frame.top, frame.width, frame.height);
  pen.textAlign = "right";
  for (const tick of ticks) pen.fillText(fmt(tick, 4), frame.left - 6, to_y(tick) + 4);
  pen.textAlign = "center";
  for (const grade of grades) pen.fillText(`${grade}`, to_x(grade), frame.top + frame.height + 16);
  pen.fillText("ISO 1328-1 class", frame.left + 0.5 * frame.width, frame.top + frame.height + 34);
  pen.strokeStyle = pen.fillStyle = "#0072b2";
  pen.beginPath();
  known.forEach((row, i) => (i === 0 ? pen.moveTo(to_x(grades[i]), to_y(values[i])) : pen.lineTo(to_x(grades[i]), to_y(values[i]))));
  pen.stroke();
  known.forEach((row, i) => (keeps_limits(row) ? pen.fillRect(to_x(grades[i]) - 3, to_y(values[i]) - 3, 6, 6) : pen.strokeRect(to_x(grades[i]) - 4, to_y(values[i]) - 4, 8, 8)));
  plot.append(canvas);
}

add_sections({ tolerances: build_tolerances });

// The cost of accuracy: fidelity levels compared with the finest one, and the choice made for `fidelity.accuracy`.

const FIGURES = ["worst", "te_mean", "te_peak_to_peak", "te_harmonic_1", "te_harmonic_2", "te_harmonic_3", "te_harmonic_4", "te_harmonic_5",
  "peak_contact_stress", "peak_line_load", "load_factor"];
/** Figures whose differences are counted from the study's outside curve, where it gives one. */
const OUTSIDE = "from_outside:", OUTSIDE_FIGURES = ["te_mean", "te_peak_to_peak", "te_harmonic_1"], WORST_FROM_OUTSIDE = `${OUTSIDE}worst`;
const figure_words = (name) => (name === "worst" ? "worst of all quantities" : name === WORST_FROM_OUTSIDE ? "worst of TE, from outside"
  : name.startsWith(OUTSIDE) ? `${words(name.slice(OUTSIDE.length))}, from outside` : words(name));
/** Magnitude of a level's error [%]. */
function error_of(level, figure) {
  if (!figure.startsWith(OUTSIDE)) return record(level.error_percent)[figure];
  const from_outside = record(level.from_outside_percent);
  return Math.max(...(figure === WORST_FROM_OUTSIDE ? OUTSIDE_FIGURES : [figure.slice(OUTSIDE.length)]).map((name) => Math.abs(from_outside[name])));
}
const AXIS_STYLE = ["circle", "rect", "triangle", "rectRot", "star", "crossRot", "cross", "rect", "triangle", "circle", "rectRot", "circle"];
/** Errors below this are drawn at it: a logarithmic axis has no 0 [%]. */
const LEAST_DRAWN_ERROR = 1e-3;

/** Whether no other of the levels is both as fast and as accurate. */
function is_best(level, figure, levels) {
  if (figure === "worst") return level.pareto_best;
  if (!figure.startsWith(OUTSIDE)) return list(level.pareto_best_in).includes(figure);
  const error = error_of(level, figure);
  return !levels.some((other) => other.seconds <= level.seconds && error_of(other, figure) <= error
    && (other.seconds < level.seconds || error_of(other, figure) < error));
}

function settings_text(settings) {
  const { compliance, gap, quadrature, positions, peaks } = record(settings);
  const left_out = list(record(settings).left_out).map((effect) => `without ${effect}`);
  return [compliance, gap, `${record(quadrature).rule} ${fmt(record(quadrature).intervals)}`, `${fmt(positions)} positions`, `peaks ${peaks}`, ...left_out]
    .map((part) => `${part}`.replace(/_/g, " ")).join(", ");
}

/** The cheapest level within an error, for the headline. */
const cheapest_within = (levels, percent) => levels
  .filter((level) => level.axis !== "finest" && record(level.error_percent).worst <= percent)
  .reduce((best, level) => (best && best.seconds <= level.seconds ? best : level), null);

function accuracy_headline(results) {
  const levels = list(record(results.accuracy).rungs).map(record), finest = levels.find((level) => level.axis === "finest") || {};
  const enough = cheapest_within(levels, 5);
  if (!enough) return `No fidelity level comes within 5 % of the finest, which takes ${time_text(finest.seconds)}`;
  return `Within ${fmt(enough.error_percent.worst, 2)} % of the finest level in ${time_text(enough.seconds)} instead of ${time_text(finest.seconds)}: “${enough.name}”`;
}

/** The figure that is shown first. */
const first_figure = (accuracy) => (is_number(record(accuracy.outside).te_mean_um) ? WORST_FROM_OUTSIDE : "worst");

function draw_levels(plot, levels, figure, height = 460) {
  const shown = levels.filter((level) => (level.axis !== "finest" || figure.startsWith(OUTSIDE)) && is_number(level.seconds) && is_number(error_of(level, figure)));
  const point = (level) => ({ x: level.seconds, y: Math.max(error_of(level, figure), LEAST_DRAWN_ERROR), note: level.name });
  const axes = unique(shown.map((level) => level.axis));
  const front = shown.filter((level) => is_best(level, figure, shown)).sort((a, b) => a.seconds - b.seconds);
  const decade = (value) => (Number.isInteger(Math.round(Math.log10(value) * 1e6) / 1e6) ? fmt(value) : "");
  const log_axis = { type: "logarithmic", ticks: { callback: decade } };
  xy_chart(plot, {
    label: `Error of ${figure_words(figure)} over seconds`,
    curves: [
      { label: "Pareto-best", points: front.map(point), colour: css_colour("ink"), width: 1.2, dashed: true, order: 2 },
      { label: "Pareto-best levels", quiet: true, points: front.map(point), colour: css_colour("ink"), fill: "transparent", scatter: true, hollow: true, size: 9, order: 2 },
      ...axes.map((axis, i) => ({
        label: axis, points: shown.filter((level) => level.axis === axis).map(point), colour: sequence_colour(i), scatter: true,
        hollow: ["star", "crossRot", "cross"].includes(AXIS_STYLE[i]), style: AXIS_STYLE[i % AXIS_STYLE.length], size: 5,
      })),
    ],
    x: "seconds of one thread, influence values known", y: `error [%]: ${figure_words(figure)}`,
    x_range: log_axis, y_range: log_axis, read_x: time_text, read_y: (y) => `${fmt(y, 3)} %`, nearest: "xy", height,
    labels: front.map((level) => ({ ...point(level), text: level.name })),
  });
}

function build_accuracy(results, body) {
  const choice = record(results.accuracy_choice);
  if (choice.estimate_percent) build_accuracy_choice(choice, body);
  const accuracy = record(results.accuracy), levels = list(accuracy.rungs).map(record);
  if (levels.length === 0) return;
  const outside = record(accuracy.outside), has_outside = is_number(outside.te_mean_um);
  const state = { figure: first_figure(accuracy) };
  const redraw = figure(figure_grid(body), {
    title: "Error and time of each fidelity level",
    wide: true,
    caption: "Each mark is a fidelity level: all load cases analysed with its models and resolution, compared with the finest level. Most levels differ "
      + "from the finest along one axis; the whole settings are complete choices for practical use. A level with a ring is Pareto-best: no other level "
      + `is both as fast and as accurate. Errors below ${LEAST_DRAWN_ERROR} % are drawn at that value.`
      + (has_outside ? ` Errors “from outside” are counted from the curve that the study gives (${outside.name}, ${fmt(outside.positions)} positions), at its positions; the worst is that of mean, peak to peak and first harmonic.` : ""),
  }, (plot) => draw_levels(plot, levels, state.figure));
  const { node } = choice_of_figure(state, redraw, has_outside);
  body.prepend(node);
  table(body, {
    title: "Fidelity levels",
    note: "Errors are differences from the finest level in per cent, in the worst load case. The TE mean is related to the mean deflection of the mesh; peak "
      + "to peak and harmonics are related to the peak to peak, or to 2 % of that deflection where this is larger. Times are of one thread with influence "
      + "values known; the first run includes the finite elements that the compliance needs."
      + (has_outside ? ` The last columns are differences from ${outside.name}, which has a mean of ${fmt(outside.te_mean_um, 4)} µm and a peak to peak of `
        + `${fmt(outside.te_peak_to_peak_um, 4)} µm; + is more.` : ""),
    columns: [{ label: "Level" }, { label: "Axis" }, { label: "Error of" }, { label: "Time", unit: "s", digits: 3 }, { label: "First run", unit: "s", digits: 3 },
      { label: "TE mean", unit: "%", digits: 2 }, { label: "TE p-p", unit: "%", digits: 2 }, { label: "TE harmonic 1", unit: "%", digits: 2 },
      { label: "Stress", unit: "%", digits: 2 }, { label: "Line load", unit: "%", digits: 2 }, { label: "Worst", unit: "%", digits: 2 }, { label: "Best" }, { label: "Settings" },
      ...(has_outside ? OUTSIDE_FIGURES.map((name) => ({ label: `${words(name)}, from outside`, unit: "%", digits: 2 })) : [])],
    rows: levels.map((level) => {
      const e = record(level.error_percent);
      return [level.name, level.axis, level.varies, level.seconds, level.first_run_seconds, e.te_mean ?? null, e.te_peak_to_peak ?? null, e.te_harmonic_1 ?? null,
        e.peak_contact_stress ?? null, e.peak_line_load ?? null, e.worst ?? null, level.pareto_best ? "yes" : "", settings_text(level.settings),
        ...(has_outside ? OUTSIDE_FIGURES.map((name) => record(level.from_outside_percent)[name] ?? null) : [])];
    }),
  });
  const own = record(accuracy.reference_resolution_error_percent);
  table(body, {
    title: "Observed orders of convergence and remaining error of the finest level",
    note: "The three finest levels of an axis give its order p: halving the step divides the change by 2 to the power p. An axis is not regular where in some "
      + "load case the changes do not shrink as a power or change sign. The last column is estimated from the same changes.",
    columns: [{ label: "Quantity" }, ...list(accuracy.orders).map((axis) => ({ label: `${axis.axis} ${list(axis.levels).join(", ")}`, digits: 2 })),
      { label: "Error of the finest", unit: "%", digits: 2 }],
    rows: FIGURES.filter((name) => name !== "worst").map((name) =>
      [figure_words(name), ...list(accuracy.orders).map((axis) => { const p = record(axis.order)[name]; return { text: is_number(p) ? fmt(p, 2) : "not regular", value: p }; }),
        own[name] ?? null]),
  });
}

function choice_of_figure(state, redraw, has_outside) {
  const options = [...(has_outside ? [WORST_FROM_OUTSIDE, ...OUTSIDE_FIGURES.map((name) => OUTSIDE + name)] : []), ...FIGURES].map((value) => ({ value, label: figure_words(value) }));
  const made = choice("Error of", options, state.figure, (value) => {
    state.figure = value;
    redraw();
  });
  made.node.classList.add("no-print");
  return made;
}

function build_accuracy_choice(choice, body) {
  const estimate = record(choice.estimate_percent);
  body.append(el("p", { class: choice.kept ? "banner" : "banner bad" }, `Asked for ${fmt(choice.asked_percent, 3)} %, estimated ${fmt(estimate.worst, 2)} %`
    + `${choice.kept ? "" : ": not kept"}. Models chosen in ${time_text(choice.choosing_seconds)}.`));
  const quadrature = record(record(choice.quadrature).used);
  const used = { compliance: record(choice.compliance).used, gap: record(choice.gap).used,
    quadrature: `${quadrature.rule} ${fmt(quadrature.intervals)}`, positions: record(choice.positions).used,
    resolution: "quadrature and positions",
    effects: list(record(choice.effects).left_out).length > 0 ? `without ${list(choice.effects.left_out).join(", ")}` : "all that are called for" };
  table(body, {
    title: "Chosen settings and their estimated errors",
    note: "Errors are estimates in per cent for the worst load case. Settings that the study gives are kept and not estimated. "
        + "The row of the resolution is the sum of quadrature and positions.",
    columns: [{ label: "Setting" }, { label: "Used" }, ...FIGURES.map((name) => ({ label: figure_words(name), digits: 2 }))],
    rows: [...Object.entries(used).map(([name, value]) => {
      const part = record(choice[name]);
      return [name, { text: `${fmt(value)}`.replace(/_/g, " ") + (part.given ? " (given)" : ""), value }, ...FIGURES.map((f) => record(part.estimate_percent)[f] ?? null)];
    }), ["all together", "", ...FIGURES.map((f) => estimate[f] ?? null)]],
  });
  const tried = [...list(record(choice.compliance).candidates), ...list(record(choice.gap).candidates)].map(record)
    .map((c) => [`${c.name}`.replace(/_/g, " "), c.chosen ? "yes" : "", record(c.error_percent).worst ?? null, c.seconds ?? null]);
  const level = (text, l, chosen) => [text, chosen ? "yes" : "", record(l.error_percent).worst ?? null, null];
  const levels = list(record(choice.quadrature).levels).map(record)
    .map((l, i, all) => level(`${fmt(l.intervals)} intervals, ${fmt(l.positions)} positions`, l, i === all.length - 1));
  table(body, {
    title: "Candidates",
    note: "Models are compared at a coarse resolution. The resolutions are those of the run, each with the load case that was known least.",
    columns: [{ label: "Candidate" }, { label: "Chosen" }, { label: "Estimated error, worst quantity", unit: "%", digits: 2 }, { label: "Time", unit: "s", digits: 2 }],
    rows: [...tried, ...levels],
  });
}

function accuracy_first(first, results) {
  const levels = list(record(results.accuracy).rungs).map(record);
  panel(first, { title: "Error and time of each fidelity level", span: 7, href: "accuracy" }, (plot) => draw_levels(plot, levels, first_figure(record(results.accuracy)), 400));
  panel(first, { title: "Cheapest level within an error", span: 5, href: "accuracy" }, (plot) => {
    const rows = [10, 5, 2, 1, 0.5, 0.1].map((percent) => ({ percent, level: cheapest_within(levels, percent) })).filter(({ level }) => level);
    const tightest = rows.filter(({ level }, i) => rows[i + 1]?.level !== level), finest = levels.find((level) => level.axis === "finest");
    plot.append(facts(tightest.map(({ percent, level }) => [`Within ${fmt(percent)} %`,
      el("span", {}, el("b", {}, `${level.name}, ${time_text(level.seconds)}`), el("small", {}, ` ${settings_text(level.settings)}`))])));
    if (finest) plot.append(facts([["The finest", el("span", {}, el("b", {}, time_text(finest.seconds)), el("small", {}, ` ${settings_text(finest.settings)}`))]]));
    plot.append(el("p", { class: "fine" }, "Times are of one thread with influence values known. Errors are differences from the finest level, of the worst quantity in all load cases."));
  });
}

add_task_page({ key: "accuracy", headline: accuracy_headline, first: accuracy_first });
add_sections({ accuracy: build_accuracy });

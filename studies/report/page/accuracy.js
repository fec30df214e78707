// What accuracy costs: a ladder of rungs beside the finest, and what `fidelity.accuracy` has chosen.

const FIGURES = ["worst", "te_mean", "te_peak_to_peak", "te_harmonic_1", "te_harmonic_2", "te_harmonic_3", "te_harmonic_4", "te_harmonic_5",
  "peak_contact_stress", "peak_line_load", "load_factor"];
const figure_words = (name) => (name === "worst" ? "worst of all figures" : words(name));
const AXIS_STYLE = ["circle", "rect", "triangle", "rectRot", "star", "crossRot", "cross", "rect", "triangle", "circle", "rectRot", "circle"];
/** Errors below this are drawn at it: a logarithmic axis has no 0 [%]. */
const LEAST_DRAWN_ERROR = 1e-3;

const is_best = (rung, figure) => (figure === "worst" ? rung.pareto_best : list(rung.pareto_best_in).includes(figure));

function settings_text(settings) {
  const { compliance, gap, quadrature, positions, peaks } = record(settings);
  const left_out = list(record(settings).left_out).map((effect) => `without ${effect}`);
  return [compliance, gap, `${record(quadrature).rule} ${fmt(record(quadrature).intervals)}`, `${fmt(positions)} positions`, `peaks ${peaks}`, ...left_out]
    .map((part) => `${part}`.replace(/_/g, " ")).join(", ");
}

/** "coarser by one figure": the cheapest rung within an error, for the headline. */
const cheapest_within = (rungs, percent) => rungs
  .filter((rung) => rung.axis !== "finest" && record(rung.error_percent).worst <= percent)
  .reduce((best, rung) => (best && best.seconds <= rung.seconds ? best : rung), null);

function accuracy_headline(accuracy) {
  const rungs = list(accuracy.rungs).map(record), finest = rungs.find((rung) => rung.axis === "finest") || {};
  const enough = cheapest_within(rungs, 5);
  if (!enough) return `No rung of the ladder comes within 5 % of the finest, which takes ${time_text(finest.seconds)}`;
  return `Within ${fmt(enough.error_percent.worst, 2)} % of the finest rung in ${time_text(enough.seconds)} instead of ${time_text(finest.seconds)}: “${enough.name}”`;
}

function draw_ladder(plot, rungs, figure, height = 460) {
  const shown = rungs.filter((rung) => rung.axis !== "finest" && is_number(rung.seconds) && is_number(record(rung.error_percent)[figure]));
  const point = (rung) => ({ x: rung.seconds, y: Math.max(record(rung.error_percent)[figure], LEAST_DRAWN_ERROR), note: rung.name });
  const axes = unique(shown.map((rung) => rung.axis));
  const front = shown.filter((rung) => is_best(rung, figure)).sort((a, b) => a.seconds - b.seconds);
  const decade = (value) => (Number.isInteger(Math.round(Math.log10(value) * 1e6) / 1e6) ? fmt(value) : "");
  const log_axis = { type: "logarithmic", ticks: { callback: decade } };
  xy_chart(plot, {
    label: `Error of ${figure_words(figure)} against seconds`,
    curves: [
      { label: "Pareto-best", points: front.map(point), colour: css_colour("ink"), width: 1.2, dashed: true, order: 2 },
      { label: "Pareto-best rungs", quiet: true, points: front.map(point), colour: css_colour("ink"), fill: "transparent", scatter: true, hollow: true, size: 9, order: 2 },
      ...axes.map((axis, i) => ({
        label: axis, points: shown.filter((rung) => rung.axis === axis).map(point), colour: sequence_colour(i), scatter: true,
        hollow: ["star", "crossRot", "cross"].includes(AXIS_STYLE[i]), style: AXIS_STYLE[i % AXIS_STYLE.length], size: 5,
      })),
    ],
    x: "seconds of one thread, influence values known", y: "error [%]",
    x_range: log_axis, y_range: log_axis, read_x: time_text, read_y: (y) => `${fmt(y, 3)} %`, nearest: "xy", height,
    labels: front.map((rung) => ({ ...point(rung), text: rung.name })),
  });
}

function build_accuracy(results, body) {
  const choice = record(results.accuracy_choice);
  if (choice.estimate_percent) build_accuracy_choice(choice, body);
  const accuracy = record(results.accuracy), rungs = list(accuracy.rungs).map(record);
  if (rungs.length === 0) return;
  const state = { figure: "worst" };
  const redraw = figure(figure_grid(body), {
    title: "Error against time, rung by rung",
    wide: true,
    caption: "Each mark is one way to analyse all load cases, held against the finest. One axis is varied at a time from the finest; "
      + "whole settings are what one would run. No other rung is both as fast and as close as one with a ring. Errors below "
      + `${LEAST_DRAWN_ERROR} % are drawn there.`,
  }, (plot) => draw_ladder(plot, rungs, state.figure));
  const { node } = choice_of_figure(state, redraw);
  body.prepend(node);
  table(body, {
    title: "Rungs",
    note: "Errors in per cent of the finest rung, the worst of the load cases: TE mean in units of the mean deflection of the mesh, peak to peak and "
      + "harmonics in units of the peak to peak, at least 2 % of that deflection. Seconds of one thread with influence values known; first run: with the "
      + "finite elements that the compliance needs.",
    columns: [{ label: "Rung" }, { label: "Axis" }, { label: "Error of" }, { label: "Time", unit: "s", digits: 3 }, { label: "First run", unit: "s", digits: 3 },
      { label: "TE mean", unit: "%", digits: 2 }, { label: "TE p-p", unit: "%", digits: 2 }, { label: "TE harmonic 1", unit: "%", digits: 2 },
      { label: "Stress", unit: "%", digits: 2 }, { label: "Line load", unit: "%", digits: 2 }, { label: "Worst", unit: "%", digits: 2 }, { label: "Best" }, { label: "Settings" }],
    rows: rungs.map((rung) => {
      const e = record(rung.error_percent);
      return [rung.name, rung.axis, rung.varies, rung.seconds, rung.first_run_seconds, e.te_mean ?? null, e.te_peak_to_peak ?? null, e.te_harmonic_1 ?? null,
        e.peak_contact_stress ?? null, e.peak_line_load ?? null, e.worst ?? null, rung.pareto_best ? "yes" : "", settings_text(rung.settings)];
    }),
  });
  const own = record(accuracy.reference_resolution_error_percent);
  table(body, {
    title: "Observed orders of convergence, and what is left of the finest's own resolution",
    note: "By the three finest levels of an axis: halving the step divides the change by 2 to the order. Not regular: in some load case the changes "
      + "do not shrink as a power, or change sign. The last column is estimated from the same changes.",
    columns: [{ label: "Figure" }, ...list(accuracy.orders).map((axis) => ({ label: `${axis.axis} ${list(axis.levels).join(", ")}`, digits: 2 })),
      { label: "Left in the finest", unit: "%", digits: 2 }],
    rows: FIGURES.filter((name) => name !== "worst").map((name) =>
      [figure_words(name), ...list(accuracy.orders).map((axis) => { const p = record(axis.order)[name]; return { text: is_number(p) ? fmt(p, 2) : "not regular", value: p }; }),
        own[name] ?? null]),
  });
}

function choice_of_figure(state, redraw) {
  const options = FIGURES.map((value) => ({ value, label: figure_words(value) }));
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
    + `${choice.kept ? "" : ": not kept"}. Chosen in ${time_text(choice.choosing_seconds)}.`));
  const quadrature = record(record(choice.quadrature).used);
  const used = { compliance: record(choice.compliance).used, gap: record(choice.gap).used,
    quadrature: `${quadrature.rule} ${fmt(quadrature.intervals)}`, positions: record(choice.positions).used,
    resolution: "quadrature and positions",
    effects: list(record(choice.effects).left_out).length > 0 ? `without ${list(choice.effects.left_out).join(", ")}` : "all that are called for" };
  table(body, {
    title: "What was chosen, and what it costs in accuracy",
    note: "Estimated errors in per cent, the worst of the load cases. What the study gives itself stays and is not judged. "
        + "Quadrature and positions together: their sum.",
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
    title: "What was considered",
    note: "Models resolved coarsely, then the resolutions of the load case that asked for the finest one.",
    columns: [{ label: "Rung" }, { label: "Chosen" }, { label: "Estimated error, worst figure", unit: "%", digits: 2 }, { label: "Time", unit: "s", digits: 2 }],
    rows: [...tried, ...levels],
  });
}

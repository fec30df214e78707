// The first screens of the tasks: their panels in order.

function optimise_first(first, results, selection) {
  const optimise = record(results.optimise);
  panel(first, { title: "What to grind", span: 5, href: "modifications" }, (plot) => grinding_table(plot, results));
  const front = list(record(optimise.pareto).points).length > 1;
  if (front) {
    panel(first, { title: "What a gain in one costs in the other", span: 7, href: "search" }, (plot) => draw_front(plot, record(optimise.pareto), [0, 1], 250));
  } else {
    panel(first, { title: "Topography to grind", span: 7, href: "modifications" }, (plot) => small_topographies(plot, results, 220));
  }
  panel(first, { title: `How much better: ${objective_words(optimise)}`, span: 5, href: "scenes" }, (plot) => gain_panel(plot, results));
  panel(first, { title: "How sure", span: 4, href: "validation" }, (plot) => assurance_panel(plot, results));
  panel(first, { title: "What it costs", span: 3, href: "effects" }, (plot) => cost_panel(plot, results));
  if (front) panel(first, { title: "Topography to grind", span: 12, href: "modifications" }, (plot) => small_topographies(plot, results, 236));
}

/** The headline quantities of a load case with their estimated errors. */
function known_to_panel(plot, results, selection) {
  const summary = summary_of(final_entry(selection.current));
  const shown = QUANTITIES.filter((of) => of.is_headline && of.has_error && is_number(quantity_in(summary, of)));
  const rows = shown.map((of) => [capital(of.name), `${with_error(quantity_in(summary, of), quantity_in(summary, of, "_error"), 4)} ${of.unit}`]);
  const estimated = shown.some((of) => is_number(quantity_in(summary, of, "_error")));
  const change = record(summary.te_convergence).harmonic_change_um;
  plot.append(facts([...rows, is_number(change) ? ["Twice the positions", `change the harmonics by at most ${fmt(change, 2)} µm`] : null,
    estimated ? ["±", "estimated discretisation error"] : ["Discretisation", "its error was not estimated"]]));
}

/** The quantity that a study asks about, in every load case; the governing case comes first. */
function cases_panel(plot, selection, key, unit) {
  const rows = selection.cases.map((load_case) => ({ load_case, summary: summary_of(final_entry(load_case)) }))
    .filter(({ summary }) => is_number(summary[key])).sort((a, b) => b.summary[key] - a.summary[key]);
  if (rows.length === 0) return;
  draw_pairs(plot, rows.slice(0, MOST_SCENES + 1).map(({ load_case, summary }) => ({ label: load_case.label, after: summary[key], after_error: summary[`${key}_error`],
    strong: load_case === selection.current })), unit);
  if (rows.length > MOST_SCENES + 1) plot.append(el("p", { class: "fine" }, `The ${MOST_SCENES + 1} worst of ${rows.length}.`));
}

function analysis_first(first, results, selection) {
  const te = asks_for_te(results), where = selection.cases.length > 1 ? `, ${selection.current.label}` : "";
  const te_panel = (span) => panel(first, { title: `Transmission error${where}`, span, href: "transmission-error" }, (plot) => draw_te(plot, { ...selection, cases: [selection.current] }, true, 226));
  const flank_panel = (span) => panel(first, { title: `Contact stress on the pinion flank${where}`, span, href: "flank-load" },
    (plot) => draw_flank_load(plot, selection.current, FLANK_QUANTITIES[0], null, 236));
  if (te) te_panel(6);
  flank_panel(6);
  if (!te) te_panel(6);
  if (selection.cases.length > 1) {
    const [key, unit] = te ? ["te_peak_to_peak_um", "µm"] : ["peak_contact_stress_MPa", "MPa"];
    panel(first, { title: `${capital(words(key))} of each load case [${unit}]`, span: 5, href: "load-cases" }, (plot) => cases_panel(plot, selection, key, unit));
  } else if (list(summary_of(final_entry(selection.current)).te_harmonics_um).length > 0) {
    panel(first, { title: "Harmonics of TE", span: 5, href: "transmission-error" }, (plot) => draw_te_harmonics(plot, selection.current, 190));
  }
  panel(first, { title: `How sure${where}`, span: 4, href: "load-cases" }, (plot) => known_to_panel(plot, results, selection));
  panel(first, { title: "What it costs", span: 3, href: "effects" }, (plot) => cost_panel(plot, results));
}

function unloaded_first(first, results) {
  const scene = worst_unloaded(unloaded_scenes(results)), data = scene.data, geometry = record(results.geometry);
  const where = unloaded_scenes(results).length > 1 ? `, ${scene.label}` : "";
  panel(first, { title: `Unloaded transmission error${where}`, span: 7, href: "unloaded" }, (plot) => draw_unloaded_te(plot, data, 360 / record(geometry.pinion).teeth, 220));
  panel(first, { title: "Contact in words", span: 5, href: "unloaded" },
    (plot) => draw_words(plot, data, record(geometry.pinion).teeth / record(geometry.wheel).teeth));
  panel(first, { title: `Path of contact${where}`, span: 9, href: "unloaded" }, (plot) => draw_contact_paths(plot, results, data));
  panel(first, { title: "What it costs", span: 3, href: "effects" }, (plot) => cost_panel(plot, results));
}

const SWEEP_FIRST = ["peak_contact_stress_MPa", "te_peak_to_peak_um", "peak_root_stress_MPa", "peak_to_peak_arcsec", "load_factor", "mean_stiffness_N_per_mm_um"];

function sweep_facts(sweep) {
  const name = leading_output(sweep_outputs(sweep)), of = record(record(sweep.statistics)[name]), unit = sweep_unit(of.unit);
  const samples = sweep.samples - sweep.failed;
  return [
    is_number(of.std) ? ["Mean of the samples", `${with_error(of.mean, of.std / Math.sqrt(samples), 4)} ${unit}`] : null,
    is_number(record(of.worst).value) ? ["Worst sample", `${fmt(record(of.worst).value, 4)} ${unit}, sample ${fmt(record(of.worst).sample, 9)}`] : null,
    record(of.worst).study ? ["Its study", el("code", {}, record(of.worst).study)] : null,
    ["Samples", `${fmt(samples, 9)} of ${fmt(sweep.samples, 9)} analysed, ${words(sweep.sampler)}`, sweep.failed > 0 ? "bad" : null],
    is_number(sweep.seconds) ? ["A sample takes", time_text(sweep.seconds / Math.max(1, sweep.samples))] : null,
  ];
}

function sweep_first(first, results) {
  const sweep = record(results.sweep), outputs = sweep_outputs(sweep), leading = leading_output(outputs);
  const shown = SWEEP_FIRST.map((name) => outputs.find(([own]) => own === name)).filter(Boolean).slice(0, 4);
  panel(first, { title: "Scatter of the outputs", span: 6, href: "scatter" }, (plot) => plot.append(
    el("div", { class: "small-multiples two" }, ...shown.map(([name, of]) => el("div", {}, draw_histogram(name, of)))),
    el("p", { class: "fine" }, "Full line: mean; dashed: 1 % and 99 % of the samples.")));
  panel(first, { title: leading ? `Causes of the scatter of the ${words(leading)}` : "Causes of the scatter", span: 6, href: "indices" },
    (plot) => draw_tornado(plot, record(record(record(sweep.statistics)[leading]).indices), 9, sweep.sampler === "grid"));
  panel(first, { title: leading ? `How sure: ${words(leading)}` : "How sure", span: 8, href: "scatter" }, (plot) => plot.append(facts(sweep_facts(sweep))));
  panel(first, { title: "What it costs", span: 4, href: "effects" }, (plot) => cost_panel(plot, results));
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

function fit_first(first, results) {
  for (const fit of list(results.fit).map(record)) {
    panel(first, { title: `${fit_title(fit)}: residuals`, span: list(results.fit).length > 1 ? 6 : 7, href: "residuals" }, (plot) => draw_residual_shares(plot, fit));
    if (list(results.fit).length > 1) continue;
    panel(first, { title: "What it costs", span: 5, href: "residuals" }, (plot) => {
      const elements = record(fit.finite_elements);
      plot.append(facts([["Status", fit.status], ["Coefficients", fmt(fit.coefficients)], ["Unknowns", fmt(elements.unknowns, 9)],
        ["Mesh and factorisation", time_text(elements.model_seconds)], ["Loads solved", time_text(elements.loads_seconds)], ["Fit", time_text(fit.fit_seconds)]]));
    });
  }
}

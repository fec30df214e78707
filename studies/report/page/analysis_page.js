// The first screen of an analysis: its panels in order.

/** The headline quantities of a load case with their estimated errors. */
function known_to_panel(plot, results, selection) {
  const summary = summary_of(final_entry(selection.current));
  const shown = QUANTITIES.filter((of) => of.is_headline && of.has_error && is_number(quantity_in(summary, of)));
  const rows = shown.map((of) => [capital(of.name), `${with_error(quantity_in(summary, of), quantity_in(summary, of, "_error"), 4)} ${of.unit}`]);
  const estimated = shown.some((of) => is_number(quantity_in(summary, of, "_error")));
  const change = record(summary.te_convergence).harmonic_change_um, life = life_facts(results);
  plot.append(facts([...rows, is_number(change) ? ["Twice the positions", `change the harmonics by at most ${fmt(change, 2)} µm`] : null,
    estimated ? ["±", "estimated discretisation error"] : ["Discretisation", "its error was not estimated"],
    ...(life.length > 0 ? [["Life", "the worst of all load cases:"], ...life] : [])]));
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

const ANALYSIS_PAGE = {
  headline: analysis_headline,
  tiles: (results, cases) => [...loaded_tiles(cases), ...pair_tiles(results)],
  first: (first, results, selection) => {
    if (selection.cases.length > 0) analysis_first(first, results, selection);
    else if (results.unloaded) unloaded_first(first, results);
  },
};

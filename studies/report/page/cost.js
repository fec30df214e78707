// The cost of a run: analyses, seconds, time of the first run of a pair alone, and the resolutions.

const STEP_WORDS = {
  load_distribution: "loaded contact", edge_contact: "tip edges", proof_of_the_optimum: "assessment", effect_sizes: "sizes of effects", finite_elements: "finite elements",
  fit_of_pinion: "fit of the pinion", fit_of_wheel: "fit of the wheel", accuracy_ladder: "all fidelity levels", samples: "samples",
  before_and_after: "before and after", front: "front",
};
/** Steps whose result is kept: a second run of the same pair does not repeat them. */
const KEPT_STEPS = ["finite_elements", "fit_of_pinion", "fit_of_wheel"];

function draw_steps(plot, results) {
  const steps = list(results.steps).map(record).filter((step) => is_number(step.seconds));
  const whole = results.seconds;
  if (!(whole > 0) || steps.length === 0) return;
  const rest = whole - steps.reduce((sum, step) => sum + step.seconds, 0);
  const label = (step) => (results.optimise && step.name === "load_distribution" ? "search" : STEP_WORDS[step.name] ?? words(step.name));
  const rows = [...steps.map((step) => ({ label: label(step), seconds: step.seconds, kept: KEPT_STEPS.includes(step.name), why: step.why })),
    ...(rest > 0.01 * whole ? [{ label: "everything else", seconds: rest }] : [])]
    .filter((row) => row.seconds > 0.005 * whole).sort((a, b) => b.seconds - a.seconds).slice(0, 6);
  const width = Math.max(240, plot.clientWidth || 320), row_height = 18, left = Math.min(0.5 * width, 16 + 7.2 * Math.max(...rows.map((row) => row.label.length)));
  const picture = svg("svg", { viewBox: `0 0 ${width} ${row_height * rows.length + 2}`, width: "100%", role: "img", "aria-label": "Seconds of each step" });
  rows.forEach((row, i) => {
    const y = row_height * i, size = ((width - left - 60) * row.seconds) / rows[0].seconds;
    picture.append(svg("text", { x: left - 8, y: y + 13, "text-anchor": "end", class: "small" }, row.label),
      svg("rect", { x: left, y: y + 4, width: Math.max(1, size), height: 10, rx: 2, fill: css_colour(row.kept ? "axis" : "after") }, svg("title", {}, `${row.why ?? row.label}${row.kept ? "; kept for later runs" : ""}`)),
      svg("text", { x: left + size + 6, y: y + 13, class: "muted" }, time_text(row.seconds)));
  });
  plot.append(picture);
}

/** "graded 8, 32 positions": a resolution in words. */
function resolution_words(of) {
  const { rule, intervals } = record(of.quadrature);
  const parts = [rule ? `${rule} ${fmt(intervals)}` : null, is_number(of.positions) ? `${fmt(of.positions)} positions` : null,
    is_number(of.milliseconds_per_cycle) ? `${fmt(of.milliseconds_per_cycle, 2)} ms a cycle` : null];
  return parts.filter(Boolean).join(", ");
}

function resolution_facts(results) {
  const used = record(results.used), fidelity = record(used.fidelity), { search, assessed, confirmed, searches } = record(record(results.optimise).assessment);
  const compliance = fidelity.compliance && (list(results.loaded).length > 0 || results.sweep) ? ["Compliance", words(fidelity.compliance)] : null;
  const quadrature = compliance ? fidelity.quadrature : null;  // without a load nothing is integrated
  if (!search && !assessed) return [compliance, ["Resolution", resolution_words({ quadrature, positions: record(used.cycle).positions }) || null]];
  return [compliance,
    search ? ["Searched at", resolution_words(record(search))] : null,
    confirmed ? ["Finished at", resolution_words(record(record(confirmed).finished))] : null,
    assessed ? ["Shown at", resolution_words(record(assessed))] : null,
    searches > 1 ? ["Searches", `${fmt(searches)}, each finer than the one before`] : null];
}

function cost_panel(plot, results) {
  const optimise = record(results.optimise), scenes = list(optimise.scenes).length, steps = list(results.steps).map(record);
  const kept = steps.filter((step) => KEPT_STEPS.includes(step.name)).reduce((sum, step) => sum + (step.seconds ?? 0), 0);
  plot.append(facts([
    ["This run", time_text(results.seconds), "strong"],
    is_number(optimise.evaluations) ? ["Analyses", `${fmt(optimise.evaluations, 7)}${scenes > 1 ? ` of up to ${scenes} scenes` : ""}, ${optimise.solver ?? ""}`] : null,
    kept > 0.01 * results.seconds ? ["First run only", time_text(kept)] : null,
    ...resolution_facts(results),
  ]));
  draw_steps(plot, results);
}

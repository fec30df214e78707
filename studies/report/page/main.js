// Fills the sections of the page. An error is reported in its section and does not affect the others.

const BUILDERS = {
  accuracy: build_accuracy,
  scatter: build_scatter,
  indices: build_indices,
  "response-maps": build_response_maps,
  "transmission-error": build_transmission_error,
  scenes: build_scenes,
  comparison: build_comparison,
  validation: build_validation,
  governing: build_governing,
  sensitivity: build_sensitivity,
  "flank-load": build_flank_load,
  life: build_life,
  modifications: build_modifications,
  stiffness: build_stiffness,
  gradients: build_gradients,
  convergence: build_convergence,
  search: build_search,
  "load-cases": build_load_cases,
  unloaded: build_unloaded,
  "gear-pair": build_gear_pair,
  effects: build_effects,
  notes: build_notes,
  deflections: build_deflections,
  residuals: build_residuals,
  inputs: build_inputs,
  drawing: build_drawing,
  tolerances: build_tolerances,
};

function main() {
  const results = JSON.parse(document.getElementById("results").textContent);
  learn_names(results.names);
  learn_quantities(results.quantities);
  const cases = load_cases(results);
  const selection = case_selection(cases, governing_case(cases, results), first_case_remark(results));
  draw_summary(results, cases);
  draw_first_screen(results, selection);
  for (const [id, build] of Object.entries(BUILDERS)) {
    const body = document.querySelector(`#${id} > .body`);
    if (!body) continue;
    try {
      build(results, body, selection);
    } catch (failure) {
      body.append(el("p", { class: "banner bad" }, `This section could not be built: ${failure.message}`));
      console.error(failure);
    }
  }
  start_theme();

  // Maps and drawings are as wide as the page when drawn; follow it.
  let width = document.documentElement.clientWidth, waiting = null;
  addEventListener("resize", () => {
    if (document.documentElement.clientWidth === width) return;
    width = document.documentElement.clientWidth;
    clearTimeout(waiting);
    waiting = setTimeout(redraw_all, 150);
  });
}

main();

// Fills the sections of the page. An error is reported in its section and does not affect the others.

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

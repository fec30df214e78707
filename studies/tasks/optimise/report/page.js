// What an optimisation adds to the page.

function variable_table(body, results) {
  const optimise = record(results.optimise);
  const before = record(optimise.before), after = record(optimise.after);
  const varied = unique([...Object.keys(record(before.variables)), ...Object.keys(record(after.variables))]);
  const names = [...[...NAMES.keys()].filter((name) => varied.includes(name)), ...varied.filter((name) => !NAMES.has(name))];
  if (names.length === 0) return;
  const units = { ...record(before.variable_units), ...record(after.variable_units) }, share = normal_share(results);
  table(body, {
    title: "Design variables",
    note: amounts_count(results),
    columns: [{ label: "Variable" }, { label: "Before" }, { label: "After" }, { label: "Change" }, ...(share === null ? [] : [{ label: "After, normal" }]), { label: "Unit" }],
    rows: names.map((name) => {
      const from = record(before.variables)[name], to = record(after.variables)[name], unit = units[name];
      const cell = (value) => ({ value: settled(value, unit), text: ground(value, grinding_step(results, name, unit)) });
      const normal = share === null ? [] : [unit === "um" ? { value: settled(share * to, unit), text: ground(share * to, 0.1) } : null];
      return [words(name), cell(from), cell(to), is_number(from) && is_number(to) ? cell(to - from) : null, ...normal, pretty_unit(unit)];
    }),
  });
}

function optimise_first(first, results, selection) {
  const optimise = record(results.optimise);
  panel(first, { title: optimise.status === "infeasible" ? "Nearest design: exceeds limits" : "What to grind", span: 5, href: "modifications" }, (plot) => grinding_table(plot, results));
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

add_task_page({ key: "optimise", headline: optimise_headline, verdict: optimise_verdict, first: optimise_first, design_table: variable_table });

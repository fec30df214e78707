// Validation of the design on fresh draws from the tolerances, which the search has not used.

function build_validation(results, body) {
  const optimise = record(results.optimise), validation = record(optimise.validation);
  const unit = pretty_unit(optimise.objective_unit), name = words(optimise.objective_name);
  const designs = list(validation.designs).map(record), edges = numbers(validation.bin_edges);
  const colours = [design_colour("before"), design_colour("after"), sequence_colour(2)];
  body.append(el("p", { class: "remark" }, pretty_unit(validation.words).replace(/->/g, "→")
    + (optimise.status === "infeasible" ? ` This compares the ${name} alone: no design was found that keeps the limits.` : "")));
  const middles = edges.slice(1).map((edge, i) => fmt((edge + edges[i]) / 2));
  figure(figure_grid(body), {
    title: `${capital(name)} over ${fmt(validation.samples, 7)} draws`,
    wide: true,
    caption: "Frequency of each value. A draw is one pair of gears in one housing.",
  }, (plot) => bar_chart(plot, {
    label: "Histogram over the draws", labels: middles, x: unit ? `${name} [${unit}]` : name, y: "draws", unit: "draws",
    series: designs.map((design, i) => ({ label: design.name, values: list(design.histogram), colour: colours[i % colours.length] })),
  }));
  const quantile = (design, i) => record(list(design.quantiles)[i]).value ?? null;
  const shares = list(record(designs[0]).quantiles).map(record).map((q) => `${fmt(100 * q.share)} % below`);
  table(body, {
    title: `${capital(name)} over the draws${unit ? ` [${unit}]` : ""}`,
    columns: [{ label: "Design" }, { label: "Mean" }, { label: "Deviation" }, { label: "Least" }, ...shares.map((label) => ({ label })), { label: "Largest" }, { label: "Failed" }],
    rows: designs.map((d) => [d.name, d.mean, d.deviation, d.least, ...shares.map((_, i) => quantile(d, i)), d.greatest, d.failed]),
  });
  // With scatter in the search its section has the same list.
  if (!scatter_of(optimise)) tolerances_table(body, list(validation.tolerances).map(record));
}

add_sections({ validation: build_validation });

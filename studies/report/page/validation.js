// Validation of the design on fresh scenes, drawn from the tolerances and not used by the optimiser.

function build_validation(results, body) {
  const optimise = record(results.optimise), validation = record(optimise.validation);
  const unit = pretty_unit(optimise.objective_unit), name = words(optimise.objective_name);
  const designs = list(validation.designs).map(record), edges = numbers(validation.bin_edges);
  const colours = [design_colour("before"), design_colour("after"), sequence_colour(2)];
  body.append(el("p", { class: "remark" }, pretty_unit(validation.words).replace(/->/g, "→")));
  const middles = edges.slice(1).map((edge, i) => fmt((edge + edges[i]) / 2));
  figure(figure_grid(body), {
    title: `${capital(name)} over ${fmt(validation.samples, 7)} drawn scenes`,
    wide: true,
    caption: "Frequency of each value in scenes that the optimiser has not seen, drawn from: "
      + `${list(validation.tolerances).map(record).map((t) => `${words(t.name)} ${t.distribution}`).join("; ")}.`,
  }, (plot) => bar_chart(plot, {
    label: "Histogram over the drawn scenes", labels: middles, x: unit ? `${name} [${unit}]` : name, y: "scenes", unit: "scenes",
    series: designs.map((design, i) => ({ label: design.name, values: list(design.histogram), colour: colours[i % colours.length] })),
  }));
  const quantile = (design, i) => record(list(design.quantiles)[i]).value ?? null;
  const shares = list(record(designs[0]).quantiles).map(record).map((q) => `${fmt(100 * q.share)} % below`);
  table(body, {
    title: "Over the drawn scenes",
    columns: [{ label: "Design" }, { label: "Mean", unit }, { label: "Deviation", unit }, { label: "Least", unit },
      ...shares.map((label) => ({ label, unit })), { label: "Largest", unit }, { label: "Failed" }],
    rows: designs.map((d) => [d.name, d.mean, d.deviation, d.least, ...shares.map((_, i) => quantile(d, i)), d.greatest, d.failed]),
  });
}

// The optimum compared with designs found without an optimiser: rules of thumb and a full-factorial search.

/** Designs that the optimum is compared with: [{name, objective, feasible, kind, basis, design}], best first. */
function compared_designs(optimise) {
  const comparison = record(optimise.comparison);
  const rules = list(comparison.rules).map(record).map((rule) => ({ ...rule, kind: "rule" }));
  const variants = list(comparison.variants).map(record).filter((search) => search.best)
    .map((search) => ({ ...record(search.best), kind: "variants",
      name: `best of ${fmt(search.tried, 7)} variants, ${search.levels_from}` }));
  const order = (design) => (is_number(design.objective) ? design.objective : Infinity);
  return [...rules, ...variants].sort((a, b) => order(a) - order(b));
}

const modifications_in_words = (design) => list(design.modifications).map(record)
  .map((m) => `${words(m.name)} ${fmt(m.value, 3)} ${pretty_unit(m.unit)}`).join(", ") || "none";

function comparison_caption(comparison) {
  const basis = record(comparison.basis);
  const parts = [];
  if (is_number(basis.torque_Nm)) {
    parts.push(`The rules work with the largest torque of the scenes, ${fmt(basis.torque_Nm)} N·m, the largest misalignment, `
      + `${fmt(basis.misalignment_um, 3)} µm, the mean deflection of the teeth after ISO 6336-1, ${fmt(basis.mean_deflection_um, 3)} µm, `
      + `and that of a single pair, ${fmt(basis.single_pair_deflection_um, 3)} µm.`);
  }
  for (const search of list(comparison.variants).map(record)) {
    const levels = Object.values(record(search.levels)).join(" × ");
    parts.push(`Full-factorial search, levels ${search.levels_from}: ${levels} = ${fmt(search.tried, 7)} analyses of all scenes in `
      + `${fmt(search.seconds, 2)} s.`);
  }
  return parts.join(" ");
}

function build_comparison(results, body) {
  const optimise = record(results.optimise), after = record(optimise.after);
  const unit = pretty_unit(optimise.objective_unit), name = words(optimise.objective_name);
  const designs = compared_designs(optimise);
  // Of the design that the others are compared with, over the listed scenes: before gears were drawn where they were.
  const value = record(optimise.comparison).optimum_objective ?? after.objective;
  const note = (other) => percent_change(value, other);
  // Without a design that keeps the constraints the one shown is no optimum.
  const infeasible = optimise.status === "infeasible", shown = infeasible ? "design shown" : "optimum";
  if (optimise.scatter && typeof optimise.assessed_design === "string") body.append(el("p", { class: "fine" }, `The optimum here is ${optimise.assessed_design}.`));
  figure(figure_grid(body), {
    title: `${capital(name)} of the ${shown} and other designs`,
    wide: true,
    caption: `All designs are analysed over the same scenes. A rule may use modifications that the study does not vary. ${comparison_caption(record(optimise.comparison))} Hollow bars violate a constraint.`,
  }, (plot) => draw_bars(plot, {
    label: "Objective of every design compared", unit,
    rows: [{ label: shown, value, colour: design_colour("after"), hollow: infeasible, note: `${fmt(value)} ${unit}` },
      ...designs.map((design) => ({ label: design.name, value: design.objective, hollow: design.feasible === false,
        colour: design.kind === "rule" ? design_colour("before") : sequence_colour(2), note: note(design.objective) }))],
  }));
  table(body, {
    title: "Designs compared",
    columns: [{ label: "Design" }, { label: capital(name), unit }, { label: `Compared with the ${shown}` }, { label: "Constraints met" },
      { label: "Modifications" }, { label: "Basis" }],
    rows: designs.map((design) => [design.name, design.objective ?? null, note(design.objective),
      design.failure ? design.failure : design.feasible ? "yes" : "no", modifications_in_words(design), in_symbols(design.basis || "–")]),
  });
}

add_sections({ comparison: build_comparison });

// The active conditions at the optimum, and the change of the objective by a step of each variable and tolerance.

/** Says which design a section is about, where that is not the one shown. */
function name_assessed_design(optimise, body) {
  if (typeof optimise.assessed_design === "string") body.append(el("p", { class: "fine" }, `Of ${optimise.assessed_design}, not of the design shown:`));
}

function build_governing(results, body) {
  const optimise = record(results.optimise), governing = record(optimise.governing);
  if (list(governing.words).length > 0) name_assessed_design(optimise, body);
  body.append(el("ul", { class: "statements" }, ...list(governing.words).map((sentence) => el("li", {}, pretty_unit(sentence)))));
  const usual = record(optimise.usual_signs);
  if (typeof usual.words === "string") body.append(el("p", { class: "banner" }, pretty_unit(usual.words)));
  const residual = governing.residual;
  if (!is_number(residual)) return;
  body.append(el("p", { class: "remark" }, "Weights and gains are the multipliers that balance the exact derivatives of all "
    + `conditions active at this design. The remainder is ${residual < 1e-6 ? "less than 0.0001" : fmt(100 * residual, 2)} % of the start's objective over the range of a `
    + `variable. Gains below ${fmt(governing.resolution, 2)} ${pretty_unit(governing.objective_unit)} are treated as zero.${residual > 1e-3 ? " The remainder is large: the design lies at a kink of another kind, or the search has not converged." : ""}`));
}

/** Rows of a tornado, the widest first: a bar for a step down and one for a step up. */
function tornado_rows(entries) {
  const size = (s) => Math.max(0, ...numbers([s.less, s.more]).map(Math.abs));
  const allowed = (s, side) => record(s.within_bounds)[side] !== false;
  return [...entries].sort((a, b) => size(b) - size(a)).map((s) => {
    const step = `${fmt(s.step, 3)} ${pretty_unit(s.unit)}`;
    const bars = [
      { value: s.less, colour: sequence_colour(0), what: `${step} less`, hollow: !allowed(s, "less") },
      { value: s.more, colour: sequence_colour(1), what: `${step} more`, hollow: !allowed(s, "more") },
    ];
    return { label: `${words(s.name)}, ${step}`, bars, values: [s.less, s.more] };
  });
}

const tornado_key = () => el("p", { class: "key" },
  el("span", { class: "dot", style: `background:${sequence_colour(0)}` }), " a step less   ",
  el("span", { class: "dot", style: `background:${sequence_colour(1)}` }), " a step more");

function build_sensitivity(results, body) {
  const optimise = record(results.optimise);
  const governing = record(optimise.governing);
  const round_off = governing.resolution ?? 1e-9 * Math.abs(record(optimise.after).objective);
  const shown = (change) => (!is_number(change) ? null : Math.abs(change) < round_off ? 0 : change);
  const unit = pretty_unit(governing.objective_unit ?? optimise.objective_unit), name = words(governing.objective_name ?? optimise.objective_name);
  const entries = list(optimise.sensitivity).map(record);
  const intervals_of = (kind) => record(entries.find((s) => s.kind === kind)).intervals;
  const [of_variables, of_tolerances] = [intervals_of("variable"), intervals_of("tolerance")];
  const by_fewer = of_tolerances < of_variables ? ` Tolerances are analysed by ${of_tolerances} intervals along each contact line, variables by ${of_variables}.` : "";
  name_assessed_design(optimise, body);
  const grid = figure_grid(body);
  const draw = (kind, title, caption) => {
    const of_kind = entries.filter((s) => s.kind === kind);
    if (of_kind.length === 0) return;
    figure(grid, { title, caption }, (plot) => {
      plot.append(tornado_key());
      draw_bars(plot, { rows: tornado_rows(of_kind), unit, label: title });
    });
  };
  draw("variable", "A step of each variable",
    `Change of the ${name} to first order, kinks included, with all other variables fixed. At an optimum no step within bounds and limits reduces it. `
    + "Hollow bars leave the bounds.");
  draw("tolerance", "A step of each tolerance",
    `Change of the ${name} by this deviation of housing, manufacture or load in every scene, with unchanged flanks.${by_fewer}`);
  table(body, {
    title: "Sensitivity of the optimum",
    note: "The last column is to first order for a design that is optimised anew after the step.",
    columns: [{ label: "Quantity" }, { label: "Step" }, { label: "Step unit" }, { label: "A step less", unit }, { label: "A step more", unit },
      { label: "A step more, optimised anew", unit }],
    rows: entries.map((s) => [words(s.name), s.step, pretty_unit(s.unit), shown(s.less), shown(s.more),
      shown(s.more_optimised_anew)]),
  });
}

add_sections({ governing: build_governing, sensitivity: build_sensitivity });

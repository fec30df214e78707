// Gradients of the outputs of each load case by the parameters of analyse.gradients: bars for a step of each, and derivatives in numbers.

const gradients_of = (load_case) => record(final_entry(load_case).gradients);

/** A practical step of a parameter, in its unit. */
function parameter_step(unit, torque) {
  if (unit === "N·m" && is_number(torque)) return 0.01 * torque;
  return unit === "mm" ? 0.1 : 1;
}

/** The quantities of a summary that are shown, with bars for the main ones. */
const gradient_outputs = () => [
  ...QUANTITIES.filter((of) => of.is_headline).map((of) => ({
    column: { label: capital(of.name), unit: of.unit }, of: (s) => quantity_in(s, of), bars: ["te_peak_to_peak_um", "peak_contact_stress_MPa", "peak_root_stress_MPa"].includes(of.key),
  })),
  { column: { label: "K_H" }, of: (s) => record(record(s.load_factors).without_spikes).K_H },
];

/** Bars of one output, the longest first. */
function gradient_rows(load_case, output) {
  const gradients = gradients_of(load_case), slopes = list(output.of(record(gradients.summary))), value = output.of(summary_of(final_entry(load_case)));
  return list(gradients.parameters).map((name, i) => {
    const unit = list(gradients.units)[i], step = parameter_step(unit, load_case.torque);
    const change = is_number(slopes[i]) ? slopes[i] * step : null;
    return {
      label: `${words(name)}, ${fmt(step, 3)} ${pretty_unit(unit)}`, value: change, colour: sequence_colour(1),
      note: is_number(change) ? percent_change(value, value + change) ?? "" : "",
    };
  }).filter((row) => is_number(row.value)).sort((a, b) => Math.abs(b.value) - Math.abs(a.value));
}

function build_gradients(results, body, selection) {
  selection.add_choice(body);
  const cases = selection.cases.filter((load_case) => list(gradients_of(load_case).parameters).length > 0);
  const known = (output) => cases.some((load_case) => list(output.of(record(gradients_of(load_case).summary))).some(is_number));
  const outputs = gradient_outputs().filter(known), grid = figure_grid(body);
  for (const output of outputs.filter(({ bars }) => bars)) {
    const { label, unit } = output.column;
    case_figure(grid, selection, {
      title: `${label}: a step more of each parameter`,
      caption: "Change to first order with all other parameters fixed. It is exact while no contact point opens or closes and the peak stays at its point.",
    }, (plot, load_case) => {
      const rows = gradient_rows(load_case, output);
      if (rows.length > 0) draw_bars(plot, { rows, unit, label });
    });
  }
  table(body, {
    title: "In numbers, per unit of the parameter",
    note: "Derivatives are in the unit of the output per unit of the parameter; K_H is without spikes. results.json has the derivatives of all other outputs and points.",
    columns: [{ label: "Scene" }, { label: "Torque", unit: "N·m", digits: 6 }, { label: "Parameter" }, { label: "per" }, ...outputs.map(({ column }) => column)],
    rows: cases.flatMap((load_case) => {
      const { parameters, units, summary } = gradients_of(load_case);
      return list(parameters).map((name, i) => [load_case.scene, load_case.torque, words(name), pretty_unit(list(units)[i]),
        ...outputs.map((output) => list(output.of(record(summary)))[i] ?? null)]);
    }),
  });
}

add_sections({ gradients: build_gradients });

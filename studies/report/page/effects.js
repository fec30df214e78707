// The effects with their reasons and sizes, and the time of the run.

const effect_measures = [
  { title: "Effect on the mean transmission error", key: "te_mean_change_um", unit: "µm" },
  { title: "Effect on its peak to peak", key: "te_peak_to_peak_change_um", unit: "µm" },
  { title: "Effect on the peak contact stress", key: "peak_contact_stress_change_percent", unit: "%" },
];

const without_round_off = (value, round_off) => (is_number(value) && Math.abs(value) <= round_off ? 0 : value);

/** Bars of one measure, a row for each effect: the exact value by leaving it out, and the estimate. */
function effect_rows(effects, key) {
  const sides = [{ from: "exact", what: "left out", colour: sequence_colour(0) }, { from: "estimate", what: "estimate", colour: sequence_colour(1) }]
    .filter((side) => effects.some((effect) => effect[side.from]));
  const value_of = (effect, side) => record(effect[side.from])[key] ?? null;
  const all = effects.flatMap((effect) => sides.map((side) => value_of(effect, side)));
  const round_off = 1e-12 * maximum(all.filter(is_number).map(Math.abs));  // left by an effect that changes nothing
  return effects.map((effect) => {
    const bars = sides.map((side) => ({ ...side, value: without_round_off(value_of(effect, side), round_off) }));
    return { label: words(effect.name), bars, values: bars.map((bar) => bar.value), note: bars.map((bar) => fmt(bar.value, 3)).join(" / ") };
  });
}

/** Limit of the bars: where one row is more than ten times as long as the next, one and a half of the next, so that the others stay visible. */
function bar_limit(rows) {
  const lengths = rows.map((row) => Math.max(0, ...row.values.filter(is_number).map(Math.abs))).sort((a, b) => b - a);
  return lengths.length > 1 && lengths[1] > 0 && lengths[0] > 10 * lengths[1] ? 1.5 * lengths[1] : Infinity;
}

function time_figure(results, entries, grid) {
  const timed = entries.filter((entry) => entry.seconds > 0);
  if (!(results.seconds > 0) || timed.length === 0) return;
  const title = "Fraction of the time";
  figure(grid, { title, caption: `Fraction of ${fmt(results.seconds, 3)} s, for the work of effects on building meshes, all threads together, and for the steps of the run, `
    + "which include this work." }, (plot) => draw_bars(plot, { unit: "%", label: title, rows: timed.map((entry) => {
    const share = (100 * entry.seconds) / results.seconds;
    return { label: words(entry.name), value: share, colour: sequence_colour(entry.on ? 0 : 2), note: fmt(share, 2) };
  }) }));
}

function effect_figures(results, effects, steps, body) {
  const sized = effects.filter((effect) => effect.exact || effect.estimate);
  const is_exact = sized.some((effect) => effect.exact);
  const grid = figure_grid(body);
  for (const { title, key, unit } of sized.length > 0 ? effect_measures : []) {
    const rows = effect_rows(sized, key), limit = bar_limit(rows);
    figure(grid, { title,
      caption: `Result with the effect minus result without it, in the load case with the largest difference${is_exact ? "; exact by leaving it out" : ""}. `
        + `The estimate uses at most 32 positions, to first order where this is valid.${limit < Infinity ? " The broken bar continues beyond the axis." : ""}` }, (plot) => {
      plot.append(el("p", { class: "key" },
        ...(is_exact ? [el("span", { class: "dot", style: `background:${sequence_colour(0)}` }), " left out   "] : []),
        el("span", { class: "dot", style: `background:${sequence_colour(1)}` }), " estimate"));
      draw_bars(plot, { rows, unit, label: title, limit });
    });
  }
  time_figure(results, [...effects, ...steps], grid);
}

const time_cell = (seconds, longest) => (is_number(seconds) ? {
  value: seconds,
  text: fmt(seconds, 3),
  draw: () => el("span", { class: "time" }, fmt(seconds, 3),
    el("i", { style: `width:${longest > 0 && seconds > 0 ? Math.max(1, (60 * seconds) / longest) : 0}px` })),
} : null);

function build_effects(results, body) {
  const effects = list(results.effects).map(record), steps = list(results.steps).map(record);
  const longest = Math.max(0, maximum([...effects, ...steps].map((entry) => entry.seconds)));
  effect_figures(results, effects, steps, body);
  // In per cent of the run's own result: values below 1e-10 are round-off.
  const share = (effect) => without_round_off(record(effect.exact || effect.estimate).share_percent ?? null, 1e-10);
  table(body, {
    title: "Effects in this run",
    note: "Effects of the mesh with the reason for being on or off. The size is the largest contribution to mean deflection, variation and stress. "
      + "The time is that of the effect's own code; an effect that is off takes none.",
    columns: [{ label: "Effect" }, { label: "On" }, { label: "Why" }, { label: "Size", unit: "%", digits: 3 }, { label: "Time", unit: "s" }],
    rows: effects.map((effect) => [words(effect.name), { text: effect.on ? "yes" : "no", class: effect.on ? "good" : "off" },
      effect.why ?? "", share(effect), time_cell(effect.seconds, longest)]),
  });
  if (steps.length === 0) return;
  table(body, {
    title: "Time of the steps",
    columns: [{ label: "Step" }, { label: "Work" }, { label: "Time", unit: "s" }],
    rows: steps.map((step) => [words(step.name), step.why ?? "", time_cell(step.seconds, longest)]),
  });
}

add_sections({ effects: build_effects });

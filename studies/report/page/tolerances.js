// The search over drawn gears: what it gains, how well it predicts, and what each tolerance class costs.

function build_tolerances(results, body) {
  const scatter = record(record(results.optimise).scatter), unit = pretty_unit(scatter.unit), fresh = record(scatter.fresh);
  const without = record(scatter.without_scatter), predicted = record(scatter.predicted);
  const interval = is_number(predicted.low) && is_number(predicted.high)
    ? ` With ${fmt(100 * predicted.confidence, 3)} % confidence it lies between ${fmt(predicted.low, 4)} and ${fmt(predicted.high, 4)} ${unit}.` : "";
  table(body, {
    title: `${capital(`${scatter.statistic_in_words}`)} over the draws`,
    note: `${fmt(scatter.draws, 5)} draws, the same for every design; the search took ${fmt(scatter.seconds, 2)} s, that without scatter before it ${fmt(without.seconds, 2)} s. Over the draws of the search its own design is the best of many, and so a little better than others will be.`
      + (is_number(predicted.value) ? ` The prediction is from ${fmt(predicted.draws, 5)} draws that the search has not seen.${interval}` : "")
      + (is_number(fresh.prediction_error_percent) ? ` Beside ${fmt(fresh.draws, 5)} fresh draws it is ${fmt(Math.abs(fresh.prediction_error_percent), 2)} % off.` : ""),
    columns: [{ label: "Design" }, { label: "Draws of the search" }, { label: "Predicted" }, { label: "Fresh draws" }, { label: "Unit" }],
    rows: [["without scatter", without.value, null, "without scatter"], ["with scatter", scatter.value, predicted.value, "after"]].map(([label, value, expected, name]) =>
      [label, value ?? null, expected ?? null, list(fresh.designs).map(record).find((design) => design.name === name)?.statistic ?? null, unit]),
  });
  table(body, {
    title: "What scatters",
    columns: [{ label: "Quantity" }, { label: "Distribution" }],
    rows: list(scatter.tolerances).map(record).map((tolerance) => [words(`${tolerance.name}`), `${tolerance.distribution}${tolerance.added ? ", added" : ""}`]),
  });
  const classes = list(scatter.classes).map(record);
  if (classes.length === 0) return;
  table(body, {
    title: "What a class costs",
    note: "Each row is the design that is right for its class. All figures are the statistic over the draws of that class.",
    columns: [{ label: "ISO 1328-1 class" }, { label: `Objective [${unit}]` }, { label: `Of the design without scatter [${unit}]` }, { label: "Peak contact stress [MPa]" }, { label: "Transmission error, peak to peak [µm]" }],
    rows: classes.map((row) => [row.iso_1328_class, row.value, row.without_scatter_value, row.peak_contact_stress_MPa, row.te_peak_to_peak_um]),
  });
  const grid = figure_grid(body);
  for (const [key, title] of [["peak_contact_stress_MPa", "Peak contact stress [MPa]"], ["te_peak_to_peak_um", "Transmission error, peak to peak [µm]"]]) {
    figure(grid, { title, caption: "Statistic over the draws of each class, of the design that is right for it." }, (plot) => class_plot(plot, classes, key));
  }
}

/** The figure of each class as a line with marks. */
function class_plot(plot, classes, key) {
  const width = plot.clientWidth || 420, height = 220, frame = { left: 56, top: 12, width: width - 72, height: height - 52 };
  const known = classes.filter((row) => is_number(row[key]) && is_number(row.iso_1328_class));
  const grades = known.map((row) => row.iso_1328_class), values = known.map((row) => row[key]);
  const ticks = round_ticks(minimum(values), maximum(values), 5), low = Math.min(minimum(values), ...ticks), high = Math.max(maximum(values), ...ticks, low + 1e-9);
  const first = minimum(grades), last = Math.max(maximum(grades), first + 1);
  const to_x = (grade) => frame.left + (frame.width * (grade - first)) / (last - first), to_y = (value) => frame.top + frame.height * (1 - (value - low) / (high - low));
  const { canvas, pen } = sharp_canvas(width, height, `${words(key)} over the tolerance class`);
  pen.strokeStyle = pen.fillStyle = getComputedStyle(document.body).color;
  pen.font = "12px sans-serif";
  pen.strokeRect(frame.left, frame.top, frame.width, frame.height);
  pen.textAlign = "right";
  for (const tick of ticks) pen.fillText(fmt(tick, 4), frame.left - 6, to_y(tick) + 4);
  pen.textAlign = "center";
  for (const grade of grades) pen.fillText(`${grade}`, to_x(grade), frame.top + frame.height + 16);
  pen.fillText("ISO 1328-1 class", frame.left + 0.5 * frame.width, frame.top + frame.height + 34);
  pen.strokeStyle = pen.fillStyle = "#0072b2";
  pen.beginPath();
  known.forEach((row, i) => (i === 0 ? pen.moveTo(to_x(grades[i]), to_y(values[i])) : pen.lineTo(to_x(grades[i]), to_y(values[i]))));
  pen.stroke();
  known.forEach((row, i) => pen.fillRect(to_x(grades[i]) - 3, to_y(values[i]) - 3, 6, 6));
  plot.append(canvas);
}

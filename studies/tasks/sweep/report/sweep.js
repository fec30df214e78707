// A sweep: how every output scatters over the samples, the contribution of each parameter, and the mean over two of them.

const sweep_unit = (unit) => (unit === "-" ? "" : pretty_unit(unit));
const output_cell = (name) => ({ text: words(name), draw: () => symbols(words(name)) });

/** [[name, statistics]] of the outputs that some sample has. */
const sweep_outputs = (sweep) => list(sweep.outputs).map((name) => [name, record(record(sweep.statistics)[name])])
  .filter(([, of]) => of.samples > 0);

/** The main output of a sweep. */
const leading_output = (outputs) => (outputs.find(([name]) => name === "peak_contact_stress_MPa") || outputs[0] || [""])[0];

/** From here on one sample is no more than a per cent of all. */
const SAMPLES_OF_A_PERCENT = 100;

function sweep_headline(results) {
  const sweep = record(results.sweep);
  const outputs = sweep_outputs(sweep), name = leading_output(outputs), of = record(record(sweep.statistics)[name]);
  if (!is_number(of.mean)) return "No sample of the sweep has results";
  const unit = sweep_unit(of.unit);
  return `${capital(words(name))} ${fmt(of.mean, 3)} ${unit} on average, σ ${fmt(of.std, 2)} ${unit}; `
    + (of.samples >= SAMPLES_OF_A_PERCENT ? `99 % of ${fmt(of.samples, 9)} samples below ${fmt(record(of.quantiles)["99 %"], 3)} ${unit}`
      : `worst of ${fmt(of.samples, 9)} samples ${fmt(record(of.worst).value, 3)} ${unit}`);
}

function sweep_tiles(results) {
  const sweep = record(results.sweep);
  const shown = ["peak_to_peak_arcsec", ...QUANTITIES.filter((of) => of.is_headline && !of.smaller_is_worse).map((of) => of.key)];
  const tiles = sweep_outputs(sweep).filter(([name]) => shown.includes(name)).map(([name, of]) =>
    tile(`${capital(words(name))}, mean`, of.mean, sweep_unit(of.unit),
      { detail: `σ ${fmt(of.std, 2)}, worst ${fmt(record(of.worst).value, 3)}` }));
  return [...tiles, ...pair_tiles(results)];
}

function sweep_verdict(results, verdict) {
  const sweep = record(results.sweep);
  if (!(sweep.failed > 0)) return;
  const reasons = list(sweep.failures).map(record).slice(0, 3).map((f) => `${fmt(f.count, 9)} × ${f.reason}`);
  verdict.append(el("p", { class: "banner" }, `${fmt(sweep.failed, 9)} of ${fmt(sweep.samples, 9)} samples failed: ${reasons.join("; ")}.`));
}

/** One histogram with mean and the 1 % and 99 % quantiles marked. */
function draw_histogram(name, of) {
  const width = 300, height = 150, left = 8, right = 8, top = 26, bottom = 34;
  const { low, high, counts } = record(of.histogram);
  const bars = numbers(counts), highest = maximum(bars) || 1, unit = sweep_unit(of.unit);
  const all_alike = !(high > low);  // one bar in the middle
  const to_x = (value) => (all_alike ? width / 2 : left + ((width - left - right) * (value - low)) / (high - low));
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, width: "100%", role: "img",
    "aria-label": `Histogram of ${words(name)}` });
  picture.append(svg("text", { x: left, y: 14, "font-weight": 600, "font-size": 13 }, ...subscripts(capital(words(name))), unit ? ` [${unit}]` : ""));
  const bar = (width - left - right) / bars.length;
  bars.forEach((count, i) => {
    const size = ((height - top - bottom) * count) / highest;
    const from = low + ((high - low) * i) / bars.length, to = low + ((high - low) * (i + 1)) / bars.length;
    picture.append(svg("rect", { x: all_alike ? (width - bar) / 2 : left + bar * i, y: height - bottom - size, width: Math.max(bar - 0.8, 0.5), height: size,
      fill: css_colour("after") }, svg("title", {}, `${fmt(from)} … ${fmt(to)} ${unit}: ${fmt(count, 9)} samples`)));
  });
  const quantiles = record(of.quantiles);
  for (const [value, label] of [[quantiles["1 %"], "1 %"], [of.mean, "mean"], [quantiles["99 %"], "99 %"]]) {
    if (!is_number(value)) continue;
    picture.append(svg("line", { x1: to_x(value), x2: to_x(value), y1: top - 4, y2: height - bottom, stroke: css_colour("ink"),
      "stroke-width": 1.2, "stroke-dasharray": label === "mean" ? null : "3 3" }, svg("title", {}, `${label}: ${fmt(value)} ${unit}`)));
  }
  picture.append(svg("line", { x1: left, x2: width - right, y1: height - bottom, y2: height - bottom, class: "grid-line" }));
  for (const tick of all_alike ? [low] : round_ticks(low, high, 4)) {
    picture.append(svg("text", { x: to_x(tick), y: height - bottom + 16, "text-anchor": "middle", class: "muted" }, fmt(tick)));
  }
  return picture;
}

function build_scatter(results, body) {
  const sweep = record(results.sweep), outputs = sweep_outputs(sweep);
  figure(figure_grid(body), {
    title: "Scatter of every output",
    wide: true,
    caption: `Counts over all ${fmt(sweep.samples - sweep.failed, 9)} samples that succeeded; full line: mean, dashed: 1 % and 99 %. The samples `
      + "themselves are in samples.csv and results.sqlite, not in this page.",
  }, (plot) => plot.append(el("div", { class: "small-multiples" }, ...outputs.map(([name, of]) => el("div", {}, draw_histogram(name, of))))));
  table(body, {
    title: "Outputs over the samples",
    columns: [{ label: "Output" }, { label: "Unit" }, { label: "Mean" }, { label: "σ", digits: 3 }, { label: "1 %" }, { label: "Median" },
      { label: "99 %" }, { label: "Worst" }, { label: "in sample", digits: 9 }, { label: "Its study" }],
    rows: outputs.map(([name, of]) => [output_cell(name), sweep_unit(of.unit), of.mean, of.std, record(of.quantiles)["1 %"],
      record(of.quantiles)["50 %"], record(of.quantiles)["99 %"], record(of.worst).value ?? null, record(of.worst).sample ?? null,
      record(of.worst).study ?? null]),
  });
  table(body, {
    title: "Scattered parameters",
    note: `Sampler ${words(sweep.sampler)}, seed ${sweep.seed}; every parameter independent of the others. Sections after the response maps show the `
      + "nominal sample: the values of the study, and medians where it gives none.",
    columns: [{ label: "Parameter" }, { label: "Unit" }, { label: "Distribution" }, { label: "Lowest drawn" }, { label: "Highest drawn" }],
    rows: list(sweep.parameters).map(record).map((p) => [words(p.path), sweep_unit(p.unit), p.distribution, record(p.range).low ?? null,
      record(p.range).high ?? null]),
  });
}

/** A choice that is always there, and redraws. */
function sweep_choice(parent, label, options, state, key, redraw) {
  const { node } = choice(label, options, state[key], (value) => {
    state[key] = value;
    redraw();
  });
  node.classList.add("no-print");
  parent.append(node);
}

/** Total indices as bars, the first-order part filled, both with their standard errors; largest on top. */
function draw_tornado(plot, indices, most = Infinity, of_grid = false) {
  const rows = Object.entries(indices).map(([path, index]) => ({ path, ...record(index) })).filter((row) => is_number(row.total))
    .sort((a, b) => b.total - a.total).slice(0, most);
  if (rows.length === 0) return plot.append(el("p", { class: "caption" }, of_grid ? "A grid has no Sobol indices: the sampler \"sobol\" has."
    : "This output does not vary, or there are too few samples."));
  const width = Math.max(320, plot.clientWidth || 900), row_height = 28, top = 6, bottom = 42;
  const left = Math.min(0.42 * width, 24 + 7 * Math.max(...rows.map((row) => words(row.path).length))), right = 64;
  const height = top + bottom + row_height * rows.length;
  const high = Math.max(1, maximum(rows.map((row) => row.total + (row.total_within_95_percent ?? row.total_error))));
  const to_x = (share) => left + ((width - left - right) * Math.max(0, share)) / high;
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, width: "100%", role: "img", "aria-label": "Sobol indices of every parameter" });
  for (const tick of round_ticks(0, high, 5)) {
    picture.append(svg("line", { x1: to_x(tick), x2: to_x(tick), y1: top, y2: height - bottom, class: "grid-line" }),
      svg("text", { x: to_x(tick), y: height - bottom + 15, "text-anchor": "middle", class: "muted" }, `${fmt(100 * tick)}`));
  }
  picture.append(svg("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle", class: "muted" }, "fraction of the variance [%]"));
  rows.forEach((row, i) => {
    const y = top + row_height * (i + 0.5), per_cent = (share) => fmt(100 * share, 3);
    const whisker = (value, error, at) => svg("line", { x1: to_x(value - error), x2: to_x(value + error), y1: at, y2: at,
      stroke: css_colour("ink"), "stroke-width": 1.2 });
    picture.append(svg("text", { x: left - 10, y: y + 4, "text-anchor": "end" }, words(row.path)),
      svg("rect", { x: left, y: y - 10, width: to_x(row.total) - left, height: 20, fill: faded(css_colour("after"), 0.35) },
        svg("title", {}, `${words(row.path)}: total ${per_cent(row.total)} ± ${per_cent(row.total_error)} %`)),
      svg("rect", { x: left, y: y - 10, width: to_x(row.first) - left, height: 20, fill: css_colour("after") },
        svg("title", {}, `${words(row.path)}: alone ${per_cent(row.first)} ± ${per_cent(row.first_error)} %`)),
      whisker(row.first, row.first_within_95_percent ?? row.first_error, y - 4), whisker(row.total, row.total_within_95_percent ?? row.total_error, y + 4),
      svg("text", { x: to_x(Math.max(row.total + (row.total_within_95_percent ?? row.total_error), row.first + (row.first_within_95_percent ?? row.first_error))) + 8, y: y + 4, class: "muted" },
        `${fmt(100 * row.total, 2)} %`));
  });
  plot.append(el("p", { class: "key" }, el("span", { class: "dot", style: `background:${css_colour("after")}` }), " alone   ",
    el("span", { class: "dot", style: `background:${faded(css_colour("after"), 0.35)}` }), " with its interactions   — 95 % confidence"), picture);
}

function build_indices(results, body) {
  const sweep = record(results.sweep), outputs = sweep_outputs(sweep);
  const state = { output: leading_output(outputs) };
  const options = outputs.map(([name]) => ({ value: name, label: words(name) }));
  figure(figure_grid(body), {
    title: "Contribution of each parameter to the scatter",
    wide: true,
    caption: `Sobol indices from ${fmt(sweep.index_blocks, 9)} blocks of samples: what of an output's variance a parameter has alone, and with its `
      + "interactions with others.",
  }, (plot) => {
    const area = el("div"), choices = el("div");
    const draw = () => {
      area.replaceChildren();
      draw_tornado(area, record(record(record(sweep.statistics)[state.output]).indices), Infinity, sweep.sampler === "grid");
    };
    sweep_choice(choices, "Output", options, state, "output", draw);
    plot.append(choices, area);
    draw();
  });
  if (sweep.index_warning) body.prepend(el("p", { class: "banner" }, sweep.index_warning));
  const parameters = list(sweep.parameters).map(record);
  const shown_total = (total) => (is_number(total) ? (total < 1e-6 ? 0 : 100 * total) : null);
  const with_confidence = (index) => {
    const value = shown_total(index.total), half = 100 * index.total_within_95_percent;
    return is_number(value) && is_number(half) ? { value, text: half < 0.05 ? fmt(value, 2) : `${fmt(value, 2)} ± ${fmt(half, 2)}` } : value;
  };
  table(body, {
    title: "Total Sobol indices",
    note: "Fraction of the variance with all interactions, and the half-width of its 95 % confidence interval; values below a ten-thousandth of a per cent are shown as 0.",
    columns: [{ label: "Output" }, ...parameters.map((p) => ({ label: words(p.path), unit: "%", digits: 2 }))],
    rows: outputs.map(([name, of]) => [output_cell(name),
      ...parameters.map((p) => with_confidence(record(record(of.indices)[p.path])))]),
  });
}

/** Ticks of a map's axis as shares of it, and the value at a share. Each of a few levels has a strip of its own, as wide as the others. */
function response_axis(parameter, title) {
  const { low, high, levels } = parameter.range;
  if (Array.isArray(levels)) {
    const strip = (share) => Math.min(levels.length - 1, Math.floor(share * levels.length));
    return { title, ticks: levels.map((level, i) => ({ share: (i + 0.5) / levels.length, text: fmt(level) })), at: (share) => fmt(levels[strip(share)], 3) };
  }
  const ticks = round_ticks(low, high, 6).map((tick) => ({ share: (tick - low) / (high - low || 1), text: fmt(tick) }));
  return { title, ticks, at: (share) => fmt(low + share * (high - low), 3) };
}

/** A response map on a canvas, with its colour bar and a read-out. */
function draw_response(plot, sweep, state) {
  const parameters = list(sweep.parameters).map(record), of = record(record(sweep.statistics)[state.output]), unit = sweep_unit(of.unit);
  const map = list(sweep.response_maps).map(record).find((m) => m.output === state.output
    && ((m.x === state.x && m.y === state.y) || (m.x === state.y && m.y === state.x)));
  if (!map) return plot.append(el("p", { class: "caption" }, "Choose two different parameters."));
  const rows = list(map.mean), swapped = map.x !== state.x;
  const columns = swapped ? rows.length : list(rows[0]).length;
  const height_parts = swapped ? list(rows[0]).length : rows.length;
  const at = (ix, iy) => (swapped ? rows[ix][iy] : rows[iy][ix]);
  const values = [...Array(height_parts)].flatMap((_, iy) => [...Array(columns)].map((__, ix) => at(ix, iy)));
  const scale = { low: minimum(values), high: maximum(values) };
  const along = (path) => parameters.find((p) => p.path === path);
  const titled = (p) => words(p.path) + (sweep_unit(p.unit) ? ` [${sweep_unit(p.unit)}]` : "");
  const [x, y] = [along(state.x), along(state.y)].map((p) => response_axis(p, titled(p)));
  const height = 380, width = Math.min(720, (plot.clientWidth || 900) - 100), left = 66, top = 26, right = 14, bottom = 44;
  const { canvas, pen } = sharp_canvas(width, height, `Mean ${words(state.output)} over ${x.title} and ${y.title}`);
  const frame = { left, top, width: width - left - right, height: height - top - bottom };
  paint_raster(pen, frame, { columns, rows: height_parts, values }, scale);
  pen.strokeStyle = css_colour("axis");
  pen.strokeRect(frame.left, frame.top, frame.width, frame.height);
  pen.fillStyle = css_colour("muted");
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  for (const { share, text } of x.ticks) pen.fillText(text, left + frame.width * share, top + frame.height + 13);
  pen.fillText(x.title, left + frame.width / 2, top + frame.height + 33);
  pen.textAlign = "right";
  for (const { share, text } of y.ticks) pen.fillText(text, left - 7, top + frame.height * (1 - share));
  pen.save();
  pen.translate(10, top + frame.height / 2);
  pen.rotate(-Math.PI / 2);
  pen.textAlign = "center";
  pen.fillText(y.title, 0, 0);
  pen.restore();
  const read_out = el("p", { class: "read-out" }, "\u00a0");
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    const across = ((event.clientX - box.left) * (width / box.width) - left) / frame.width;
    const up = 1 - ((event.clientY - box.top) * (height / box.height) - top) / frame.height;
    if (across < 0 || across >= 1 || up < 0 || up >= 1) return (read_out.textContent = "\u00a0");
    const mean = at(Math.floor(across * columns), Math.floor(up * height_parts));
    read_out.textContent = `${x.title} ${x.at(across)}, ${y.title} ${y.at(up)}:  `
      + (is_number(mean) ? `${fmt(mean)} ${unit}` : "no sample");
  });
  plot.append(el("div", { class: "maps" }, canvas, colour_bar(scale, unit, height)), read_out);
}

function build_response_maps(results, body) {
  const sweep = record(results.sweep), outputs = sweep_outputs(sweep);
  const mapped = new Set(list(sweep.response_maps).flatMap((map) => [record(map).x, record(map).y]));
  const paths = list(sweep.parameters).map((p) => record(p).path).filter((path) => mapped.has(path));
  const output = leading_output(outputs);
  const weight = (path) => record(record(record(record(sweep.statistics)[output]).indices)[path]).total ?? 0;
  const [first, second] = [...paths].sort((a, b) => weight(b) - weight(a));
  const state = { output, x: first, y: second };
  figure(figure_grid(body), {
    title: "An output over two parameters",
    wide: true,
    caption: "Mean over the samples in each cell of the plane, over all values of the other parameters. Cells without samples are blank."
      + (sweep.sampler === "grid" ? "" : " Of the parameters that are no draws of a gear, the two with the largest total indices are shown first."),
  }, (plot) => {
    const area = el("div"), choices = el("div");
    const draw = () => {
      area.replaceChildren();
      draw_response(area, sweep, state);
    };
    const parameters = paths.map((path) => ({ value: path, label: words(path) }));
    sweep_choice(choices, "Output", outputs.map(([name]) => ({ value: name, label: words(name) })), state, "output", draw);
    sweep_choice(choices, "to the right", parameters, state, "x", draw);
    sweep_choice(choices, "upwards", parameters, state, "y", draw);
    plot.append(choices, area);
    draw();
  });
}

const SWEEP_FIRST = ["peak_contact_stress_MPa", "te_peak_to_peak_um", "peak_root_stress_MPa", "peak_to_peak_arcsec", "load_factor", "mean_stiffness_N_per_mm_um"];

function sweep_facts(sweep) {
  const name = leading_output(sweep_outputs(sweep)), of = record(record(sweep.statistics)[name]), unit = sweep_unit(of.unit);
  const samples = sweep.samples - sweep.failed;
  return [
    is_number(of.std) ? ["Mean of the samples", `${with_error(of.mean, of.std / Math.sqrt(samples), 4)} ${unit}`] : null,
    is_number(record(of.worst).value) ? ["Worst sample", `${fmt(record(of.worst).value, 4)} ${unit}, sample ${fmt(record(of.worst).sample, 9)}`] : null,
    record(of.worst).study ? ["Its study", el("code", {}, record(of.worst).study)] : null,
    ["Samples", `${fmt(samples, 9)} of ${fmt(sweep.samples, 9)} analysed, ${words(sweep.sampler)}`, sweep.failed > 0 ? "bad" : null],
    is_number(sweep.seconds) ? ["A sample takes", time_text(sweep.seconds / Math.max(1, sweep.samples))] : null,
  ];
}

function sweep_first(first, results) {
  const sweep = record(results.sweep), outputs = sweep_outputs(sweep), leading = leading_output(outputs);
  const shown = SWEEP_FIRST.map((name) => outputs.find(([own]) => own === name)).filter(Boolean).slice(0, 4);
  panel(first, { title: "Scatter of the outputs", span: 6, href: "scatter" }, (plot) => plot.append(
    el("div", { class: "small-multiples two" }, ...shown.map(([name, of]) => el("div", {}, draw_histogram(name, of)))),
    el("p", { class: "fine" }, "Full line: mean; dashed: 1 % and 99 % of the samples.")));
  panel(first, { title: leading ? `Causes of the scatter of the ${words(leading)}` : "Causes of the scatter", span: 6, href: "indices" },
    (plot) => draw_tornado(plot, record(record(record(sweep.statistics)[leading]).indices), 9, sweep.sampler === "grid"));
  panel(first, { title: leading ? `How sure: ${words(leading)}` : "How sure", span: 8, href: "scatter" }, (plot) => plot.append(facts(sweep_facts(sweep))));
  panel(first, { title: "What it costs", span: 4, href: "effects" }, (plot) => cost_panel(plot, results));
}

add_task_page({ key: "sweep", headline: sweep_headline, verdict: sweep_verdict, tiles: sweep_tiles, first: sweep_first });
add_sections({ scatter: build_scatter, indices: build_indices, "response-maps": build_response_maps });

// Compliance of single gears: the fit and the other models compared with finite elements.

const FORM_LABEL = {
  kernels: "Sum of kernels",
  thesis_in_master: "Haddad's curves, body inside",
  thesis_separate: "Haddad's curves, body apart",
};

const apart_label = (m) => (m === 0 ? "loaded tooth" : m === 1 ? "one pitch away" : `${m} pitches away`);

/** [{form, points, ...distribution}] of one gear, in the order of the results. */
function residual_rows(fit) {
  const residuals = record(fit.residuals);
  return Object.keys(FORM_LABEL).filter((form) => residuals[form]).flatMap((form) =>
    ["fitted", "unseen"].flatMap((points) =>
      list(record(residuals[form])[points]).map((d) => ({ form, points, ...record(d) }))));
}

function fit_headline(results) {
  const fits = list(results.fit).map(record);
  const closest = fits.map((fit) => {
    const own = residual_rows(fit).filter((row) => row.form === "kernels" && row.teeth_apart === 0);
    return own.find((row) => row.points === "unseen") || own[0];
  });
  const parts = fits.flatMap((fit, i) => (closest[i] ? [`${fit.gear}: half of all pairs of stations within `
    + `${fmt(closest[i].median_percent, 2)} % of finite elements, 95 % within ${fmt(closest[i].share_95_percent, 2)} %`] : []));
  return parts.length ? capital(parts.join("; ")) : "No gear could be fitted";
}

function fit_tiles(results) {
  return list(results.fit).map(record).flatMap((fit) => {
    const elements = record(fit.finite_elements);
    return [
      tile(`Fit, ${fit.gear}`, fit.status, "", { detail: `${fmt(fit.iterations, 6)} steps, ${fmt(fit.coefficients)} coefficients` }),
      tile(`Unknowns, ${fit.gear}`, elements.unknowns, "", { digits: 7, detail: `${fmt(elements.peak_memory_bytes / 1e9, 2)} GB, `
        + `${fmt(elements.model_seconds + elements.loads_seconds, 2)} s for ${fmt(elements.loads)} loads` }),
    ];
  });
}

function fit_verdict(results, verdict) {
  for (const line of list(results.requirements_not_met)) verdict.append(el("p", { class: "banner" }, `${capital(String(line))}`));
}

function draw_residual_shares(plot, fit) {
  const shares = list(record(fit.residuals).share_percent);
  const rows = residual_rows(fit)
    .filter((row) => row.form === "kernels" || (row.form === "thesis_separate" && row.teeth_apart === 0));
  const apart = unique(rows.map((row) => row.teeth_apart));
  const curves = rows.map((row) => ({
    label: `${row.form === "kernels" ? apart_label(row.teeth_apart) : "Haddad's curves, loaded tooth"}, ${row.points}`,
    points: list(row.residual_percent).map((residual, i) => ({ residual, y: shares[i] }))
      .filter((point) => point.residual !== null).map(({ residual, y }) => ({ x: Math.max(residual, 1e-3), y })),
    colour: row.form === "kernels" ? sequence_colour(apart.indexOf(row.teeth_apart)) : css_colour("muted"),
    dashed: row.points === "fitted",
  }));
  xy_chart(plot, {
    label: "Fraction of the pairs of stations within a residual",
    curves,
    x: "|model − finite elements| / finite elements [%]", y: "pairs within it [%]",
    x_range: { type: "logarithmic", min: 0.01, ticks: { callback: (value) => (Number.isInteger(Math.log10(value)) ? fmt(value) : "") } },
    y_range: { min: 0, max: 100 },
    read_x: (x) => `within ${fmt(x, 2)} %`, read_y: (y) => `${fmt(y, 3)} % of the pairs`, nearest: "xy", height: 340,
  });
}

function residual_table(body, fit) {
  table(body, {
    title: `Residuals of the ${fit.gear}'s fits`,
    note: "Residuals are |model − finite elements| / |finite elements| over all pairs of stations with the stated distance in pitches. Unseen stations lie "
      + "between those fitted. A relative residual means little where a compliance passes through zero; the last column therefore has the largest error "
      + "relative to the own compliances of the stations, √(K_pp K_qq).",
    columns: [{ label: "Form" }, { label: "Status" }, { label: "Teeth" }, { label: "Places" }, { label: "Pairs", digits: 7 },
      { label: "Median", unit: "%", digits: 3 }, { label: "95 %", unit: "%", digits: 3 }, { label: "Worst", unit: "%", digits: 3 }, { label: "Worst of own", unit: "%", digits: 3 }],
    rows: residual_rows(fit).map((row) => [FORM_LABEL[row.form], record(fit.residuals[row.form]).status ?? null,
      apart_label(row.teeth_apart), row.points, row.pairs ?? null, row.median_percent ?? null, row.share_95_percent ?? null,
      row.worst_percent ?? null, row.worst_percent_of_own ?? null]),
  });
}

function fit_facts(body, fit) {
  const elements = record(fit.finite_elements), range = record(fit.range), gear_body = record(fit.body);
  const between = (pair) => (list(pair).length === 2 ? `${fmt(pair[0], 3)} … ${fmt(pair[1], 3)}` : null);
  const rows = [
    ["form", fit.form ? words(fit.form) : null, ""],
    ["status", fit.status ?? null, ""],
    ["steps", fit.iterations ?? null, ""],
    ["coefficients", fit.coefficients ?? null, ""],
    ["pairs fitted", fit.pairs ?? null, ""],
    ["valid for u", between(range.u), "−1 root, 1 tip"],
    ["valid for distances from the acute end", between(range.zeta), "modules"],
    ["valid for teeth apart", range.teeth_apart ?? null, "pitches"],
    ["lowest eigenvalue / largest", fit.lowest_eigenvalue ?? null, `over ${plural(fit.eigenvalue_teeth, "tooth").replace("tooths", "teeth")}`],
    ["median standard error of a coefficient", record(fit.uncertainty).median_standard_error ?? null, ""],
    ["shaft motion removed", elements.removed_shaft_motion ?? null, ""],
    ["shaft diameter", gear_body.shaft_diameter_mm ?? null, "mm"],
    ["bore diameter", gear_body.bore_diameter_mm ?? null, "mm"],
    ["unknowns", elements.unknowns ?? null, ""],
    ["mesh, assembly and factorisation", elements.model_seconds ?? null, "s"],
    ["loads solved", elements.loads_seconds ?? null, "s"],
    ["fit", fit.fit_seconds ?? null, "s"],
  ];
  table(body, {
    title: `Fit of the ${fit.gear} and its cost`,
    columns: [{ label: "Quantity" }, { label: "Value", digits: 7 }, { label: "Unit" }],
    rows: rows.filter(([, value]) => value !== null)
      .map(([name, value, unit]) => [name, { text: is_number(value) ? fmt(value, value > 1e4 ? 7 : 4) : value, value }, unit]),
  });
  const uncertain = list(record(fit.uncertainty).least_certain).map(record);
  if (uncertain.length === 0) return;
  table(body, {
    title: `Least certain coefficients of the ${fit.gear}`,
    columns: [{ label: "Coefficient" }, { label: "Value" }, { label: "Standard error" }],
    rows: uncertain.map((c) => [c.coefficient ?? "", c.value ?? null, c.standard_error ?? null]),
  });
}

function build_residuals(results, body) {
  for (const fit of list(results.fit).map(record)) {
    if (residual_rows(fit).length === 0) continue;
    const grid = figure_grid(body);
    figure(grid, {
      title: `${gear_title(fit)}: residuals at fitted and unseen stations`,
      wide: true,
      caption: "Fraction of all pairs of stations within a relative residual: the further left a curve, the closer the fit. "
        + "Dashed: fitted stations; full: stations that the fit has not seen.",
    }, (plot) => draw_residual_shares(plot, fit));
    residual_table(body, fit);
    const tables = el("div", { class: "tables" });
    body.append(tables);
    fit_facts(tables, fit);
  }
}

function fit_first(first, results) {
  for (const fit of list(results.fit).map(record)) {
    panel(first, { title: `${gear_title(fit)}: residuals`, span: list(results.fit).length > 1 ? 6 : 7, href: "residuals" }, (plot) => draw_residual_shares(plot, fit));
    if (list(results.fit).length > 1) continue;
    panel(first, { title: "What it costs", span: 5, href: "residuals" }, (plot) => {
      const elements = record(fit.finite_elements);
      plot.append(facts([["Status", fit.status], ["Coefficients", fmt(fit.coefficients)], ["Unknowns", fmt(elements.unknowns, 9)],
        ["Mesh and factorisation", time_text(elements.model_seconds)], ["Loads solved", time_text(elements.loads_seconds)], ["Fit", time_text(fit.fit_seconds)]]));
    });
  }
}

add_task_page({ key: "fit", headline: fit_headline, verdict: fit_verdict, tiles: fit_tiles, first: fit_first });
add_sections({ residuals: build_residuals });

// Assurance: discretisation errors, fresh draws that the optimiser has not seen, other designs and other starts.

/** Spread of each design over the fresh draws: least to largest as a line, the quantiles as a bar, the mean as a mark. */
function draw_spread(plot, validation, unit) {
  const designs = list(validation.designs).map(record).filter((design) => is_number(design.least) && is_number(design.greatest));
  if (designs.length === 0) return;
  const name = (design, i) => (i < 2 ? design.name : "best rule");
  const width = Math.max(260, plot.clientWidth || 360), row_height = 20, top = 2, bottom = 18, left = 64, right = 16;
  const height = top + bottom + row_height * designs.length;
  const low = minimum(designs.map((d) => d.least)), high = maximum(designs.map((d) => d.greatest));
  const to_x = (value) => left + ((width - left - right) * (value - low)) / (high - low || 1);
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, width: "100%", role: "img", "aria-label": "Spread over draws not seen by the search" });
  for (const tick of round_ticks(low, high, 4)) {
    picture.append(svg("line", { x1: to_x(tick), x2: to_x(tick), y1: top, y2: height - bottom, class: "grid-line" }),
      svg("text", { x: to_x(tick), y: height - 5, "text-anchor": "middle", class: "muted" }, fmt(tick)));
  }
  picture.append(svg("text", { x: left - 8, y: height - 5, "text-anchor": "end", class: "muted" }, unit));
  designs.forEach((design, i) => {
    const y = top + row_height * (i + 0.5), colour = [design_colour("before"), design_colour("after"), sequence_colour(2)][i] ?? css_colour("muted");
    const shares = list(design.quantiles).map(record).filter((q) => is_number(q.value)), inner = [shares[0], shares[shares.length - 1]];
    picture.append(svg("text", { x: left - 8, y: y + 4, "text-anchor": "end", class: "small" }, name(design, i)),
      svg("line", { x1: to_x(design.least), x2: to_x(design.greatest), y1: y, y2: y, stroke: colour, "stroke-width": 1.5 }));
    if (inner[0]) {
      picture.append(svg("rect", { x: to_x(inner[0].value), y: y - 5, width: Math.max(1, to_x(inner[1].value) - to_x(inner[0].value)), height: 10, rx: 2, fill: colour },
        svg("title", {}, `${design.name}: ${fmt(100 * inner[0].share)} to ${fmt(100 * inner[1].share)} % of the draws between ${fmt(inner[0].value)} and ${fmt(inner[1].value)} ${unit}`)));
    }
    if (is_number(design.mean)) {
      picture.append(svg("line", { x1: to_x(design.mean), x2: to_x(design.mean), y1: y - 7, y2: y + 7, class: "mean-mark" }, svg("title", {}, `mean ${fmt(design.mean)} ${unit}`)));
    }
  });
  plot.append(picture);
}

function error_facts(optimise) {
  const before = record(optimise.before), after = record(optimise.after), unit = pretty_unit(optimise.objective_unit);
  if (!is_number(after.objective_error)) return [["Discretisation", "its error was not estimated"]];
  if (scatter_of(optimise)) return [["Listed scenes", `${with_error(before.objective, before.objective_error, 4)} → ${with_error(after.objective, after.objective_error, 4)} ${unit}`]];
  const gain = before.objective - after.objective, error = Math.hypot(before.objective_error ?? 0, after.objective_error);
  const times = Math.abs(gain) / error;
  return [
    ["Before, ± numerical", `${with_error(before.objective, before.objective_error, 4)} ${unit}`],
    ["After, ± numerical", `${with_error(after.objective, after.objective_error, 4)} ${unit}`],
    ["Gain", `${with_error(gain, error, 3)} ${unit}`],
    ["Gain / error", times >= 100 ? "above 100" : fmt(times, 2), times < 2 || gain < 0 ? "bad" : times >= 5 ? "good" : null],
  ];
}

/** Result of the starts: "3 of 3 starts end here". */
function starts_fact(optimise) {
  const starts = list(optimise.starts).length, optima = list(optimise.optima).map(record);
  if (starts === 0) return null;
  if (starts > 1 && optima.length === 0) return ["Optimum", `none of ${starts} starts converged`, "bad"];
  if (starts === 1) return ["Optimum", "local, from one start"];
  return ["Optimum", optimise.multimodal ? `${fmt(record(optima[0]).found_by)} of ${starts} starts end here, others elsewhere`
    : `${fmt(record(optima[0]).found_by)} of ${starts} starts end here`];
}

function rule_fact(optimise) {
  const best = record(record(optimise.comparison).best_rule), after = record(optimise.after).objective;
  const none = record(optimise.comparison).no_rule;
  if (typeof none === "string") return ["Best rule of thumb", el("span", { title: none }, "none keeps the constraints"), null];
  if (!is_number(best.objective) || !is_number(after)) return null;
  const value = `${fmt(best.objective, 3)} ${pretty_unit(optimise.objective_unit)}`.trim();
  if (optimise.scatter) return ["Best rule of thumb", el("span", { title: best.name }, `${value} over the listed scenes`)];
  if (!(after > 0)) return ["Best rule of thumb", el("span", { title: best.name }, value), best.objective < after ? "bad" : null];
  const times = best.objective / after, percent = 100 * (times - 1);
  const beside = times > 3 ? `${fmt(times, 2)} times as much` : `${fmt(Math.abs(percent), 2)} % ${percent < 0 ? "less" : "more"}`;
  return ["Best rule of thumb", el("span", { title: best.name }, `${value}, ${beside}`), best.objective < after ? "bad" : null];
}

/** What a step of a variable or tolerance costs at most: "1 µm less wheel tip relief: +264 MPa, +22 %". */
function steepest_fact(optimise) {
  const steps = list(optimise.sensitivity).map(record).flatMap((s) => [[s.less, "less"], [s.more, "more"]].map(([change, way]) => ({ s, change, way })))
    .filter(({ change }) => is_number(change) && change > 0);
  const after = record(optimise.after).objective;
  if (steps.length === 0 || !(after > 0)) return null;
  const { s, change, way } = steps.reduce((a, b) => (b.change > a.change ? b : a)), share = (100 * change) / after;
  const of = typeof optimise.assessed_design === "string" ? ` (of ${optimise.assessed_design})` : "";
  const relative = share > 300 ? `${fmt(1 + share / 100, 2)} times as much` : `+${fmt(share, 2)} %`;
  return ["Worst small step", `${fmt(s.step, 3)} ${pretty_unit(s.unit)} ${way} ${words(s.name)}: +${in_unit(fmt(change, 3), pretty_unit(optimise.objective_unit))}, ${relative}${of}`,
    share > 5 ? "bad" : null];
}

function assurance_panel(plot, results) {
  const optimise = record(results.optimise), unit = pretty_unit(optimise.objective_unit);
  const seen = record(optimise.assessment).objective_seen_by_search;
  const validation = record(optimise.validation), share = validation.share_better_than_before;
  const scatter = scatter_of(optimise), status = scatter ? scatter.status : optimise.status;
  const ended = status ? [words(status), /converged|success|optimal/i.test(status) ? "" : "bad"] : null;
  plot.append(facts([
    ...(scatter ? drawn_facts(scatter) : []), ...error_facts(optimise),
    steepest_fact(optimise),
    is_number(seen) ? ["Seen by the search", `${fmt(seen, 4)} ${unit}`] : null,
    rule_fact(optimise),
    ended ? ["Search", ...ended] : null,
    starts_fact(optimise),
    scatter && list(record(scatter.fresh).designs).length > 0 ? null : is_number(share) ? ["Fresh draws", `better in ${fmt(100 * share, 3)} % of ${fmt(validation.samples, 7)}`, share > 0.95 ? "good" : share < 0.5 ? "bad" : null]
      : ["Fresh draws", `none: ${scatter ? "optimise.scatter.fresh" : "[optimise.validation]"}`],
  ]));
  if (list(validation.designs).length) draw_spread(plot, validation, unit);
}

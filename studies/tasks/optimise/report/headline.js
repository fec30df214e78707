// The headline of an optimisation in plain words, and the verdict.

/** "worst" -> "Worst", "mean+2sigma" -> "Mean + 2σ of"; nothing for the nominal scene. */
function aggregate_words(over) {
  if (over === "worst" || over === "mean") return capital(over);
  const sigmas = /^mean\+(.*)sigma$/.exec(over || ""), tail = /^cvar (.*)$/.exec(over || "");
  if (sigmas) return `Mean + ${sigmas[1]}σ of`;
  return tail ? `Mean of the worst ${fmt(100 * (1 - Number(tail[1])))} % of` : null;
}

/** The limits that a design ("before", "after") exceeds {name, unit, seen, limit, sense, excess}, `seen` naming its largest or least value; the most exceeded first. */
function exceeded_limits(optimise, design) {
  const broken = constraint_rows(optimise, design).filter((row) => row.met === false && is_number(row.value)).map((row) => {
    const is_above = is_number(row.max) && row.value > row.max, limit = is_above ? row.max : row.min, seen = is_above ? "value" : "least";
    return { ...row, seen, limit, sense: is_above ? "at most" : "at least", excess: Math.abs(row[seen] - limit) / Math.abs(limit || 1) };
  });
  return broken.sort((a, b) => b.excess - a.excess);
}

/** "peak contact stress to at most 1500 MPa: 8880 → 1630 MPa" */
function limit_words({ name, unit, seen, limit, sense }, optimise) {
  const figure = (design) => {
    const found = record(record(record(optimise[design]).constraints)[name]), value = found[seen] ?? found.value;
    return is_number(value) ? fmt(value, 3) : null;
  };
  return `${words(name)} to ${sense} ${in_unit(fmt(limit), unit)}: ${in_unit([figure("before"), figure("after")].filter(Boolean).join(" → "), unit)}`;
}

/**
 * "Worst peak contact stress over nine scenes: 477 → 388 MPa (−19 %)"; where the design before exceeds a limit, with what keeping it takes, and
 * where no design keeps one, that instead.
 */
function optimise_headline(results) {
  const optimise = record(results.optimise);
  const scatter = scatter_of(optimise);
  if (scatter) return scatter_headline(optimise, scatter);
  const exceeded = exceeded_limits(optimise, "after"), [exceeded_before] = exceeded_limits(optimise, "before");
  if (exceeded.length > 0) {
    const further = exceeded.slice(1).map(({ name }) => words(name));
    return `No design found keeps ${limit_words(exceeded[0], optimise)}${further.length > 0 ? `, nor the limit of ${further.join(", nor of ")}` : ""}`;
  }
  const steep = list(optimise.grinding_limits).map(record).find(({ state }) => state === "exceeded");
  if (steep) return `No design found keeps the ${steep.name} to ${fmt(steep.limit)} ${pretty_unit(steep.unit)}: ${fmt(steep.value, 3)} ${pretty_unit(steep.unit)}`;
  const from = record(optimise.before).objective, to = record(optimise.after).objective;
  const name = words(optimise.objective_name), unit = pretty_unit(optimise.objective_unit);
  const aggregate = aggregate_words(optimise.over);
  const count = list(optimise.scenes).length;
  const over = count > 1 ? (aggregate ? ` over ${count_words(count)} scenes` : " in the nominal scene") : "";
  const subject = `${aggregate && count > 1 ? `${aggregate} ${name}` : capital(name)}${over}`;
  if (!is_number(from) || !is_number(to)) return `${subject} was not obtained`;
  const kept = exceeded_before ? `, to keep ${limit_words(exceeded_before, optimise)}` : "";
  const [a, b] = [fmt(from, 3), fmt(to, 3)];
  if (a === b) return `${subject} stays at ${in_unit(b, unit)}${kept}`;
  const change = percent_change(from, to);
  return `${subject}: ${a} → ${in_unit(b, unit)}${change ? ` (${change})` : ""}${kept}`;
}

/** What is minimised, with the weights of several outputs. */
function objective_words(optimise) {
  const terms = list(optimise.objective_terms).map(record);
  if (terms.length < 2) return words(optimise.objective_name);
  return terms.map(({ output, weight, unit }) => `${fmt(weight)} · ${words(output)} [${pretty_unit(unit)}]`).join(" + ");
}

/** Every constraint of a design: {name, value, least, max, min, unit, met}, its largest value and its least. */
function constraint_rows(optimise, design = "after") {
  return Object.entries(record(record(optimise[design]).constraints)).map(([name, raw]) => {
    const { value, least = value, max, min, unit } = record(raw);
    // Slack for the last digit that the results store, not for the solver.
    const slack = (bound) => 1e-5 * Math.abs(bound);
    const above = is_number(max) && !(value <= max + slack(max)), below = is_number(min) && !(least >= min - slack(min));
    const met = is_number(value) && (is_number(max) || is_number(min)) ? !above && !below : null;
    return { name, value, least, max, min, unit: pretty_unit(unit), met };
  });
}

/** Which limits are not met, how the search ended, and what would help. */
function optimise_verdict(results, verdict) {
  const optimise = record(results.optimise), scatter = scatter_of(optimise);
  const over_draws = scatter ? exceeded_over_draws(scatter) : [];
  if (over_draws.length > 0) {
    verdict.append(el("p", { class: "banner bad" }, `Not met over the draws: ${over_draws.map((limit) => drawn_limit_words(scatter, limit)).join("; ")}.`));
  }
  const broken = constraint_rows(optimise).filter((row) => row.met === false);
  if (broken.length > 0) {
    verdict.append(el("p", { class: "banner bad" }, `Not met: ${broken.map((row) =>
      `${words(row.name)} ${in_unit(fmt(row.value), row.unit)} against ${in_unit([is_number(row.min) ? `at least ${fmt(row.min)}` : null,
        is_number(row.max) ? `at most ${fmt(row.max)}` : null].filter(Boolean).join(" and "), row.unit)}`).join("; ")}.`));
  }
  const relaxation = list(record(optimise.relaxation).words);
  const said_below = optimise.status === "infeasible" && relaxation.length > 0;
  if (optimise.status && !said_below && !/converged|success|optimal/i.test(optimise.status)) {
    verdict.append(el("p", { class: "banner" }, `The solver ended with “${words(optimise.status)}”`
      + `${optimise.message ? `: ${optimise.message}` : ""}.${optimise.status === "infeasible" ? "" : " The best design found is shown."}`));
  }
  const { residual, complementarity } = record(optimise.optimality);
  const doubt = Math.max(residual ?? 0, complementarity ?? 0);
  // 1e-4: an optimum's own remainder, Optimality::holds.
  if (optimise.status !== "infeasible" && doubt > 1e-4) {
    verdict.append(el("p", { class: "banner", id: "doubt" }, `The design shown is not proven to be an optimum. Its first-order conditions are off by ${fmt(100 * doubt, 2)} %, counted in the objective `
      + "at the start for the range of a variable; an optimum's are off by 0.01 % at most."));
  }
  if (relaxation.length > 0) {
    verdict.append(el("div", { class: "banner", id: "relaxation" },
      el("strong", {}, "No feasible design found: the limits that are exceeded, and what would reduce the excess"),
      el("ul", { class: "statements" }, ...relaxation.map((sentence) => el("li", {}, capital(pretty_unit(sentence).replace("<=", "≤").replace(">=", "≥")))))));
  }
}

// The gain in each scene, the constraints and the further objectives.

/** "26 of 27 scenes are better; “aligned” is worse by 9.7 %." */
function scenes_sentence(scenes, label) {
  const known = scenes.filter((scene) => is_number(scene.before) && is_number(scene.after));
  if (known.length < 2) return null;
  const better = known.filter((scene) => scene.after < scene.before).length;
  if (better === known.length) return `All ${known.length} scenes are better.`;
  const lost = known.reduce((a, b) => (b.after / b.before > a.after / a.before ? b : a));
  return `${better} of ${known.length} scenes are better; “${label(lost)}” changes by ${percent_change(lost.before, lost.after)}.`;
}

/** Each constraint: its values before and after, and its limits. */
function constraint_facts(optimise) {
  const before = record(record(optimise.before).constraints), errors = record(record(optimise.after).constraints_error);
  return constraint_rows(optimise).map((row) => {
    const limits = [is_number(row.min) ? `at least ${fmt(row.min)}` : null, is_number(row.max) ? `at most ${fmt(row.max)}` : null].filter(Boolean).join(", ");
    const from = record(before[row.name]).value;
    return [capital(words(row.name)), `${is_number(from) ? `${fmt(from, 3)} → ` : ""}${in_unit(with_error(row.value, errors[row.name], 3), row.unit)}, ${limits}`,
      row.met === false ? "bad" : row.met ? "good" : null];
  });
}

/** The further objectives of a lexicographic list: [[name, "0.393 → 0.09 µm"]]. */
function later_facts(optimise) {
  const from = list(record(optimise.before).later_objectives), to = list(record(optimise.after).later_objectives);
  return list(optimise.stages).slice(1).map((stage, i) => {
    const { objective, unit } = record(stage);
    return [`Then ${words(objective)}`, `${fmt(from[i], 3)} → ${in_unit(fmt(to[i], 3), pretty_unit(unit))} (${percent_change(from[i], to[i]) ?? "–"})`];
  });
}

function gain_panel(plot, results) {
  const optimise = record(results.optimise), unit = pretty_unit(optimise.objective_unit);
  const scenes = scenes_by_rank(optimise);
  const label = scene_labels(scenes);
  const shown = scenes.slice(0, MOST_SCENES - Math.min(3, constraint_rows(optimise).length));
  plot.append(el("p", { class: "key" },
    el("span", { class: "dot", style: `background:${design_colour("before")}` }), " before   ",
    el("span", { class: "dot", style: `background:${design_colour("after")}` }), ` after${unit ? `   [${unit}]` : ""}${scatter_of(optimise) ? "" : shown.some((s) => s.governs) ? "   bold: governs" : ""}`));
  const scatter = scatter_of(optimise), drawn = scatter ? ["before", "after"].map((design) => fresh_statistic(scatter, design)) : [];
  const over_draws = drawn.every(is_number) && scatter ? [{ label: `${scatter.statistic_in_words}, drawn`, before: drawn[0], after: drawn[1], strong: true }] : [];
  const in_scenes = shown.map((scene) => ({ ...scene, label: label(scene), strong: !scatter && scene.governs !== 0 }));
  if (shown.length > 0) draw_pairs(plot, [...over_draws, ...in_scenes], unit);
  const rest = scenes.length - shown.length;
  const sentence = [scenes_sentence(scenes, label), rest > 0 ? `${rest} more below.` : null].filter(Boolean).join(" ");
  if (sentence) plot.append(el("p", { class: "fine" }, sentence));
  if (scatter) plot.append(el("p", { class: "fine" }, "The design is the one for the drawn gears. The listed scenes did not decide."));
  const said = [optimise.objective_name, ...list(optimise.stages).map((stage) => record(stage).objective), ...constraint_rows(optimise).map((row) => row.name)];
  plot.append(facts([...later_facts(optimise), ...constraint_facts(optimise), ...life_facts(results, said)]));
}

// Load cases: the entries of `loaded` grouped by scene and torque, and the selection of one of them.

const DESIGN_ORDER = ["before", "given", "after"];
const DESIGN_LABEL = { before: "Before", given: "As given", after: "After" };

/** Labels that distinguish scenes {name, torque_Nm}: by their names, their torques, or both. @return scene -> label */
function scene_labels(scenes) {
  const several = (of) => unique(scenes.map(of)).length > 1;
  const torques = several((scene) => scene.torque_Nm), names = several((scene) => scene.name);
  return ({ name, torque_Nm }) => {
    const torque = is_number(torque_Nm) ? `${fmt(torque_Nm)} N·m` : null;
    return !torques || torque === null ? `${name}` : names ? `${name}, ${torque}` : torque;
  };
}

/** Of an entry of `loaded` that loads another flank than the pair's own. */
const flank_of = (entry) => (entry.working_flank ? `, ${entry.working_flank} flank` : "");

/** [{key, scene, torque, label, designs: {before?, given?, after?}}] in the order of the results. */
function load_cases(results) {
  const cases = new Map();
  const entries = list(results.loaded).map(record);
  const label_of = scene_labels(entries.map((entry) => ({ name: entry.scene, torque_Nm: entry.torque_Nm })));
  for (const entry of entries) {
    const scene = typeof entry.scene === "string" && entry.scene !== "" ? entry.scene : "nominal";
    const key = JSON.stringify([scene, entry.torque_Nm ?? null, entry.bin ?? null]);
    if (!cases.has(key)) {
      cases.set(key, { key, scene, torque: entry.torque_Nm, label: label_of({ name: scene, torque_Nm: entry.torque_Nm }) + flank_of(entry), designs: {} });
    }
    cases.get(key).designs[DESIGN_LABEL[entry.design] ? entry.design : "given"] = entry;
  }
  return [...cases.values()];
}

const designs_of = (load_case) => DESIGN_ORDER.filter((design) => load_case.designs[design]);
const final_entry = (load_case) => load_case.designs[designs_of(load_case).pop()];
const summary_of = (entry) => record(record(entry).summary);

const same_scene = (scene, load_case) =>
  scene.name === load_case.scene && (!is_number(scene.torque_Nm) || Math.abs(scene.torque_Nm - load_case.torque) <= 1e-5 * Math.abs(load_case.torque));

/** The scenes of an optimisation, the governing one first: by weight at the optimum, then by objective. */
function scenes_by_rank(optimise) {
  const limits = list(record(optimise.relaxation).limits).map(record);
  const weights = limits.length > 0 ? limits.map((limit) => ({ ...limit, name: limit.scene })) : list(record(optimise.governing).scenes).map(record);
  const scenes = list(optimise.scenes).map(record).map((scene) => {
    const found = weights.find((w) => w.name === scene.name && (!is_number(w.torque_Nm) || w.torque_Nm === scene.torque_Nm));
    return { ...scene, governs: found && is_number(found.weight) && Math.abs(found.weight) >= 0.005 ? found.weight : 0 };
  });
  const value = (scene) => (is_number(scene.after) ? scene.after : -Infinity);
  return scenes.sort((a, b) => Math.abs(b.governs) - Math.abs(a.governs) || value(b) - value(a));
}

/** True where a study asks for transmission error alone: by its objective, or by all its expectations of the loaded contact. */
function asks_for_te(results) {
  const objective = record(results.optimise).objective_name;
  if (objective) return /^te_/.test(objective);
  const expected = list(results.given).map((given) => `${record(given).key ?? ""}`).filter((key) => /^expect\..*(te_|stress|load)/.test(key));
  return expected.length > 0 && expected.every((key) => /te_/.test(key));
}

/** What the case that is shown first is called. The largest weight governs, as the sentences about the optimum say. */
function first_case_remark(results) {
  if (!results.optimise) return asks_for_te(results) ? " (largest TE)" : " (largest stress)";
  return scenes_by_rank(record(results.optimise)).some((scene) => scene.governs !== 0) ? " (governs)" : " (largest objective)";
}

/** The governing load case: by its weight or objective at the optimum; else the one with the largest stress, or TE where the study asks for it. */
function governing_case(cases, results) {
  const ranked = scenes_by_rank(record(results.optimise)).filter((scene) => scene.governs !== 0 || is_number(scene.after));
  for (const scene of ranked) {
    const found = cases.find((load_case) => same_scene(scene, load_case));
    if (found) return found;
  }
  const key = asks_for_te(results) ? "te_peak_to_peak_um" : "peak_contact_stress_MPa";
  const severity = (load_case) => summary_of(final_entry(load_case))[key];
  return cases.reduce((worst, load_case) => {
    const value = severity(load_case);
    return worst === null || (is_number(value) && !(severity(worst) >= value)) ? load_case : worst;
  }, null);
}

/**
 * The case that a group of figures shows; every choice on the page sets it for the whole group.
 * @param remark  added to the label of the case that is shown first
 */
function case_selection(cases, first, remark) {
  const selection = { cases, current: first, listeners: [], selects: [] };
  const options = cases.map((load_case) => ({
    value: load_case.key,
    label: load_case.label + (cases.length > 1 && load_case === first ? remark : ""),
  }));
  selection.add_choice = (parent) => {
    if (cases.length < 2) return;
    const { node, select } = choice("Scene", options, selection.current.key, (key) => {
      selection.current = cases.find((load_case) => load_case.key === key);
      selection.selects.forEach((other) => (other.value = key));
      selection.listeners.forEach((redraw) => redraw());
    });
    selection.selects.push(select);
    node.classList.add("no-print");
    parent.append(node);
  };
  return selection;
}

/** A figure that shows the selected case and follows the selection. @return function that draws it anew */
function case_figure(parent, selection, options, draw) {
  const redraw = figure(parent, options, (plot) => {
    if (selection.cases.length > 1) plot.append(el("p", { class: "shown" }, `Scene: ${selection.current.label}`));
    draw(plot, selection.current);
  });
  selection.listeners.push(redraw);
  return redraw;
}

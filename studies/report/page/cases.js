// Load cases: the entries of `loaded` grouped by scene and torque, and which of them the reader looks at.

const DESIGN_ORDER = ["before", "given", "after"];
const DESIGN_LABEL = { before: "Before", given: "As given", after: "After" };

/** [{key, scene, torque, label, designs: {before?, given?, after?}}] in the order of the results. */
function load_cases(results) {
  const cases = new Map();
  const entries = list(results.loaded).map(record);
  const several_torques = unique(entries.map((entry) => entry.torque_Nm)).length > 1;
  for (const entry of entries) {
    const scene = typeof entry.scene === "string" && entry.scene !== "" ? entry.scene : "nominal";
    const key = JSON.stringify([scene, entry.torque_Nm ?? null]);
    if (!cases.has(key)) {
      const torque = is_number(entry.torque_Nm) ? `${fmt(entry.torque_Nm)} N·m` : "";
      const label = several_torques && torque ? `${scene}, ${torque}` : scene;
      cases.set(key, { key, scene, torque: entry.torque_Nm, label, designs: {} });
    }
    cases.get(key).designs[DESIGN_LABEL[entry.design] ? entry.design : "given"] = entry;
  }
  return [...cases.values()];
}

const designs_of = (load_case) => DESIGN_ORDER.filter((design) => load_case.designs[design]);
const final_entry = (load_case) => load_case.designs[designs_of(load_case).pop()];
const summary_of = (entry) => record(record(entry).summary);

/** The load case that governs: of the largest objective after the optimisation, else of the largest stress. */
function governing_case(cases, optimise) {
  const severity = (load_case) => {
    const scene = list(optimise.scenes).map(record).find((s) =>
      s.name === load_case.scene && (!is_number(s.torque_Nm) || s.torque_Nm === load_case.torque));
    if (scene && is_number(scene.after)) return scene.after;
    return summary_of(final_entry(load_case)).peak_contact_stress_MPa;
  };
  return cases.reduce((worst, load_case) => {
    const value = severity(load_case);
    return worst === null || (is_number(value) && !(severity(worst) >= value)) ? load_case : worst;
  }, null);
}

/**
 * The one case that a group of figures shows; every choice on the page sets it for all of the group.
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

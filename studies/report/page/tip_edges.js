// Contact on tip edges: where it is under load, from which torque on, and its marks on the flank.

/** Gear -> kind of contact on its tip edge. */
const TIP_KIND = { pinion: "pinion_tip", wheel: "wheel_tip" };
const TIP_KINDS = new Set(Object.values(TIP_KIND));

/** Marks on a flank map, thinned to a legible distance; a rim in the page's colour sets them off from the map. @param points  [{z, r, kind, filled}] */
function draw_edge_marks(pen, points, to_x, to_y, apart = 9) {
  const drawn = [];
  for (const { z, r, kind, filled } of points) {
    const x = to_x(z), y = to_y(r);
    if (drawn.some((other) => Math.hypot(other.x - x, other.y - y) < apart)) continue;
    drawn.push({ x, y });
    pen.fillStyle = pen.strokeStyle = css_colour("surface");
    pen.lineWidth = 3;
    Chart.helpers.drawPoint(pen, { pointStyle: CONTACT_KINDS[kind].style, radius: 4, borderWidth: 3, rotation: 0 }, x, y);
    draw_mark(pen, kind, x, y, 4, filled);
  }
}

/** Of the points of a cloud those whose contact reaches a tip edge. */
const on_tip_edges = (points) => points.filter((point) => TIP_KIND[point.tip_edge])
  .map(({ z, r, tip_edge }) => ({ z, r, kind: TIP_KIND[tip_edge], filled: true }));

/** The load case whose edges touch at the least part of its torque, of one design; null: none does, undefined: nothing is known of edges. */
function first_edge_contact(cases, design) {
  const summaries = cases.map((load_case) => ({ load_case, summary: summary_of(design ? load_case.designs[design] : final_entry(load_case)) }))
    .filter(({ summary }) => is_number(summary.edge_stress_MPa) || record(summary.edge_contact).gear);
  if (summaries.length === 0) return undefined;
  return summaries.filter(({ summary }) => is_number(record(summary.edge_contact).share_of_torque))
    .reduce((a, b) => (a === null || b.summary.edge_contact.share_of_torque < a.summary.edge_contact.share_of_torque ? b : a), null);
}

/** "contact reaches the tip edge of the wheel at 62 % of 150 N·m; under full load tip edges have up to 812 MPa and 3.1 % of the force" */
function edge_contact_words(found, cases, design) {
  if (found === null) return "contact does not reach a tip edge";
  const { load_case, summary } = found, { gear, share_of_torque: share } = summary.edge_contact;
  const torque = `${fmt(load_case.torque)} N·m`, scene = load_case.label.split(", ").filter((part) => part !== torque).join(", ");
  const largest = (key) => cases.map((other) => ({ other, value: summary_of(design ? other.designs[design] : final_entry(other))[key] }))
    .filter(({ value }) => is_number(value)).reduce((a, b) => (b.value > a.value ? b : a), { other: load_case, value: summary[key] });
  const where = cases.length > 1 && scene !== "" ? ` (${scene})` : "";
  const from = share < 0.005 ? `at any load up to ${torque}` : `at ${fmt(100 * share, 2)} % of ${torque}`;
  const stress = largest("edge_stress_MPa"), part = largest("tip_edge_share");
  const of_case = ({ other }) => (other === load_case ? "" : ` (${other.label})`);
  const carried = is_number(part.value) ? ` and ${fmt(100 * part.value, 2)} % of the force${part.other === stress.other ? "" : of_case(part)}` : "";
  const reached = `contact reaches the tip edge of the ${gear} ${from}${where}`;
  if (!is_number(summary.edge_stress_MPa)) return `${reached}; the edge is sharp, its pressure has no bound and is not part of the contact stress`;
  return `${reached}; under full load tip edges have up to ${fmt(stress.value, 4)} MPa${of_case(stress)}${carried}`;
}

/** Before and after an optimisation, else as given; null where tips are sharp or nothing is loaded. */
function edge_contact_sentence(cases) {
  const after = first_edge_contact(cases, null);
  if (after === undefined) return null;
  const before = cases.some((load_case) => load_case.designs.before) ? first_edge_contact(cases, "before") : undefined;
  if (before === undefined) return `${capital(edge_contact_words(after, cases, null))}.`;
  return `Tip edges before: ${edge_contact_words(before, cases, "before")}. After: ${edge_contact_words(after, cases, null)}.`;
}

// Unloaded contact: its kinds, the scenes of the results, and the run of one tooth pair through the mesh.

/** Kind of contact -> words, colour and mark; the marks distinguish the kinds without colour. */
const CONTACT_KINDS = {
  line: { label: "line contact", colour: 0, style: "rect" },
  surface: { label: "surface contact", colour: 2, style: "circle" },
  pinion_tip: { label: "pinion tip edge", colour: 1, style: "triangle" },
  wheel_tip: { label: "wheel tip edge", colour: 5, style: "rectRot" },
  pinion_root: { label: "pinion root boundary", colour: 3, style: "cross" },
  wheel_root: { label: "wheel root boundary", colour: 4, style: "crossRot" },
  face_end: { label: "face end", colour: 6, style: "star" },
  corner: { label: "corner", colour: 6, style: "rectRounded" },
};

const kind_words = (kind) => CONTACT_KINDS[kind]?.label ?? String(kind);

/** "wheel_tip, surface" -> "wheel tip edge → surface contact". */
const sequence_words = (sequence) =>
  (typeof sequence === "string" && sequence !== "" ? sequence.split(", ").map(kind_words).join(" → ") : "no contact");

/** The scenes of the unloaded contact, as choices of a case_selection(). */
function unloaded_scenes(results) {
  const several = list(results.unloaded_scenes).map(record);
  const scenes = several.length ? several : [record(results.unloaded)];
  return scenes.map((scene, i) => {
    const name = typeof scene.scene === "string" && scene.scene !== "" ? scene.scene : `scene ${i + 1}`;
    return { key: `${i} ${name}`, label: name, data: scene };
  });
}

/**
 * All positions of all pairs as stations of one pair on its run through the mesh, in the order of motion. `turned` is the
 * rotation of the pinion since the pair was at the pitch point [deg].
 */
function pair_run(scene, pinion_teeth) {
  const pitch = 360 / pinion_teeth;
  return list(scene.pairs).map(record)
    .flatMap((pair) => list(pair.positions).map(record)
      .map((position) => ({ ...position, tooth: pair.tooth, turned: position.phi1_deg + (pair.tooth || 0) * pitch })))
    .filter((station) => is_number(station.turned) && CONTACT_KINDS[station.contact])
    .sort((a, b) => a.turned - b.turned);
}

/** Point of a station on one gear's flank, or null. */
function point_on(station, gear) {
  const { z_mm: z, radius_mm: r } = record(station[gear]);
  return is_number(z) && is_number(r) ? { z, r } : null;
}

/** Rectangle of a gear's flank with the circles that bound it [mm]. */
function flank_bounds(results, gear) {
  const geometry = record(record(results.geometry)[gear]), used = record(record(record(results.used).pair)[gear]);
  const half = (used.face_width_mm ?? used.face_width) / 2;
  const radius = (key) => (is_number(geometry[key]) ? geometry[key] / 2 : null);
  const bounds = { half_face: half, tip: radius("tip_diameter_mm"), tip_form: radius("tip_form_diameter_mm"), form: radius("form_diameter_mm"),
    active_root: radius("active_root_diameter_mm") };
  return is_number(half) && is_number(bounds.tip) && is_number(bounds.form) ? bounds : null;
}

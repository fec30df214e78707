// Notes, and the given and used inputs.

function build_notes(results, body) {
  body.append(el("ul", { class: "notes" }, ...list(results.notes).map((note) =>
    el("li", {}, typeof note === "string" ? note : JSON.stringify(note)))));
}

/** Nested tables and lists as dotted keys: [[key, value]]. */
function flattened(value, key = "") {
  if (Array.isArray(value) && value.every((item) => item === null || typeof item !== "object")) {
    return [[key, value.map((item) => (is_number(item) ? fmt(item, 6) : String(item))).join(", ") || "–"]];
  }
  if (value === null || typeof value !== "object") return [[key, value]];
  return Object.entries(value).flatMap(([name, child]) => flattened(child, key ? `${key}.${name}` : name));
}

/** A dotted key that may break after a dot. */
const key_cell = (key) => ({ text: key,
  draw: () => el("span", {}, ...`${key}`.split(/(?<=\.)/).flatMap((part) => [part, el("wbr")])) });

function build_inputs(results, body) {
  const columns = [{ label: "Key" }, { label: "Value", digits: 10 }];
  const tables = el("div", { class: "tables" });
  body.append(tables);
  if (list(results.given).length) {
    table(tables, {
      title: "Given",
      note: "Values of the study file and the command line as written. Texts in quotes contain their unit.",
      columns: [...columns, { label: "Unit" }],
      rows: list(results.given).map(record).map((given) => [key_cell(given.key ?? ""), given.value ?? null, { text: pretty_unit(given.unit ?? ""), class: "word" }]),
    });
  }
  const used = flattened(record(results.used)).filter(([key]) => key !== "");
  if (used.length) {
    table(tables, {
      title: "Used",
      note: "Values used by the run, with defaults and derived values.",
      columns,
      rows: used,
    });
  }
}

add_sections({ notes: build_notes, inputs: build_inputs });

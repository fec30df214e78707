// Horizontal bars: of one value a row, or of a value before and after.

/** Round numbers from low to high, at most `most`, so few that their labels do not touch on an axis of so many pixels. */
function fitting_ticks(low, high, most, pixels) {
  for (let count = most; count > 1; --count) {
    const ticks = round_ticks(low, high, count), widest = 7.2 * Math.max(...ticks.map((tick) => fmt(tick).length)) + 12;
    if (ticks.length < 2 || widest <= (pixels * (ticks[1] - ticks[0])) / (high - low)) return ticks;
  }
  return low < 0 && high > 0 ? [0] : [low];
}

/** A label in two lines, split at a space, where it has more characters than fit into one. */
function label_lines(label, most) {
  if (label.length <= most + 0.5) return [label];
  const at = label.lastIndexOf(" ", most);
  return at > 0 ? [label.slice(0, at), label.slice(at + 1)] : [label];
}

/**
 * Horizontal bars from zero.
 * @param rows  [{label, value, colour, hollow?, note?}], or several bars in a row: [{label, values, bars: [{value, colour, what}]}];
 *              a missing value leaves its row empty
 * @param limit  longer bars, positive or negative, end there with a break
 */
function draw_bars(plot, { rows, unit, label, limit = Infinity }) {
  const width = Math.max(320, plot.clientWidth || 900), top = 8, bottom = 40, per_character = 7.1;
  const longest = Math.max(...rows.map((row) => row.label.length));
  const left = Math.min(0.6 * width, 20 + per_character * longest), right = 90;
  const lines = rows.map((row) => label_lines(row.label, (left - 20) / per_character));
  const row_height = lines.some((of) => of.length > 1) ? 36 : 24;
  const height = top + bottom + row_height * rows.length;
  const shown = (value) => Math.min(limit, Math.max(-limit, value));
  const values = numbers(rows.flatMap((row) => row.values || [row.value])).map(shown);
  if (values.length === 0) return;
  const low = Math.min(0, minimum(values)), high = Math.max(0, maximum(values)) || 1;
  const to_x = (value) => left + ((width - left - right) * (value - low)) / (high - low || 1);
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, width: "100%", role: "img", "aria-label": label });
  for (const tick of fitting_ticks(low, high, width < 560 ? 4 : 6, width - left - right)) {
    picture.append(svg("line", { x1: to_x(tick), x2: to_x(tick), y1: top, y2: height - bottom, class: "grid-line" }),
      svg("text", { x: to_x(tick), y: height - bottom + 15, "text-anchor": "middle", class: "muted" }, fmt(tick)));
  }
  picture.append(svg("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle", class: "muted" },
    unit ? `[${unit}]` : ""));
  rows.forEach((row, i) => {
    const y = top + row_height * (i + 0.5);
    lines[i].forEach((line, k) => picture.append(svg("text", { x: left - 12, y: y + 4 + 16 * (k - (lines[i].length - 1) / 2), "text-anchor": "end" }, line)));
    const bars = row.bars || [row], thickness = 14 / bars.length;
    bars.forEach((bar, k) => {
      if (!is_number(bar.value)) return;
      const [from, to] = [to_x(Math.min(0, shown(bar.value))), to_x(Math.max(0, shown(bar.value)))];
      picture.append(svg("rect", { x: from, y: y - 7 + k * thickness, width: Math.max(1, to - from), height: thickness,
        rx: 2, fill: bar.colour,
        ...(bar.hollow ? { "fill-opacity": 0.25, stroke: bar.colour } : {}) },
        svg("title", {}, `${row.label}${bar.what ? `, ${bar.what}` : ""}: ${fmt(bar.value)} ${unit}`)));
    });
    const broken = numbers(bars.map((bar) => bar.value)).find((value) => Math.abs(value) > limit);
    if (broken !== undefined) {
      const x = to_x(shown(broken)) - 14 * Math.sign(broken);
      picture.append(svg("path", { d: `M${x - 5},${y + 9} l6,-18 M${x},${y + 9} l6,-18`, class: "bar-break" }));
    }
    const end = Math.max(0, ...numbers(bars.map((bar) => shown(bar.value))));
    if (row.note) picture.append(svg("text", { x: to_x(end) + 8, y: y + 4, class: "muted" }, row.note));
  });
  plot.append(picture);
}

const MOST_SCENES = 8;

/** Bars of each row, before above after or after alone, with error whiskers where errors are known. @param rows [{label, before?, after, before_error?, after_error?, strong?}] */
function draw_pairs(plot, rows, unit) {
  const width = Math.max(280, plot.clientWidth || 400), paired = rows.some((row) => is_number(row.before)), row_height = paired ? 22 : 20, bottom = 2;
  const note = (row) => (paired ? `${fmt(row.before, 3)} → ${fmt(row.after, 3)}` : with_error(row.after, row.after_error, 3));
  const wide = 10 + 7 * Math.max(...rows.map((row) => `${note(row)} ${percent_change(row.before, row.after) ?? ""}`.length));
  const left = Math.min(0.45 * width, 16 + 7.2 * Math.max(...rows.map((row) => row.label.length)));
  const height = row_height * rows.length + bottom;
  const room = Math.floor((left - 14) / 7), shortened = (label) => (label.length > room ? `${label.slice(0, room - 1)}…` : label);
  const end = (row) => maximum(["before", "after"].map((design) => row[design] + Math.max(0, row[`${design}_error`] || 0)));  // of the longer whisker
  const high = maximum(rows.map(end)) || 1;
  const to_x = (value) => left + ((width - left - wide) * Math.max(0, value)) / high;
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, width: "100%", role: "img", "aria-label": "A bar for each scene" });
  rows.forEach((row, i) => {
    const y = row_height * i + 3;
    picture.append(svg("text", { x: left - 8, y: y + 13, "text-anchor": "end", class: row.strong ? "small strong" : "small" }, shortened(row.label), svg("title", {}, row.label)));
    ["before", "after"].forEach((design, k) => {
      if (!is_number(row[design])) return;
      const top = paired ? y + 8 * k : y + 3, thickness = paired ? 7 : 11, error = row[`${design}_error`];
      picture.append(svg("rect", { x: left, y: top, width: Math.max(1, to_x(row[design]) - left), height: thickness, rx: 1.5, fill: design_colour(design) },
        svg("title", {}, `${row.label}${paired ? `, ${design}` : ""}: ${with_error(row[design], error, 4)} ${unit}`)));
      if (error > 0) {
        picture.append(svg("line", { x1: to_x(row[design] - error), x2: to_x(row[design] + error), y1: top + thickness / 2, y2: top + thickness / 2, class: "whisker" }));
      }
    });
    const change = percent_change(row.before, row.after);
    picture.append(svg("text", { x: to_x(end(row)) + 6, y: y + 13, class: row.after > row.before ? "small worse" : "small" },
      note(row), svg("tspan", { class: "muted" }, change ? ` ${change}` : "")));
  });
  plot.append(picture);
}

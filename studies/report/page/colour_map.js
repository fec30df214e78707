// A perceptually uniform colour map, from dark blue over green to yellow, readable with colour-blindness and in grey.

/** [red, green, blue] at equal steps; lightness grows linearly from 15 to 90 (CIE L*). */
const MAP_STOPS = [
  [68, 1, 84], [72, 35, 116], [64, 67, 135], [52, 94, 141], [41, 120, 142],
  [32, 144, 140], [34, 167, 132], [68, 190, 112], [121, 209, 81], [189, 222, 38], [253, 231, 37],
];

/** @param t  0 .. 1, clamped */
function map_colour(t) {
  const place = Math.min(Math.max(t, 0), 1) * (MAP_STOPS.length - 1);
  const i = Math.min(Math.floor(place), MAP_STOPS.length - 2);
  return MAP_STOPS[i].map((low, channel) => Math.round(low + (place - i) * (MAP_STOPS[i + 1][channel] - low)));
}

/** Round numbers from low to high, about `count` of them. */
function round_ticks(low, high, count = 5) {
  if (!(high > low)) return [low];
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * power).find((s) => s >= rough * 0.999);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
  return ticks;
}

/** A canvas that is sharp on screen and paper, with its drawing context in CSS pixels. */
function sharp_canvas(width, height, label) {
  const ratio = Math.max(2, window.devicePixelRatio || 1);
  const canvas = el("canvas", { width: Math.round(width * ratio), height: Math.round(height * ratio),
    role: "img", "aria-label": label });
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = `12px ${Chart.defaults.font.family}`;
  return { canvas, pen };
}

/** Vertical colour bar of `scale` {low, high, ticks?: [{at, text}]} with its unit on top, as high as the maps beside it. */
function colour_bar(scale, unit, height) {
  const width = 76, top = 26, bottom = 40;
  const { canvas, pen } = sharp_canvas(width, height,
    `Colour bar from ${fmt(scale.low)} to ${fmt(scale.high)} ${unit}`);
  canvas.className = "colour-bar";
  const span = height - top - bottom;
  for (let row = 0; row < span; ++row) {
    pen.fillStyle = `rgb(${map_colour(1 - row / (span - 1)).join(",")})`;
    pen.fillRect(6, top + row, 14, 1.5);
  }
  pen.fillStyle = css_colour("muted");
  pen.textBaseline = "middle";
  pen.fillText(unit, 6, 10);
  for (const { at, text } of scale.ticks ?? round_ticks(scale.low, scale.high, 5).map((tick) => ({ at: tick, text: fmt(tick) }))) {
    const y = top + span * (1 - (at - scale.low) / (scale.high - scale.low || 1));
    pen.fillRect(20, y - 0.5, 4, 1);
    pen.fillText(text, 28, y);
  }
  return canvas;
}

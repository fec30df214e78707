// A quantity over a tooth flank: face width to the right, radius upwards.

const MAP_HEIGHT = 260;
const MAP_MARGIN = { left: 62, right: 10, top: 26, bottom: 40 };

function draw_axes(pen, frame, { z, r, title, r_title }) {
  const { left, top, width, height } = frame;
  pen.strokeStyle = css_colour("axis");
  pen.lineWidth = 1;
  pen.strokeRect(left, top, width, height);
  pen.fillStyle = css_colour("ink");
  pen.textBaseline = "middle";
  pen.textAlign = "left";
  pen.font = `600 13px ${Chart.defaults.font.family}`;
  pen.fillText(title, left, 11);
  pen.font = `12px ${Chart.defaults.font.family}`;
  pen.fillStyle = css_colour("muted");
  pen.textAlign = "center";
  for (const tick of round_ticks(z[0], z[1], width < 260 ? 4 : 6)) {
    const x = left + (width * (tick - z[0])) / (z[1] - z[0]);
    pen.fillRect(x - 0.5, top + height, 1, 4);
    pen.fillText(fmt(tick), x, top + height + 13);
  }
  pen.fillText("face width z [mm]", left + width / 2, top + height + 31);
  pen.textAlign = "right";
  for (const tick of round_ticks(r[0], r[1], 5)) {
    const y = top + height * (1 - (tick - r[0]) / (r[1] - r[0]));
    pen.fillRect(left - 4, y - 0.5, 4, 1);
    pen.fillText(fmt(tick, 5), left - 7, y);
  }
  pen.save();
  pen.translate(9, top + height / 2);
  pen.rotate(-Math.PI / 2);
  pen.textAlign = "center";
  pen.fillText(r_title, 0, 0);
  pen.restore();
}

/** Paints raster {columns, rows, values, is_bare?} (row 0 = smallest radius; null = nothing there), bare places grey. */
function paint_raster(pen, frame, raster, scale, opacity = 1) {
  const image = document.createElement("canvas");
  image.width = raster.columns;
  image.height = raster.rows;
  const ink = image.getContext("2d"), pixels = ink.createImageData(raster.columns, raster.rows);
  const bare = [1, 3, 5].map((at) => parseInt(css_colour("bare").slice(at, at + 2), 16));
  raster.values.forEach((value, cell) => {
    if (!is_number(value)) return;
    const is_bare = raster.is_bare && raster.is_bare(value);
    const colour = is_bare ? bare : map_colour((value - scale.low) / (scale.high - scale.low || 1));
    const column = cell % raster.columns, row = raster.rows - 1 - (cell - column) / raster.columns;
    pixels.data.set([...colour, 255], 4 * (row * raster.columns + column));
  });
  ink.putImageData(pixels, 0, 0);
  pen.save();
  pen.globalAlpha = opacity;
  pen.imageSmoothingEnabled = false;
  pen.drawImage(image, frame.left, frame.top, frame.width, frame.height);
  pen.restore();
}

/**
 * Maps of one quantity side by side on one colour scale, with a hover read-out that follows in all of them.
 * @param maps  [{name, title, raster, opacity?, read(z, r) -> text, overlay?(pen, to_x, to_y), marks?(pen, to_x, to_y)}]; marks may lie on the
 *              map's rim and are not cut off
 * @param area  {z: [low, high], r: [low, high]} in mm, common to the maps
 */
function flank_maps(plot, { maps, area, scale, unit, r_title, height = MAP_HEIGHT }) {
  const row = el("div", { class: "maps" });
  const read_out = el("p", { class: "read-out", "aria-live": "off" }, "\u00a0");
  plot.append(row, read_out);
  // A row wider than its room by a fraction of a pixel wraps, and clientWidth is rounded.
  const bar_width = 76, gap = 10, available = (plot.clientWidth || 901) - 1;
  const stacked = maps.length > 1 && available < 640;
  const width = Math.max(220, stacked ? available - bar_width - gap
    : Math.min(620, (available - bar_width) / maps.length - gap));
  const frame = { left: MAP_MARGIN.left, top: MAP_MARGIN.top, width: width - MAP_MARGIN.left - MAP_MARGIN.right,
    height: height - MAP_MARGIN.top - MAP_MARGIN.bottom };
  const to_x = (z) => frame.left + (frame.width * (z - area.z[0])) / (area.z[1] - area.z[0]);
  const to_y = (r) => frame.top + frame.height * (1 - (r - area.r[0]) / (area.r[1] - area.r[0]));

  const point_at = (event) => {
    const box = event.currentTarget.getBoundingClientRect();
    const across = ((event.clientX - box.left) * (width / box.width) - frame.left) / frame.width;
    const up = 1 - ((event.clientY - box.top) * (height / box.height) - frame.top) / frame.height;
    if (across < 0 || across > 1 || up < 0 || up > 1) return null;
    return { z: area.z[0] + across * (area.z[1] - area.z[0]), r: area.r[0] + up * (area.r[1] - area.r[0]) };
  };
  const show = (event) => {
    const point = point_at(event);
    read_out.textContent = point === null ? "\u00a0"
      : `z ${fmt(point.z, 3)} mm, radius ${fmt(point.r, 5)} mm:  `
        + maps.map((map) => (maps.length > 1 ? `${map.name} ` : "") + map.read(point.z, point.r)).join("   ·   ");
  };
  for (const map of maps) {
    const { canvas, pen } = sharp_canvas(width, height, `${map.title}, flank map in ${unit}`);
    paint_raster(pen, frame, map.raster, scale, map.opacity);
    if (map.overlay) {
      pen.save();
      pen.beginPath();
      pen.rect(frame.left, frame.top, frame.width, frame.height);
      pen.clip();
      map.overlay(pen, to_x, to_y);
      pen.restore();
    }
    draw_axes(pen, frame, { z: area.z, r: area.r, title: map.title, r_title });
    if (map.marks) map.marks(pen, to_x, to_y);
    canvas.addEventListener("pointermove", show);
    canvas.addEventListener("pointerleave", () => (read_out.textContent = "\u00a0"));
    row.append(canvas);
  }
  row.append(colour_bar(scale, unit, height));
}

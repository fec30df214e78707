// Values on a rectangular grid of the flank: interpolation and contour lines.

/** grid {z: [n], r: [m], rows: [m][n]} -> bilinear value at (z, r), null outside or where a corner is missing. */
function grid_value(grid, z, r) {
  const cell = (knots, x) => {
    if (x < knots[0] || x > knots[knots.length - 1]) return -1;
    let i = 0;
    while (i < knots.length - 2 && x > knots[i + 1]) ++i;
    return i;
  };
  const i = cell(grid.z, z), j = cell(grid.r, r);
  if (i < 0 || j < 0) return null;
  const s = (z - grid.z[i]) / (grid.z[i + 1] - grid.z[i]);
  const t = (r - grid.r[j]) / (grid.r[j + 1] - grid.r[j]);
  const corner = (row, column) => list(grid.rows[row])[column];
  const corners = [corner(j, i), corner(j, i + 1), corner(j + 1, i), corner(j + 1, i + 1)];
  if (!corners.every(is_number)) return null;
  return (1 - t) * ((1 - s) * corners[0] + s * corners[1]) + t * ((1 - s) * corners[2] + s * corners[3]);
}

/** The grid sampled on a raster over `area`. */
function grid_raster(grid, area, columns = 220, rows = 110) {
  const values = new Array(columns * rows).fill(null);
  const along = (range, k, count) => range[0] + ((k + 0.5) / count) * (range[1] - range[0]);
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      values[row * columns + column] = grid_value(grid, along(area.z, column, columns), along(area.r, row, rows));
    }
  }
  return { columns, rows, values };
}

/**
 * Segments [[z, r], [z, r]] on which the interpolated grid takes the value `level`: each grid cell is split into two
 * triangles, in which the value is linear, so no cell is ambiguous.
 */
function contour_segments(grid, level) {
  const segments = [];
  const visit = (triangle) => {
    if (!triangle.every((corner) => is_number(corner[2]))) return;
    const cuts = [];
    for (let k = 0; k < 3; ++k) {
      const a = triangle[k], b = triangle[(k + 1) % 3];
      if (a[2] < level === b[2] < level) continue;
      const t = (level - a[2]) / (b[2] - a[2]);
      cuts.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
    }
    if (cuts.length === 2) segments.push(cuts);
  };
  const node = (j, i) => [grid.z[i], grid.r[j], list(grid.rows[j])[i]];
  for (let j = 0; j + 1 < grid.r.length; ++j) {
    for (let i = 0; i + 1 < grid.z.length; ++i) {
      visit([node(j, i), node(j, i + 1), node(j + 1, i + 1)]);
      visit([node(j, i), node(j + 1, i + 1), node(j + 1, i)]);
    }
  }
  return segments;
}

/** Draws the contour lines of `levels` and writes each level once, where its line is nearest to the map's diagonal, unless another label is there. */
function draw_contours(pen, grid, levels, to_x, to_y) {
  const left = to_x(grid.z[0]), right = to_x(grid.z[grid.z.length - 1]);
  const low = to_y(grid.r[0]), high = to_y(grid.r[grid.r.length - 1]);
  const written = [];
  levels.forEach((level) => {
    const segments = contour_segments(grid, level);
    if (segments.length === 0) return;
    pen.beginPath();
    for (const [from, to] of segments) {
      pen.moveTo(to_x(from[0]), to_y(from[1]));
      pen.lineTo(to_x(to[0]), to_y(to[1]));
    }
    pen.strokeStyle = "rgba(0,0,0,.45)";
    pen.lineWidth = 2.4;
    pen.stroke();
    pen.strokeStyle = "#fff";
    pen.lineWidth = 1;
    pen.stroke();

    const spots = segments.map(([from]) => [to_x(from[0]), to_y(from[1])])
      .filter(([x, y]) => x > left + 16 && x < right - 16 && y > high + 10 && y < low - 10);
    if (spots.length === 0) return;
    const off_diagonal = ([x, y]) => Math.abs((x - left) / (right - left) - (low - y) / (low - high));
    const [x, y] = spots.reduce((best, spot) => (off_diagonal(spot) < off_diagonal(best) ? spot : best));
    if (written.some((other) => Math.hypot(other[0] - x, other[1] - y) < 22)) return;
    written.push([x, y]);
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.lineWidth = 3;
    pen.lineJoin = "round";
    pen.strokeStyle = "rgba(0,0,0,.7)";
    pen.strokeText(fmt(level), x, y);
    pen.fillStyle = "#fff";
    pen.fillText(fmt(level), x, y);
  });
}

// Line, scatter and bar plots on Chart.js, with the axes and read-outs that the page uses throughout.

Chart.defaults.font.family = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
Chart.defaults.animation = false;
Chart.defaults.maintainAspectRatio = false;
// Twice the screen's resolution at least, so that the printed page stays sharp.
Chart.defaults.devicePixelRatio = Math.max(2, window.devicePixelRatio || 1);

const axis = (title, more = {}) => ({
  title: { display: true, text: title },
  grid: { color: css_colour("grid"), borderColor: css_colour("axis") },
  ...more,
  ticks: { callback: (value) => fmt(value, 5), maxRotation: 0, includeBounds: false, ...(more.ticks || {}) },
});

/** Legend entries that are dashed where their curve is. */
const labels_with_dashes = (chart) => Chart.defaults.plugins.legend.labels.generateLabels(chart)
  .map((item) => ({ ...item, lineDash: chart.data.datasets[item.datasetIndex].borderDash }));

const legend = (show, of_lines = false) => ({
  display: show,
  position: "top",
  align: "start",
  labels: {
    usePointStyle: true,
    boxWidth: 18,
    boxHeight: 7,
    // Long enough to tell dashed from full; points would become ellipses.
    ...(of_lines ? { pointStyleWidth: 30, generateLabels: labels_with_dashes } : {}),
    filter: (item, data) => !data.datasets[item.datasetIndex].quiet,
  },
});

/** Plugin that writes texts beside points, on the side that has room; of texts that would overlap the first one stays. */
const point_labels = (labels) => ({
  id: "point_labels",
  afterDatasetsDraw: ({ ctx: pen, scales, chartArea: area }) => {
    pen.save();
    pen.font = `12px ${Chart.defaults.font.family}`;
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    pen.lineWidth = 4;
    pen.lineJoin = "round";
    pen.strokeStyle = css_colour("surface");
    pen.fillStyle = css_colour("ink");
    const taken = [];
    for (const { x, y, text } of labels) {
      const at_x = scales.x.getPixelForValue(x), at_y = scales.y.getPixelForValue(y);
      if (at_x < area.left || at_x > area.right || at_y < area.top || at_y > area.bottom) continue;
      const width = pen.measureText(text).width;
      const left = at_x + 12 + width < area.right ? at_x + 11 : at_x - 11 - width;
      const place = [left, Math.min(at_y + 18, area.bottom - 10)];
      if (taken.some((other) => Math.abs(other.y - place[1]) < 15 && left < other.right + 8 && other.left < left + width + 8)) {
        continue;
      }
      taken.push({ left, right: left + width, y: place[1] });
      pen.strokeText(text, ...place);
      pen.fillText(text, ...place);
    }
    pen.restore();
  },
});

function make_chart(plot, config, height) {
  const canvas = el("canvas", { role: "img", "aria-label": config.label });
  plot.append(el("div", { class: "chart", style: `height:${height}px` }, canvas));
  live_charts.add(new Chart(canvas, config));
}

/**
 * Curves or points over a linear axis.
 * @param curves  [{label, points: [{x, y}], colour, width?, quiet?, dashed?, scatter?, style?, order?}];
 *                a quiet curve is background: no legend entry, no read-out
 * @param labels  [{x, y, text}] written beside their points
 */
function xy_chart(plot, options) {
  const { label, curves, x, y, x_range = {}, y_range = {}, read_x, read_y, nearest = "x", height = 290, labels = [] } = options;
  const datasets = curves.map((curve) => ({
    label: curve.label,
    quiet: curve.quiet || false,
    data: curve.points.map((p) => ({ x: p.x, y: is_number(p.y) ? p.y : null, note: p.note })),
    borderColor: curve.colour,
    backgroundColor: curve.fill || curve.colour,
    borderWidth: curve.scatter ? (curve.hollow ? 1.5 : 0) : curve.width || 2,
    borderDash: curve.dashed ? [6, 4] : [],
    showLine: !curve.scatter,
    pointRadius: curve.scatter ? curve.size || 3 : 0,
    pointHoverRadius: curve.quiet ? 0 : curve.scatter ? 5 : 3.5,
    pointHitRadius: curve.quiet ? 0 : 8,
    pointStyle: curve.style || (curve.scatter ? "circle" : "line"),
    order: curve.order || 0,
    tension: 0,
  }));
  const read = (item) => {
    const note = item.raw.note ? ` (${item.raw.note})` : "";
    return `${item.dataset.label}: ${(read_y || ((v) => fmt(v)))(item.parsed.y)}${note}`;
  };
  make_chart(plot, {
    label,
    type: "line",
    data: { datasets },
    plugins: [point_labels(labels)],
    options: {
      normalized: true,
      interaction: { mode: "nearest", axis: nearest, intersect: false },
      scales: { x: axis(x, { type: "linear", ...x_range }), y: axis(y, y_range) },
      plugins: {
        legend: legend(curves.filter((curve) => !curve.quiet).length > 1, curves.every((curve) => !curve.scatter)),
        tooltip: {
          filter: (item) => !item.dataset.quiet,
          callbacks: { title: (items) => (items.length ? (read_x || fmt)(items[0].parsed.x) : ""), label: read },
        },
      },
    },
  }, height);
}

/** Bars side by side, one group a label. @param series  [{label, values, colour}] */
function bar_chart(plot, { label, labels, series, x, y, unit, height = 290 }) {
  make_chart(plot, {
    label,
    type: "bar",
    data: {
      labels,
      datasets: series.map((s) => ({
        label: s.label, data: s.values, backgroundColor: s.colour, categoryPercentage: 0.7, barPercentage: 0.95,
        maxBarThickness: 56,
      })),
    },
    options: {
      interaction: { mode: "index", intersect: false },
      scales: {
        x: axis(x, { grid: { display: false }, ticks: { callback: (_, i) => labels[i] } }),
        y: axis(y, { beginAtZero: true }),
      },
      plugins: {
        legend: { ...legend(series.length > 1), labels: { boxWidth: 12, boxHeight: 12 } },
        tooltip: { callbacks: { label: (item) => `${item.dataset.label}: ${fmt(item.parsed.y)} ${unit}` } },
      },
    },
  }, height);
}

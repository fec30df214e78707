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

/** Plugin that writes texts beside points, where they cover neither another such point nor another text; without a text where there is no such place. */
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
    const inside = ({ x, y }) => x >= area.left && x <= area.right && y >= area.top && y <= area.bottom;
    const points = labels.map(({ x, y, text }) => ({ x: scales.x.getPixelForValue(x), y: scales.y.getPixelForValue(y), text })).filter(inside);
    const taken = points.map(({ x, y }) => ({ left: x - 9, right: x + 9, top: y - 9, bottom: y + 9 }));
    for (const { x, y, text } of points) {
      const width = pen.measureText(text).width;
      const right = x + 12, left = x - 12 - width;
      const places = [[right, y + 18], [left, y + 18], [right, y], [left, y], [right, y - 18], [left, y - 18]];
      const box = ([at, middle]) => ({ left: at - 3, right: at + width + 3, top: middle - 7, bottom: middle + 7 });
      const free = places.find((place) => {
        const own = box(place);
        return own.left >= area.left && own.right <= area.right && own.top >= area.top && own.bottom <= area.bottom
          && taken.every((other) => own.right < other.left || other.right < own.left || own.bottom < other.top || other.bottom < own.top);
      });
      if (!free) continue;
      taken.push(box(free));
      pen.strokeText(text, ...free);
      pen.fillText(text, ...free);
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

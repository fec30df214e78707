// Line, scatter and bar plots on Chart.js, with the axes and read-outs that the page uses throughout.

Chart.defaults.font.family = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
Chart.defaults.animation = false;
Chart.defaults.maintainAspectRatio = false;
// Twice the screen's resolution at least, so that the printed page stays sharp.
Chart.defaults.devicePixelRatio = Math.max(2, window.devicePixelRatio || 1);

/** A tick's number with as many decimals as distinguish it from its neighbours. */
function tick_text(value, _, ticks) {
  const step = ticks.length > 1 ? Math.abs(ticks[1].value - ticks[0].value) : 0;
  const decimals = step > 0 ? Math.ceil(-Math.log10(step) - 1e-9) : -1;
  if (!(decimals > 0)) return fmt(Number(value.toPrecision(12)), 5);
  const is_whole = (places) => ticks.every((tick) => Math.abs(tick.value * 10 ** places - Math.round(tick.value * 10 ** places)) < 1e-6);
  return fixed(value, is_whole(decimals) ? decimals : decimals + 1);
}

const axis = (title, more = {}) => ({
  title: { display: true, text: title },
  grid: { color: css_colour("grid"), borderColor: css_colour("axis") },
  ...more,
  ticks: { callback: tick_text, maxRotation: 0, includeBounds: false, ...(more.ticks || {}) },
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
    // Long enough to show the dashes; points would become ellipses.
    ...(of_lines ? { pointStyleWidth: 30, generateLabels: labels_with_dashes } : {}),
    filter: (item, data) => !data.datasets[item.datasetIndex].quiet,
  },
});

/** Plugin that writes texts beside points where they cover neither another such point nor another text; texts without room are left out. Those with `above` are tried over the middle of their point first. */
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
    const points = labels.map(({ x, y, text, above }) => ({ x: scales.x.getPixelForValue(x), y: scales.y.getPixelForValue(y), text, above })).filter(inside);
    const taken = points.map(({ x, y }) => ({ left: x - 9, right: x + 9, top: y - 9, bottom: y + 9 }));
    for (const { x, y, text, above } of points) {
      const width = pen.measureText(text).width;
      const right = x + 12, left = x - 12 - width;
      const places = [...(above ? [[Math.max(area.left + 4, x - 0.5 * width), y - 18]] : []), [right, y + 18], [left, y + 18], [right, y], [left, y], [right, y - 18], [left, y - 18]];
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
 * @param labels  [{x, y, text, above?}] written beside their points
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

/** Plugin that draws the error of every bar as a whisker, and leaves a bar hollow that is smaller than its error. */
const error_whiskers = {
  id: "error_whiskers",
  afterDatasetsDraw: (chart) => {
    const { ctx: pen, data, scales, chartArea } = chart;
    pen.save();
    pen.strokeStyle = css_colour("ink");
    pen.lineWidth = 1.2;
    data.datasets.forEach((dataset, k) => chart.getDatasetMeta(k).data.forEach((bar, i) => {
      const error = list(dataset.errors)[i], value = dataset.data[i];
      if (!(error > 0) || !is_number(value)) return;
      const top = Math.max(chartArea.top, scales.y.getPixelForValue(value + error));
      const bottom = scales.y.getPixelForValue(Math.max(0, value - error)), half = Math.min(4, 0.3 * bar.width);
      pen.beginPath();
      for (const y of [top, bottom]) {
        pen.moveTo(bar.x - half, y);
        pen.lineTo(bar.x + half, y);
      }
      pen.moveTo(bar.x, top);
      pen.lineTo(bar.x, bottom);
      pen.stroke();
    }));
    pen.restore();
  },
};

/** Bars side by side, one group a label. @param series  [{label, values, errors?, colour}] @param y_range  options of the y axis */
function bar_chart(plot, { label, labels, series, x, y, unit, y_range = {}, height = 290 }) {
  const drowned = (s, i) => list(s.errors)[i] >= Math.abs(s.values[i]);
  const highest = maximum(series.flatMap((s) => s.values.map((value, i) => value + (list(s.errors)[i] ?? 0))));
  make_chart(plot, {
    label,
    type: "bar",
    plugins: [error_whiskers],
    data: {
      labels,
      datasets: series.map((s) => ({
        label: s.label, data: s.values, errors: s.errors, categoryPercentage: 0.7, barPercentage: 0.95, maxBarThickness: 56,
        backgroundColor: list(s.errors).length ? s.values.map((_, i) => (drowned(s, i) ? "transparent" : s.colour)) : s.colour,
        borderColor: s.colour, borderWidth: list(s.errors).length ? s.values.map((_, i) => (drowned(s, i) ? 1 : 0)) : 0,
      })),
    },
    options: {
      interaction: { mode: "index", intersect: false },
      scales: {
        x: axis(x, { grid: { display: false }, ticks: { callback: (_, i) => labels[i] } }),
        y: axis(y, { beginAtZero: true, ...(is_number(highest) ? { suggestedMax: highest } : {}), ...y_range }),
      },
      plugins: {
        legend: { ...legend(series.length > 1), labels: { boxWidth: 12, boxHeight: 12,
          generateLabels: () => series.map((s) => ({ text: s.label, fillStyle: s.colour, strokeStyle: s.colour, fontColor: css_colour("muted") })) } },
        tooltip: { callbacks: { label: (item) => `${item.dataset.label}: ${with_error(item.parsed.y, list(item.dataset.errors)[item.dataIndex], 4)} ${unit}` } },
      },
    },
  }, height);
}

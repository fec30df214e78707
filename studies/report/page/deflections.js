// Deflection curves of single gears: of a fit, and of every pair with finite elements.

const MODEL_LABEL = {
  "finite elements": "finite elements",
  fitted: "fitted kernels",
  thesis: "Haddad's curves, body apart",
  plate: "cantilever plate",
  "thin slices": "thin slices",
};

const HEIGHT_LABEL = { 1: "tip", 0: "middle", "-1": "root" };

/** "Pinion, 18 teeth" */
const gear_title = (fit) => `${capital(fit.gear || "gear")}, ${fmt(fit.teeth)} teeth`;

/** A choice of one of a few things that redraws a figure. */
function add_choice(parent, label, options, state, key, redraw) {
  if (options.length < 2) return;
  const { node } = choice(label, options, String(state[key]), (value) => {
    state[key] = value;
    redraw();
  });
  node.classList.add("no-print");
  parent.append(node);
}

function draw_deflections(plot, fit, state) {
  const curves = list(fit.curves).map(record);
  const loads = unique(curves.map((curve) => record(curve.load).u));
  const stations = unique(curves.map((curve) => record(curve.load).zeta)).sort((a, b) => a - b);
  const teeth = unique(curves.map((curve) => curve.tooth)).sort((a, b) => a - b);
  const ends = ["acute end", "mid face", "obtuse end"];
  const area = el("div");
  const draw = () => {
    clear_plot(area);
    const shown = curves.filter((curve) => String(curve.load.u) === state.u && String(curve.load.zeta) === state.zeta
      && String(curve.tooth) === state.tooth);
    const models = Object.keys(MODEL_LABEL);
    const width = { "finite elements": 3.4 };
    xy_chart(area, {
      label: "Deflection along the tooth under a point load",
      curves: shown.map((curve) => ({
        label: MODEL_LABEL[curve.model] || curve.model,
        points: list(curve.zeta).map((zeta, i) => ({ x: zeta, y: curve.value[i] })),
        colour: curve.model === "finite elements" ? css_colour("ink") : sequence_colour(models.indexOf(curve.model) - 1),
        width: width[curve.model] || 1.8,
        dashed: curve.model === "thin slices" || curve.model === "thesis",
        order: curve.model === "finite elements" ? 1 : 0,
      })),
      x: "from the acute end [modules]", y: "deflection · E mₙ / F",
      read_x: (x) => `${fmt(x, 3)} modules from the acute end`, read_y: (y) => fmt(y, 3), height: 340,
    });
  };
  const choices = el("div");
  const option = (value, label) => ({ value: String(value), label });
  add_choice(choices, "Load at the", loads.map((u) => option(u, HEIGHT_LABEL[u] || `u = ${fmt(u, 2)}`)), state, "u", draw);
  add_choice(choices, "of the", stations.map((zeta, i) => option(zeta, stations.length === 3 ? ends[i] : fmt(zeta, 3))),
    state, "zeta", draw);
  const tooth_name = (tooth) => (tooth === 0 ? "the loaded one" : `${fmt(Math.abs(tooth))} ${tooth > 0 ? "after" : "before"} it`);
  add_choice(choices, "Tooth", teeth.map((tooth) => option(tooth, tooth_name(tooth))), state, "tooth", draw);
  plot.append(choices, area);
  draw();
}

function build_deflections(results, body) {
  for (const fit of [...list(results.fit), ...list(results.deflections)].map(record)) {
    const curves = list(fit.curves).map(record);
    if (curves.length === 0) continue;
    const zetas = unique(curves.map((curve) => record(curve.load).zeta)).sort((a, b) => a - b);
    const state = { u: "1", zeta: String(zetas[Math.floor(zetas.length / 2)]), tooth: "0" };
    figure(figure_grid(body), {
      title: `${gear_title(fit)}: deflection along a tooth under a point load`,
      wide: true,
      caption: "Deflection of the tooth's centre surface along the flank normal at the height of the load, times E mₙ / F, "
        + "without local contact and shaft motion. The plate and the slices model neither the gear body nor other teeth; the "
        + "load on the slices is spread over one module of the contact line.",
    }, (plot) => draw_deflections(plot, fit, state));
  }
}

add_sections({ deflections: build_deflections });

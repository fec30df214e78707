// The sheet of each flank for the drawing: K-charts and amounts.

function build_drawing(results, body) {
  const limits = list(record(results.optimise).grinding_limits).map(record);
  if (limits.length > 0) {
    table(body, {
      title: "Limits of the grinding",
      columns: [{ label: "Limit" }, { label: "Value" }, { label: "At most" }, { label: "Unit" }, { label: "State" }],
      rows: limits.map((limit) => [capital(`${limit.name}`), limit.value, limit.limit, pretty_unit(limit.unit), `${limit.state}`]),
    });
  }
  const choices = list(record(results.optimise).grinding_choices).map(record);
  if (choices.length > 0) {
    const unit = pretty_unit(record(results.optimise).objective_unit), statistic = choices[0].statistic_in_words;
    table(body, {
      title: "What of the optimum could not be ground",
      columns: [{ label: "Modification" }, { label: "At the optimum" }, { label: "Tried" }, { label: `Gives${statistic ? ` a ${statistic} of` : ""}${unit ? ` [${unit}]` : ""}` }, { label: "Taken" }],
      rows: choices.flatMap((choice) => list(choice.tried).map(record).map((tried, i) => [
        i === 0 ? capital(list(choice.amounts).map((amount) => words(amount.key)).join(" beside ")) : "",
        i === 0 ? list(choice.amounts).map((amount) => `${fmt(amount.found, 3)} ${pretty_unit(amount.unit)}`).join(", ") : "",
        choice.rule === "not_together" ? `without ${words(tried.key)}`
          : tried.held === "at zero" ? "none" : `${tried.held} ${fmt(tried.limit, 4)} ${pretty_unit(list(choice.amounts)[0].unit)}`,
        tried.objective ?? null, tried.taken ? "yes" : "no"])),
      note: "Each way is the best design found with that modification held, the others free.",
    });
  }
  const grid = figure_grid(body);
  for (const entry of list(results.drawing).map(record)) {
    figure(grid, {
      title: capital(`${entry.gear}`),
      wide: true,
      caption: `Each design trace with its band of class ${fmt(entry.iso_1328_class, 2)} of ISO 1328-1: half of the total tolerance either way, and the tolerances of the amounts. `
        + `drawing-${entry.gear}.svg in the results folder is the same sheet.`,
    }, (plot) => {
      // The sheet is made by the program from numbers and names of its own; it is parsed as a picture, so that nothing in it runs.
      const sheet = new DOMParser().parseFromString(`${entry.sheet ?? ""}`, "image/svg+xml").documentElement;
      sheet.setAttribute("style", "background: white; max-width: 100%; height: auto");
      plot.append(document.importNode(sheet, true));
    });
  }
}

add_sections({ drawing: build_drawing });

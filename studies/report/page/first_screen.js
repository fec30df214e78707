// The first screen: panels with the main results. Each task has its own panels; sections below show the same in full.

/**
 * A panel of the first screen with a heading; draw(plot) is called now and whenever the colours change.
 * @param span  of twelve columns
 */
function panel(parent, { title, span, href }, draw) {
  const plot = el("div", { class: "plot" });
  const heading = el("h3", {}, href && document.getElementById(href) ? el("a", { href: `#${href}` }, title) : title);
  parent.append(el("div", { class: `panel span-${span}` }, heading, plot));
  figures.push(() => {
    clear_plot(plot);
    draw(plot);
  });
}

/** Rows of facts: [[name, value, class?]]; a value is text or an element. */
const facts = (rows) => el("dl", { class: "facts" }, ...rows.filter((row) => row && row[1] !== null && row[1] !== undefined)
  .flatMap(([name, value, style]) => [el("dt", {}, name), el("dd", { class: style ?? null }, value)]));

/** Panels of the task. An error is reported in the panel and does not affect the rest of the page. */
function draw_first_screen(results, selection) {
  const first = document.getElementById("first");
  try {
    task_part(results, "first")(first, results, selection);
  } catch (failure) {
    first.append(el("p", { class: "banner bad" }, `The first screen could not be built: ${failure.message}`));
    console.error(failure);
  }
}

// Looks at a report from within, after its own scripts: says "all is well" or what is not, in an element that the test reads.
(() => {
  const wrong = [];
  const check = (holds, what) => holds || wrong.push(what);
  const picture = (section) => [...section.querySelectorAll("canvas")].map((canvas) => canvas.toDataURL()).join("");
  const move = (input, value) => {
    input.value = value;
    input.dispatchEvent(new Event("input"));
  };

  for (const id of expected) {
    const section = document.getElementById(id);
    check(section && section.querySelector("canvas, svg, table, ul"), `${id} is empty`);
  }
  for (const canvas of document.querySelectorAll("main canvas")) {
    const blank = document.createElement("canvas");
    [blank.width, blank.height] = [canvas.width, canvas.height];
    check(canvas.width > 0 && canvas.toDataURL() !== blank.toDataURL(), `nothing is drawn on "${canvas.getAttribute("aria-label")}"`);
  }
  for (const card of document.querySelectorAll(".table-card .scroll")) {
    check(card.scrollWidth <= card.clientWidth + 1, `a table is wider than its card: ${card.closest(".table-card").textContent.slice(0, 60)}`);
  }

  // The first screen answers in words that a person writes, and every chooser begins at the scene that governs.
  const first = document.getElementById("first");
  check(first.querySelectorAll(".panel").length >= 2, "the first screen has no panels");
  check(!document.querySelector("main .banner.bad"), `a part could not be built: ${document.querySelector("main .banner.bad")?.textContent}`);
  for (const panel of first.querySelectorAll(".panel")) check(panel.querySelector(".plot").childElementCount > 0, `${panel.textContent} is empty`);
  const spoken = first.cloneNode(true);
  spoken.querySelectorAll("code").forEach((file) => file.remove());
  const written = [document.getElementById("headline"), spoken].map((part) => part.textContent).join(" ");
  check(!/[a-z]_[a-z]|modification\.|undefined|NaN/.test(written), `the first screen has a key in it: ${/\S*([a-z]_[a-z]|modification\.|undefined|NaN)\S*/.exec(written)?.[0]}`);
  if (document.getElementById("scenes")) {
    for (const heading of ["What to grind", "How much better", "How sure", "What it costs"]) {
      check([...first.querySelectorAll("h3")].some((h3) => h3.textContent.startsWith(heading)), `the first screen does not say "${heading}"`);
    }
    const bold = first.querySelector("svg text.strong")?.firstChild.data.replace("…", "");
    for (const select of document.querySelectorAll("#flank-load select, #transmission-error select, #stiffness select")) {
      const chosen = select.selectedOptions[0].textContent;
      check(chosen.endsWith("(governs)") && (!bold || chosen.startsWith(bold)), `the chooser begins at "${chosen}", and "${bold}" governs`);
    }
  }

  // Words in pictures can be read: about as large as in charts, within their picture, apart from each other. Sheets for the drawing have a size of their own.
  for (const drawing of document.querySelectorAll('main svg[role="img"]')) {
    const frame = drawing.getBoundingClientRect(), label = drawing.getAttribute("aria-label");
    const texts = [...drawing.querySelectorAll("text")].filter((text) => text.textContent.trim() !== "");
    const boxes = texts.map((text) => text.getBoundingClientRect());
    texts.forEach((text, i) => {
      const box = boxes[i], size = parseFloat(getComputedStyle(text).fontSize) * (drawing.getScreenCTM()?.a ?? 1);
      check(size > 10.5, `"${text.textContent}" in "${label}" is ${size.toFixed(1)} px high`);
      check(box.left > frame.left - 2 && box.right < frame.right + 2 && box.top > frame.top - 3 && box.bottom < frame.bottom + 3,
        `"${text.textContent}" in "${label}" is cut off`);
      const over = boxes.findIndex((other, k) => k < i && Math.min(box.right, other.right) - Math.max(box.left, other.left) > 1
        && Math.min(box.bottom, other.bottom) - Math.max(box.top, other.top) > 4);
      check(over < 0, `"${text.textContent}" lies over "${texts[over]?.textContent}" in "${label}"`);
    });
  }

  // Curves over a whole mesh cycle close after one pitch, and nothing is smoothed.
  for (const canvas of document.querySelectorAll("main canvas")) {
    const chart = Chart.getChart(canvas);
    if (!chart || chart.config.type !== "line") continue;
    for (const { data, tension } of chart.data.datasets) {
      check(tension === 0, `a curve of "${canvas.getAttribute("aria-label")}" is smoothed`);
      if (!/over the mesh cycle/.test(canvas.getAttribute("aria-label"))) continue;
      const [begin, end] = [data[0], data[data.length - 1]];
      check(Math.abs(end.x - begin.x - 1) < 1e-9 && end.y === begin.y, `"${canvas.getAttribute("aria-label")}" does not close`);
    }
  }

  // A harmonic smaller than its error is hollow, any other is not.
  for (const canvas of document.querySelectorAll('main canvas[aria-label="Harmonics of the transmission error"]')) {
    for (const { data, errors, backgroundColor } of Chart.getChart(canvas).data.datasets) {
      (errors || []).forEach((error, i) => check((backgroundColor[i] === "transparent") === (error !== null && error >= Math.abs(data[i])),
        `harmonic ${i + 1} is ${data[i]} with error ${error} and drawn ${backgroundColor[i]}`));
    }
  }

  // Damage of load cases adds up to that of the spectrum; bars below a millionth are not drawn.
  for (const canvas of document.querySelectorAll('#life canvas[aria-label$="damage of each load case"]')) {
    for (const { label, data } of Chart.getChart(canvas).data.datasets) {
      const sum = data.slice(0, -1).reduce((a, b) => a + (b ?? 0), 0), whole = data[data.length - 1];
      check(Math.abs(sum - whole) <= 1e-5 * whole + 1e-6 * data.length, `the damage of "${label}" is ${whole}, and its load cases have ${sum}`);
    }
  }
  const flank = [...document.querySelectorAll("#life select")].pop();
  if (flank) {
    const shown = document.getElementById("life").textContent, other = [...flank.options].find((option) => option.value !== flank.value);
    flank.value = other.value;
    flank.dispatchEvent(new Event("change"));
    check(document.getElementById("life").textContent !== shown, "the choice of the flank changes nothing");
  }

  let moved = 0;
  for (const input of document.querySelectorAll("input[type=range]")) {
    const section = input.closest("section"), before = picture(section), text = section.textContent;
    const seen = new Set([before]);
    for (const share of [0.3, 0.6, 1]) {
      move(input, Number(input.min) + share * (input.max - input.min));
      seen.add(picture(section));
    }
    check(seen.size === 4, `${section.id}: the slider shows ${seen.size} pictures at four places`);
    check(section.textContent !== text, `${section.id}: the slider does not say where it is`);
    ++moved;
  }
  check(moved > 0 || !document.getElementById("flank-load"), "there is no slider");

  const page = picture(document.querySelector("main")), button = document.getElementById("theme");
  button.click();
  check(picture(document.querySelector("main")) !== page, "the other colours change no picture");
  check(document.documentElement.dataset.theme === "dark", "the button does not darken the page");
  dispatchEvent(new Event("beforeprint"));
  check(document.documentElement.dataset.theme === "light", "paper is dark");
  for (const complaint of complaints) wrong.push(`console: ${complaint}`);

  const words = wrong.length === 0 ? `all is well (${document.querySelectorAll("main canvas, main svg").length} pictures, ${moved} sliders)` : wrong.join("; ");
  document.body.append(Object.assign(document.createElement("output"), { id: "probe", textContent: words }));
})();

// Numbers as a report writes them, after its dom.js: says "all is well" or what is not, in an element that the test reads.
(() => {
  const wrong = [];
  const check = (found, expected) => found === expected || wrong.push(`"${found}" is written instead of "${expected}"`);

  // A value is rounded to the size of its error, and both are written alike.
  check(with_error(0.2834, 0.0121), "0.283 ± 0.012");
  check(with_error(1234, 310), "1200 ± 300");
  check(with_error(2.7e7, 6238070), "(2.7 ± 0.6)·10⁷");
  check(with_error(2.993e-21, 2.1e-21), "(3 ± 2)·10⁻²¹");
  check(with_error(-3.2e-6, 2.2e-7), "(−3.2 ± 0.2)·10⁻⁶");
  check(with_error(0, 4e-9), "(0 ± 4)·10⁻⁹");
  check(with_error(0.5, 1e-9), "0.5");
  check(with_error(0.5, null), "0.5");

  // Only what falls to nothing falls by 100 %.
  check(percent_change(3.0023, 0.012895), "−99.6 %");
  check(percent_change(2.3e8, 78), "−99.99 %");
  check(percent_change(2, 0), "−100 %");
  check(percent_change(100, 1), "−99 %");
  check(percent_change(100, 300), "+200 %");
  check(percent_change(0, 3), null);

  check(in_unit(fmt(0.5), ""), "0.5");
  check(in_unit(fmt(1500), "MPa"), "1500 MPa");

  document.body.append(Object.assign(document.createElement("output"), { id: "probe", textContent: wrong.length === 0 ? "all is well" : wrong.join("; ") }));
})();

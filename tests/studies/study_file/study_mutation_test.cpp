#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "studies/study_file/study_file.hpp"
#include "studies/tasks/study_template.hpp"
#include "tests/common/random.hpp"

using namespace flankwright::studies;

namespace {

/// Either a study or errors with at least one problem; anything else fails the test.
void read_anything(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    const Study study = parse_study(text, "mutated.toml", overrides);
    CHECK(!study.scenes.empty());
  } catch (const StudyErrors& errors) {
    CHECK(!errors.problems().empty());
  }
}

}  // namespace

TEST_CASE("No damage to a study file makes the reader fail otherwise than with errors", "[studies][fuzz]") {
  flankwright::tests::Random32 random(20260611);
  const std::vector<std::string> pieces{"[",
                                        "]",
                                        "{",
                                        "}",
                                        "=",
                                        "\"",
                                        "'",
                                        ".",
                                        ",",
                                        "\n",
                                        "#",
                                        "1e308",
                                        "-1",
                                        "nan",
                                        "inf",
                                        "true",
                                        "[[pair]]",
                                        "[scenes]",
                                        "\\u",
                                        "\xc3",
                                        "\"\"",
                                        "5e-324",
                                        "9223372036854775807",
                                        "1979-05-27",
                                        "\r",
                                        "0x7",
                                        "\"3 um\"",
                                        "[]",
                                        "{}"};
  std::vector<std::string> templates{study_template("analyse"), study_template("optimise")};
  for (std::string& text : templates) {  // odd gears' sections take long to mesh, and are not what this is about
    const std::string fitted = "compliance = \"fitted\"";
    text.replace(text.find(fitted), fitted.size(), "compliance = \"thin_slice\"");
  }
  for (int run = 0; run < 600; ++run) {
    std::string text = random.one_of(templates);
    const std::size_t changes = 1 + random.below(4);
    for (std::size_t change = 0; change < changes; ++change) {
      const std::size_t at = random.below(text.size());
      const std::size_t length = 1 + random.below(12);
      switch (random.below(5)) {
        case 0:
          text[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, random.one_of(pieces));
          break;
        case 3:
          text.insert(at, text.substr(random.below(text.size()), length));
          break;
        default: {
          // A number for a number: the mutation that the parser itself cannot catch.
          const std::size_t digit = text.find_first_of("0123456789", at);
          if (digit != std::string::npos) text.replace(digit, 1, random.one_of(pieces));
        }
      }
    }
    CAPTURE(run, text);
    read_anything(text);
  }
}

TEST_CASE("No value from the command line makes the reader fail otherwise than with errors", "[studies][fuzz]") {
  const std::string text = study_template("optimise");
  const std::string key =
      GENERATE("", ".", "a..b", "pair", "pair.normal_module", "scenes", "scenes.0", "scenes.0.name.x", "scenes.99.name", "optimise.variables",
               "optimise.objective.te_harmonic_1", "title.x", "\"", "a = 1\nb", "expect", "[x]", "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s");
  const std::string value = GENERATE("", "1", "-1", "nan", "{}", "[]", "[[[", "{ a = { b = 1 } }", "1\nb = 2", "\"", "'x'", "[0, 1]", "\xff");
  CAPTURE(key, value);
  read_anything(text, {{key, value}});
}

TEST_CASE("Keys and arrays nested to absurd depth are refused, not followed", "[studies][fuzz]") {
  std::string dotted = "a";
  for (int i = 0; i < 200'000; ++i) dotted += ".a";
  read_anything(dotted + " = 1");
  read_anything("[" + dotted + "]");
  read_anything("a = { " + dotted + " = 1 }");
  read_anything("t = \"\"\"\n\" # ' \"\"\"\n" + dotted + " = 1");
  read_anything("a = " + std::string(100'000, '['));
  std::string inline_tables;
  for (int i = 0; i < 100'000; ++i) inline_tables += "{ a = ";
  read_anything("a = " + inline_tables);
  CHECK_THROWS_AS(parse_study(dotted + " = 1", "deep.toml"), StudyErrors);
}

TEST_CASE("Many dots in texts, comments and lists of numbers are no deep key", "[studies]") {
  const std::string dots(50, '.');
  std::string phases = "[0.5";
  for (int i = 0; i < 50; ++i) phases += ", 0.5";
  const Study study = parse_study("# " + dots + "\ntitle = \"" + dots + "\"\n[cycle]\nphases = " + phases + "]\n" +
                                      "[pair]\nnormal_module = 4\n[pinion]\nteeth = 20\nface_width = 10\n" + "[wheel]\nteeth = 30\nface_width = 10\n",
                                  "dots.toml");
  CHECK(study.title == dots);
  CHECK(study.cycle.phases.size() == 51);
}

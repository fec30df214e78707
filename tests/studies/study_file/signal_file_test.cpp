#include "studies/study_file/signal_file.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/base/thread_stopwatch.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/stored_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/common/random.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/study_file/life_texts.hpp"

namespace flankwright::studies {
namespace {

const std::string signal_pair = life_pair + life_strength;

/// A triangle from 0 to 400 N·m and back in 20 s, then 5 s at -100 N·m.
const std::string triangle = "time,torque,speed\n0,0,1200\n10,400,1200\n20,0,1200\n20.001,-100,1200\n25,-100,1200\n";

/// A study in a folder with a signal, under a spectrum of these keys.
struct SignalFolder {
  command_line::ScratchFolder folder;

  explicit SignalFolder(const std::string& signal) { folder.file("torque.csv", signal); }

  std::string study_path() const { return (folder.path() / "drive.toml").string(); }
  Study study(const std::string& keys, const std::string& load = "") const {
    return parse_study(signal_pair + "[load]\n" + load + "spectrum = { " + keys + " }\n", study_path());
  }
  StudyProblem problem(const std::string& keys, const std::string& load = "") const {
    try {
      study(keys, load);
    } catch (const StudyErrors& errors) {
      return errors.problems().front();
    }
    return {};
  }
};

StudyProblem signal_problem(const std::string& text) {
  try {
    parse_signal(text, "torque.csv");
  } catch (const StudyErrors& errors) {
    return errors.problems().front();
  }
  return {};
}

const std::string by_signal = "signal = \"torque.csv\"";

}  // namespace

TEST_CASE("A signal is read from columns of any order and unit", "[studies][life]") {
  const LoadSignal signal = parse_signal("# test bench\nspeed [rad/s];time_ms; torque (kN·m)\n10; 0; 0.1\n\n-20;500;-0.2 # reversed\n", "torque.csv");
  CHECK(signal.time == std::vector<double>{0.0, 0.5});
  CHECK(signal.torque[0] == Approx(1e5).epsilon(1e-14));
  CHECK(signal.torque[1] == Approx(-2e5).epsilon(1e-14));
  CHECK(signal.speed == std::vector<double>{10.0, -20.0});
  CHECK(parse_signal("torque,time\n1,0\n2,1\n", "torque.csv").speed.empty());
}

TEST_CASE("A malformed signal is refused with line and column", "[studies][life]") {
  const auto place = [](const std::string& text) {
    const StudyProblem problem = signal_problem(text);
    CHECK(problem.file == "torque.csv");
    CHECK(problem.key == "load.spectrum.signal");
    return std::pair(problem.line, problem.column);
  };
  using Place = std::pair<int, int>;
  CHECK(place("time,torque\n0,1\n1,2\n1,3\n") == Place{4, 1});
  CHECK(place("torque,time\n1,0\n1,2\n1,1.5\n") == Place{4, 3});
  CHECK(place("time,torque\n0,1\n1,nan\n") == Place{3, 3});
  CHECK(place("time,torque\n0,1\ninf,2\n") == Place{3, 1});
  CHECK(place("time,torque\n0,\n1,2\n") == Place{2, 3});
  CHECK(place("time,torque\n0,1\n1,1e10\n") == Place{3, 3});
  CHECK(place("time,torque\n0,1\n1,2,3\n") == Place{3, 1});
  CHECK(place("time,torque\n0,1\n") == Place{2, 1});
  CHECK(place("time,torque\n") == Place{1, 1});
  CHECK(place("time,speed\n0,1\n1,2\n") == Place{1, 1});
  CHECK(place("time,moment\n0,1\n1,2\n") == Place{1, 6});
  CHECK(place("time,torque_mm\n0,1\n1,2\n") == Place{1, 6});
  CHECK(place("time,torque,time_s\n0,1,0\n1,2,1\n") == Place{1, 13});
  CHECK(signal_problem("time,torque\n0,1\n1,2\n1,3\n").value == "1");
}

TEST_CASE("Whatever a signal's file holds, it is read or refused", "[studies][life]") {
  tests::Random random(8);
  const std::string letters = "0123456789.-+eE,;\t \n#\"[]naif_torquetimespeed";
  int refused = 0, read = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string text = triangle;
    for (int k = random.integer(0, 3); k > 0; --k) text[random.below(text.size())] = letters[random.below(letters.size())];
    try {
      const LoadSignal signal = parse_signal(text, "torque.csv");
      CHECK_NOTHROW(signal.validate());
      ++read;
    } catch (const StudyErrors&) {
      ++refused;
    }
  }
  CHECK(refused > 100);
  CHECK(read > 100);
}

TEST_CASE("A signal is read in a time that grows as its length", "[studies][life]") {
  const auto text = [](int samples) {
    std::string lines = "time,torque,speed\n";
    for (int i = 0; i < samples; ++i) lines += std::to_string(0.001 * i) + "," + std::to_string(100.0 + i % 50) + ",1500\n";
    return lines;
  };
  const auto seconds = [](const std::string& of) {
    double least = INFINITY;
    for (int i = 0; i < 3; ++i) {
      const ThreadStopwatch clock;
      const LoadSignal signal = parse_signal(of, "torque.csv");
      count_time_at_level(signal, 50);
      count_rainflow(signal, 50);
      least = std::min(least, clock.seconds());
    }
    return least;
  };
  // Sixteen times the lines: sixteen times the work; the square of it would be 256.
  CHECK(seconds(text(160000)) < 64.0 * seconds(text(10000)));
}

TEST_CASE("A study's bins are the time and the revolutions of its signal, repeated for a life", "[studies][life]") {
  const SignalFolder of(triangle);
  const Study study = of.study(by_signal + ", bins = 4, hours = 250");
  constexpr double hour = 3600.0, round_off = 1e-12;
  REQUIRE(study.spectrum.size() == 8);  // four ranges of torque either way
  double hours = 0.0, cycles = 0.0, reversed = 0.0;
  for (const SpectrumBin& bin : study.spectrum) {
    hours += bin.hours;
    cycles += bin.cycles;
    reversed += bin.torque < 0.0 ? bin.hours : 0.0;
    CHECK(bin.speed == Approx(1200.0 * 2.0 * units::pi / 60.0).epsilon(round_off));
    CHECK_FALSE(bin.same_teeth);
  }
  CHECK(hours == Approx(250.0 * hour).epsilon(round_off));
  CHECK(cycles == Approx(250.0 * 60.0 * 1200.0).epsilon(round_off));
  CHECK(reversed == Approx(0.2 * 250.0 * hour).epsilon(round_off));
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(study.spectrum[k].torque == Approx(1e5 * static_cast<double>(k + 1)).epsilon(round_off));
    CHECK(study.spectrum[k].hours == Approx(50.0 * hour).epsilon(round_off));
    CHECK(study.spectrum[k + 4].torque == Approx(-0.25e5 * static_cast<double>(k + 1)).epsilon(round_off));
  }
  REQUIRE(study.scenes.size() == 1);
  CHECK(study.scenes[0].torques.size() == 8);
  // The same life told by the number of repetitions, and a single one without it.
  const Study repeated = of.study(by_signal + ", bins = 4, repeats = 36000"), once = of.study(by_signal + ", bins = 4");
  for (std::size_t k = 0; k < 8; ++k) {
    CHECK(repeated.spectrum[k].cycles == Approx(study.spectrum[k].cycles).epsilon(round_off));
    CHECK(36000.0 * once.spectrum[k].cycles == Approx(study.spectrum[k].cycles).epsilon(round_off));
  }
  CHECK(of.study(by_signal).spectrum.size() == 40);
}

TEST_CASE("Time without load is a bin of its own, once whichever flank works", "[studies][life]") {
  const SignalFolder of("time,torque,speed\n0,200,1200\n4,200,1200\n4.000001,0,1200\n10,0,1200\n10.000001,-100,1200\n15,-100,1200\n");
  const Study study = of.study(by_signal + ", bins = 1");
  REQUIRE(study.spectrum.size() == 3);
  constexpr double ramps = 1e-6;  // part of the time
  const double expected[] = {6.0, 4.0, 5.0}, torques[] = {0.0, 2e5, -1e5};
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(study.spectrum[k].torque == Approx(torques[k]).epsilon(1e-12));  // round-off
    CHECK(study.spectrum[k].hours == Approx(expected[k]).epsilon(ramps));
  }
}

TEST_CASE("A signal of the other sign rates the other flank", "[studies][life]") {
  const SignalFolder of(triangle);
  const Study study = of.study(by_signal + ", bins = 3"), other = of.study(by_signal + ", bins = 3, torque_factor = -2");
  REQUIRE(other.signal);
  constexpr double round_off = 1e-12;
  CHECK(other.signal->largest_torque == Approx(2e5).epsilon(round_off));
  CHECK(other.signal->count.reversed_duration == Approx(20.0).epsilon(1e-4));
  // The same loads, twice as large and of the other flank.
  REQUIRE(other.spectrum.size() == study.spectrum.size());
  for (const SpectrumBin& bin : study.spectrum) {
    const auto there = std::ranges::find_if(other.spectrum, [&](const SpectrumBin& o) { return std::abs(o.torque + 2.0 * bin.torque) < 1.0; });
    REQUIRE(there != other.spectrum.end());
    CHECK(there->hours == Approx(bin.hours).epsilon(round_off));
    CHECK(there->cycles == Approx(bin.cycles).epsilon(round_off));
  }
}

TEST_CASE("A scene of the other flank takes the torques of a signal below 0", "[studies][life]") {
  const SignalFolder of(triangle);
  const std::string text = signal_pair + "[load]\nspectrum = { " + by_signal +
                           ", bins = 1 }\n[[scenes]]\nname = \"drive\"\n[[scenes]]\nname = \"coast\"\nworking_flank = \"left\"\n";
  const Study study = parse_study(text, of.study_path());
  REQUIRE(study.spectrum.size() == 2);
  CHECK(study.scenes[0].torques[0] == Approx(4e5).epsilon(1e-12));  // round-off
  CHECK(study.scenes[0].torques[1] == 0.0);
  CHECK(study.scenes[1].torques[0] == 0.0);
  CHECK(study.scenes[1].torques[1] == Approx(1e5).epsilon(1e-12));
}

TEST_CASE("A signal below 0 alone rates the other flank as its mirror image rates the pair's own", "[studies][life]") {
  const SignalFolder of("time,torque,speed\n0,-300,1200\n10,-500,1200\n20,-300,1200\n");
  const auto run = [&](const std::string& keys, const std::string& scenes) {
    return run_study(
        parse_study(signal_pair + "[load]\nspectrum = { " + by_signal + ", hours = 100, bins = 2" + keys + " }\n" + scenes, of.study_path()));
  };
  const std::string coast = "[[scenes]]\nname = \"coast\"\nworking_flank = \"left\"\n";
  for (const std::string counting : {"time_at_level", "rainflow"}) {
    CAPTURE(counting);
    const std::string by = ", counting = \"" + counting + "\"";
    const StudyResults reversed = run(by, coast), mirrored = run(by + ", torque_factor = -1", "");
    REQUIRE(reversed.study.spectrum.size() == mirrored.study.spectrum.size());
    for (std::size_t k = 0; k < mirrored.study.spectrum.size(); ++k) {
      CHECK(reversed.study.spectrum[k].torque == -mirrored.study.spectrum[k].torque);
      CHECK(reversed.study.spectrum[k].cycles == mirrored.study.spectrum[k].cycles);
    }
    const auto damage = [](const StudyResults& results) {
      return results_document(results).at("life").at("spectra")[0].at("pinion").at("contact").at("damage").get<double>();
    };
    CHECK(damage(mirrored) > 0.0);
    CHECK(damage(reversed) == Approx(damage(mirrored)).epsilon(1e-9));  // a spur pair is its own mirror image: round-off
  }
  // Without a scene of that flank nothing is rated, and it is said so.
  const StudyResults alone = run("", "");
  CHECK(alone.loaded.empty());
  CHECK(std::ranges::count(
            alone.notes,
            "load.spectrum: for 100 % of the revolutions the torque is below 0 and loads the other flank, which counts as time without load "
            "here; a scene with the other working_flank rates that one") == 1);
}

TEST_CASE("Rainflow gives both gears' teeth the cycles of the torque", "[studies][life]") {
  const SignalFolder of("time,torque\n0,0\n1,300\n2,0\n3,300\n4,0\n5,100\n6,0\n");
  const Study study = of.study(by_signal + ", counting = \"rainflow\", bins = 2, repeats = 1000", "speed = 1500\n");
  REQUIRE(study.spectrum.size() == 2);
  CHECK(study.spectrum[0].torque == Approx(1e5).epsilon(1e-12));  // round-off
  CHECK(study.spectrum[0].cycles == 1000.0);
  CHECK(study.spectrum[1].torque == Approx(3e5).epsilon(1e-12));
  CHECK(study.spectrum[1].cycles == 2000.0);
  for (const SpectrumBin& bin : study.spectrum) {
    CHECK(bin.same_teeth);
    CHECK(std::isnan(bin.speed));
  }
  const Json life = results_document(run_study(study)).at("life");
  const Json& spectrum = life.at("spectra")[0];
  const auto damage = [&](const char* gear) { return spectrum.at(gear).at("contact").at("damage").get<double>(); };
  CHECK(damage("pinion") > 0.0);
  CHECK(damage("pinion") == damage("wheel"));  // the same stress, strength and number of cycles
  CHECK(life.at("signal").at("cycles") == 3000.0);
}

TEST_CASE("What is wrong with a study's signal is told by key or by line", "[studies][life]") {
  const SignalFolder of("time,torque\n0,10\n1,20\n");
  CHECK(of.problem(by_signal + ", hours = 1").key == "load.spectrum.signal");
  CHECK(of.problem(by_signal + ", hours = 1").allowed.find("load.speed") != std::string::npos);
  CHECK(of.problem(by_signal + ", hours = 1", "speed = 1000\n").key.empty());
  CHECK(of.problem(by_signal + ", counting = \"rainflow\"").key.empty());
  CHECK(of.problem(by_signal + ", hours = 1, repeats = 2", "speed = 1000\n").key == "load.spectrum.repeats");
  CHECK(of.problem(by_signal + ", bins = 0", "speed = 1000\n").key == "load.spectrum.bins");
  CHECK(of.problem(by_signal + ", counting = \"levels\"", "speed = 1000\n").key == "load.spectrum.counting");
  const auto torque_of = [&](const std::string& keys) { return of.problem(by_signal + keys, "speed = 1000\n").allowed; };
  CHECK(torque_of(", torque_factor = 0").find("torque is always 0 while the pinion turns, allowed is one that loads a flank") != std::string::npos);
  CHECK(torque_of(", torque_factor = 0, counting = \"rainflow\"").find("torque is without a swing, allowed is one that changes") !=
        std::string::npos);
  CHECK(of.problem(by_signal + ", counting = \"rainflow\", repeats = 1e12, torque_factor = 1e6").key.empty());
  const SignalFolder large("time,torque\n0,1e8\n1,2e8\n2,1e8\n");
  CHECK(large.problem(by_signal + ", counting = \"rainflow\", torque_factor = 1e6").allowed.find("counts to a torque of") != std::string::npos);
  CHECK(of.problem("signal = 3").key == "load.spectrum.signal");
  CHECK(of.problem("signal = \"no such.csv\"").allowed.find("cannot be read") != std::string::npos);
  CHECK(of.problem("bins = 4").key == "load.spectrum");
  CHECK(of.problem("signal = \"torque.csv\", file = \"torque.csv\"").key == "load.spectrum.signal");
  of.folder.file("bins.csv", "torque,cycles\n10,1e6\n");
  CHECK(of.problem("file = \"bins.csv\"").key.empty());
  CHECK(of.problem("file = \"bins.csv\", bins = 4").key == "load.spectrum.bins");
  of.folder.file("torque.csv", "time,torque\n0,10\n0,20\n");
  const StudyProblem late = of.problem(by_signal, "speed = 1000\n");
  CHECK(late.file == (of.folder.path() / "torque.csv").string());
  CHECK(late.line == 3);
}

TEST_CASE("Results tell what of a signal loads no tooth, and a stored study counts it again", "[studies][life]") {
  const SignalFolder of(triangle);
  const StudyResults results = run_study(of.study(by_signal + ", bins = 2, hours = 10"));
  const Json document = results_document(results);
  const Json& signal = document.at("life").at("signal");
  CHECK(signal.at("hours").get<double>() == Approx(10.0).epsilon(1e-12));
  CHECK(signal.at("reversed_hours").get<double>() == Approx(2.0).epsilon(1e-3));
  CHECK(signal.at("least_torque_Nm").get<double>() == Approx(-100.0).epsilon(1e-12));  // round-off
  CHECK(document.at("life").at("cases").size() == 2);
  CHECK(document.at("life").at("spectra").size() == 1);
  const auto& notes = results.notes;
  CHECK(std::ranges::any_of(notes, [](const std::string& note) { return note.find("loads the other flank") != std::string::npos; }));
  const Study stored = stored_study(document, "results.json", StoredFlanks::Final);
  REQUIRE(stored.spectrum.size() == results.study.spectrum.size());
  for (std::size_t k = 0; k < stored.spectrum.size(); ++k) {
    CHECK(stored.spectrum[k].torque == results.study.spectrum[k].torque);
    CHECK(stored.spectrum[k].cycles == results.study.spectrum[k].cycles);
  }
}

}  // namespace flankwright::studies

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "studies/base/json_format.hpp"
#include "tests/common/random.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"

namespace flankwright::studies {
namespace {

using Catch::Contains;
using command_line::Ending;
using command_line::run;
using command_line::ScratchFolder;
using command_line::text_of;
using json = Json;

/// Starts the sweep of sweep.toml and kills it after a while; true where it was not done by then.
bool run_and_kill(const ScratchFolder& folder, std::chrono::milliseconds after) {
  const std::string program = command_line::program();
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    if (::chdir(folder.path().c_str()) == 0) ::execl(program.c_str(), "flankwright", "run", "sweep.toml", "--out", "killed", nullptr);
    ::_exit(127);
  }
  REQUIRE(child > 0);
  std::this_thread::sleep_for(after);
  ::kill(child, SIGKILL);
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  return WIFSIGNALED(status);
}

TEST_CASE("A sweep killed at random moments ends with the results of an undisturbed one", "[studies][sweep][command-line]") {
  const ScratchFolder folder;
  folder.file("sweep.toml", small::sweep("samples = 3000"));
  tests::Random32 random(17);
  int kills = 0;
  for (int k = 0; k < 4; ++k) kills += run_and_kill(folder, std::chrono::milliseconds(20 + random.below(280)));
  CHECK(kills > 0);
  CHECK(run(folder, {"run", "sweep.toml", "--out", "killed"}).exit_code == 0);
  CHECK(run(folder, {"run", "sweep.toml", "--out", "whole"}).exit_code == 0);
  CHECK(text_of(folder.path() / "killed/samples.csv") == text_of(folder.path() / "whole/samples.csv"));
  json killed = json::parse(text_of(folder.path() / "killed/results.json"))["sweep"];
  json whole = json::parse(text_of(folder.path() / "whole/results.json"))["sweep"];
  killed.erase("seconds");
  whole.erase("seconds");
  CHECK(killed == whole);
}

TEST_CASE("A sweep leaves its statistics, its samples and its worst samples, ready to run", "[studies][sweep][command-line]") {
  const ScratchFolder folder;
  folder.file("sweep.toml", small::sweep("samples = 50"));
  const Ending ending = run(folder, {"run", "sweep.toml", "--out", "out"});
  CAPTURE(ending.err);
  REQUIRE(ending.exit_code == 0);
  CHECK_THAT(ending.out, Contains("peak contact stress [MPa]") && Contains("50 samples"));
  const json sweep = json::parse(text_of(folder.path() / "out/results.json"))["sweep"];
  CHECK(sweep["samples"] == 50);
  CHECK(sweep["failed"] == 0);
  const json& stress = sweep["statistics"]["peak_contact_stress_MPa"];
  CHECK(stress["mean"].get<double>() > stress["quantiles"]["1 %"].get<double>());
  CHECK(stress["max"] == stress["worst"]["value"]);
  const std::string worst = stress["worst"]["study"];
  REQUIRE(run(folder, {"run", "out/" + worst, "--out", "worst", "--set", "cycle.peaks=sampled"}).exit_code == 0);
  const json alone = json::parse(text_of(folder.path() / "worst/results.json"));
  CHECK(alone["loaded"][0]["summary"]["peak_contact_stress_MPa"] == stress["max"]);
  // 50 samples and the header.
  const std::string csv = text_of(folder.path() / "out/samples.csv");
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 51);

  const Ending other = run(folder, {"run", "sweep.toml", "--out", "out", "--set", "sweep.seed=2"});
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.err, Contains("sweep.seed is not given in the study of the store and 2 here"));
  // The same sweep with more samples goes on.
  REQUIRE(run(folder, {"run", "sweep.toml", "--out", "out", "--set", "sweep.samples=60"}).exit_code == 0);
  const std::string longer = text_of(folder.path() / "out/samples.csv");
  CHECK(longer.starts_with(csv));
}

}  // namespace
}  // namespace flankwright::studies

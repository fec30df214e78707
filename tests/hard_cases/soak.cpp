// Random scenes, one after the other, each examined as scene_check.hpp says:
//
//   flankwright_soak --scenes 1000000 --seed 1 [--first 0] [--threads 2] [--out soak-failures]
//
// A scene that fails is saved as a study file, which `flankwright run` then shows to fail alike; one that runs into a floating-point trap is saved
// and ends the soak. Scenes depend on seed and index alone, so that a soak goes on at --first where another one ended. Exit code 0 where none failed.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "tests/hard_cases/random_study.hpp"
#include "tests/hard_cases/scene_check.hpp"

using namespace flankwright::hard_cases;

namespace {

std::uint64_t seed = 1;
std::string folder = "soak-failures";
thread_local std::uint64_t examined = 0;  // index of this thread's scene

/// A trap is raised by the instruction itself, in the thread of its scene: nothing is half written that saving needs.
void save_trapped(int) {
  const std::string saved = save_scene(folder, random_study(seed, examined), seed, examined, "an invalid operation or a division by zero");
  std::printf("failed: %s: an invalid operation or a division by zero\n", saved.c_str());
  std::fflush(stdout);
  std::_Exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t scenes = 10'000, first = 0;
  int threads = 1;
  CLI::App app{"Examines random scenes; saves those that fail as study files.", "flankwright_soak"};
  app.add_option("--scenes", scenes, "how many");
  app.add_option("--seed", seed, "another seed, other scenes");
  app.add_option("--first", first, "index of the first");
  app.add_option("--threads", threads, "threads to use")->check(CLI::Range(1, 1024));
  app.add_option("--out", folder, "folder for the studies that fail");
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGFPE, save_trapped);

  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  const auto start = std::chrono::steady_clock::now();
  std::array<std::atomic<std::uint64_t>, 3> counts{};
  constexpr std::uint64_t block = 1'000;  // between two lines of progress
  for (std::uint64_t from = first; from < first + scenes; from += block) {
    const std::uint64_t to = std::min(from + block, first + scenes);
    tbb::parallel_for(from, to, [&](std::uint64_t index) {
      examined = index;
      const std::string study = random_study(seed, index);
      const SceneVerdict verdict = examine(study, "scene " + std::to_string(index));
      ++counts[verdict.kind];
      if (verdict.kind == SceneVerdict::Failed) {
        std::printf("failed: %s: %s\n", save_scene(folder, study, seed, index, verdict.why).c_str(), verdict.why.c_str());
      }
    });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("seed %llu up to index %llu: %llu passed, %llu refused, %llu failed, %.0f s\n", static_cast<unsigned long long>(seed),
                static_cast<unsigned long long>(to), static_cast<unsigned long long>(counts[SceneVerdict::Passed]),
                static_cast<unsigned long long>(counts[SceneVerdict::Refused]), static_cast<unsigned long long>(counts[SceneVerdict::Failed]),
                seconds);
    std::fflush(stdout);
  }
  return counts[SceneVerdict::Failed] == 0 ? 0 : 1;
}

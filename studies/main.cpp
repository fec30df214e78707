#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <iostream>

#include "core/base/error.hpp"
#include "studies/base/keep_freed_memory.hpp"
#include "studies/base/printable.hpp"
#include "studies/command_line/command_line.hpp"
#include "studies/command_line/standard_output.hpp"

using namespace flankwright;
using namespace flankwright::studies;

int main(int argc, char** argv) {
  keep_freed_memory();
  spdlog::set_default_logger(spdlog::stderr_color_mt("flankwright"));
  spdlog::set_pattern("%^%l%$: %v");
  try {
    const int exit_code = CommandLine().run(argc, argv);
    std::cout.flush();
    check_standard_output(std::cout.good());
    flush_standard_output();
    return exit_code;
  } catch (const InvalidInput& problem) {
    std::fprintf(stderr, "%s\n", printable(problem.what(), "\n").c_str());
    return bad_input;
  } catch (const std::exception& error) {
    spdlog::critical("internal error: {}", error.what());
    return internal_error;
  }
}

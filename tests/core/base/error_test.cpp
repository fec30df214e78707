#include "core/base/error.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace flankwright;

TEST_CASE("An InvalidInput names the field, the value found and what is allowed", "[core][base]") {
  const InvalidInput problem("pinion.teeth", "2", "an integer of at least 5");
  CHECK(problem.field() == "pinion.teeth");
  CHECK(problem.value() == "2");
  CHECK(problem.allowed() == "an integer of at least 5");
  const std::string message = problem.what();
  for (const std::string& part : {problem.field(), problem.value(), problem.allowed()}) {
    CHECK(message.find(part) != std::string::npos);
  }
}

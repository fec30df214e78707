// flankwright_compare_results A.json B.json
//
// Compares every number of two results of one study, as different compilers leave them, and prints the keys that differ most. Numbers agree
// where they differ by no more than 1e-10 of the largest under the same key, list positions left out. Left out: times, and the residuals
// and differences of a solution, which are round-off themselves. Exit code 1 where something else differs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::json;

constexpr double agreed = 1e-10;

struct Pair {
  double one, other;
};
using Numbers = std::map<std::string, std::vector<Pair>>;

bool ends_with_any(const std::string& key, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(), [&](const char* ending) { return key.ends_with(ending); });
}

bool is_left_out(const std::string& key) { return ends_with_any(key, {"seconds", "residual", "complementarity", "file", "version"}); }

/// Collects numbers of both, told apart by their keys; false where the shapes differ.
bool collect(const Json& one, const Json& other, const std::string& path, Numbers& numbers) {
  if (one.is_number() && other.is_number()) {
    numbers[path].push_back({one.get<double>(), other.get<double>()});
    return true;
  }
  if (one.is_object() && other.is_object()) {
    bool same = one.size() == other.size();
    for (const auto& [key, value] : one.items()) {
      if (is_left_out(key)) continue;
      same = same && other.contains(key) && collect(value, other[key], path + "." + key, numbers);
    }
    return same;
  }
  if (one.is_array() && other.is_array()) {
    bool same = one.size() == other.size();
    for (std::size_t i = 0; same && i < one.size(); ++i) same = collect(one[i], other[i], path, numbers);
    return same;
  }
  if (one.type() != other.type()) std::printf("%s: %s and %s\n", path.c_str(), one.dump().substr(0, 40).c_str(), other.dump().substr(0, 40).c_str());
  return one.type() == other.type();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: flankwright_compare_results A.json B.json\n");
    return 2;
  }
  Numbers numbers;
  const auto read = [](const char* file) {
    std::ifstream in(file);
    return Json::parse(in);
  };
  bool same = collect(read(argv[1]), read(argv[2]), "", numbers);
  if (!same) std::printf("the results have different shapes\n");
  double worst = 0.0;
  std::size_t count = 0;
  for (const auto& [path, pairs] : numbers) {
    double scale = 0.0, difference = 0.0;
    for (const Pair& pair : pairs) {
      scale = std::max({scale, std::abs(pair.one), std::abs(pair.other)});
      difference = std::max(difference, std::abs(pair.one - pair.other));
    }
    count += pairs.size();
    if (difference == 0.0) continue;
    worst = std::max(worst, difference / scale);
    if (difference <= agreed * scale) continue;
    std::printf("%s: differ by %.3g of %.3g\n", path.c_str() + 1, difference, scale);
    same = false;
  }
  std::printf("%zu numbers, worst relative difference %.2g\n", count, worst);
  return same ? 0 : 1;
}

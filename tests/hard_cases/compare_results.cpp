// flankwright_compare_results A.json B.json
//
// Compares every number of two results of one study, as different compilers leave them, and prints the keys that differ most. Numbers agree
// where they differ by no more than 1e-10 of the largest under the same key, list positions left out, or by the round-off of angles and
// lengths, 1e-12 rad and 1e-12 mm, in the unit that the key names. Left out: times, counts of iterations, texts, and what is a choice among
// equals: the place on a line of contact, and what is derived there. Exit code 1 where something else differs.
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

bool is_left_out(const std::string& key) {
  return ends_with_any(key, {"seconds", "iterations", "kkt_residual", "condition", "file", "version"});
}

/// Round-off in the unit of the key.
double floor_of(const std::string& path) {
  const std::string key = path.substr(path.rfind('.') + 1);
  if (key.find("arcsec_per_deg") != std::string::npos) return 1e-6;
  if (key.find("arcsec") != std::string::npos) return 2.1e-7;  // 1e-12 rad
  if (key.find("_um") != std::string::npos) return 1e-9;
  if (key.find("_mm") != std::string::npos) return 1e-7;       // of a place that a maximum has: its height is flat there
  return 0.0;
}

/// Collects numbers of both, told apart by their keys; false where the shapes differ.
bool collect(const Json& one, const Json& other, const std::string& path, Numbers& numbers) {
  if (one.is_number() && other.is_number()) {
    numbers[path].push_back({one.get<double>(), other.get<double>()});
    return true;
  }
  if (one.is_object() && other.is_object()) {
    const bool on_line = one.contains("contact") && one["contact"] == "line" && other.contains("contact") && other["contact"] == "line";
    bool same = one.size() == other.size();
    for (const auto& [key, value] : one.items()) {
      if (is_left_out(key) || (on_line && !key.starts_with("te_arcsec") && !key.starts_with("phi"))) continue;
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
    const double excess = difference - floor_of(path);
    if (excess <= 0.0) continue;
    worst = std::max(worst, excess / scale);
    if (excess <= agreed * scale) continue;
    std::printf("%s: differ by %.3g of %.3g\n", path.c_str() + 1, difference, scale);
    same = false;
  }
  std::printf("%zu numbers, worst relative difference %.2g\n", count, worst);
  return same ? 0 : 1;
}

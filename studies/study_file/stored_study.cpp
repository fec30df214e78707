#include "studies/study_file/stored_study.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "studies/base/results_folder.hpp"
#include "studies/base/json_format.hpp"
#include "studies/study_file/study_file.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array<std::string_view, 8> kept{"title", "pair.", "pinion.", "wheel.", "material.", "misalignment.", "load.", "scenes."};
constexpr std::array<std::string_view, 4> left_out{"pinion.shaft.", "wheel.shaft.", "pinion.error.", "wheel.error."};

bool starts_with_one_of(const std::string& key, const auto& beginnings) {
  return std::ranges::any_of(beginnings, [&](std::string_view beginning) { return key.starts_with(beginning); });
}

/// "scenes.1.load.torque" -> 1, "load.torque"
std::pair<int, std::string> scene_key(const std::string& key) {
  const std::size_t start = key.find('.') + 1, end = key.find('.', start);
  return {std::stoi(key.substr(start, end - start)), key.substr(end + 1)};
}

std::string study_text(const Json& given) {
  std::string text;
  std::map<int, std::string> scenes, bins;
  for (const Json& entry : given) {
    const std::string key = entry.at("key"), value = entry.at("value");
    if (!starts_with_one_of(key, kept) || starts_with_one_of(key, left_out)) continue;
    constexpr std::string_view spectrum = "load.spectrum.";
    const bool is_bin = key.starts_with(spectrum) && key.find_first_of("0123456789") == spectrum.size();
    if (is_bin) {  // "load.spectrum.1.torque"
      const auto [bin, name] = scene_key(key.substr(spectrum.find('.') + 1));
      bins[bin] += (bins[bin].empty() ? "" : ", ") + name + " = " + value;
    } else if (!key.starts_with("scenes.")) {
      text += key + " = " + value + "\n";
    } else if (const auto [scene, name] = scene_key(key); !name.starts_with("pinion.error") && !name.starts_with("wheel.error")) {
      scenes[scene] += name + " = " + value + "\n";
    }
  }
  if (!bins.empty()) text += "load.spectrum = [";
  for (const auto& [bin, keys] : bins) text += "{ " + keys + " }, ";
  if (!bins.empty()) text += "]\n";
  for (const auto& [scene, keys] : scenes) text += "[[scenes]]\n" + keys;
  return text;
}

}  // namespace

std::vector<Override> final_modifications(const Json& results) {
  std::vector<Override> values;
  if (!results.contains("optimise")) return values;
  const Json& after = results.at("optimise").at("after");
  for (const char* which : {"variables", "tied"}) {
    if (!after.contains(which)) continue;
    for (const auto& [key, value] : after.at(which).items()) values.push_back({key, value.dump()});
  }
  return values;
}

Study stored_study(const Json& results, const std::string& file, StoredFlanks flanks) {
  std::string text, name;
  std::vector<Override> modifications;
  try {
    text = study_text(results.at("given"));
    name = results.at("file");
    if (flanks == StoredFlanks::Final) modifications = final_modifications(results);
  } catch (const std::exception&) {
    throw InvalidInput(file, damaged_results, results_of_a_run);
  }
  return parse_study(text, name, modifications);
}

}  // namespace flankwright::studies

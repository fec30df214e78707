#include "studies/base/plain_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "core/fidelity/cycle_quantities.hpp"
#include "core/flank/modifications/modification.hpp"

namespace flankwright::studies {

namespace {

struct Row {
  std::string_view key, name, symbol{}, sense{};
};

/// Below "pinion." and "wheel.", beside the modifications.
constexpr std::array errors{
    Row{"error.helix_slope", "helix slope deviation", "f_Hβ", "+ adds metal at z = +b/2"},
    Row{"error.profile_slope", "profile slope deviation", "f_Hα", "+ adds metal at the tip"},
    Row{"error.pitch", "pitch deviation", "f_p"},
    Row{"error.twist", "twist deviation", "", "+ adds metal at the tip at z = +b/2"},
};

constexpr std::array of_pair{
    Row{"misalignment.mesh_misalignment", "mesh misalignment", "F_βy"},
    Row{"misalignment.crossing", "out-of-plane shaft deviation", "f_Σβ"},
    Row{"misalignment.intersecting", "in-plane shaft deviation", "f_Σδ"},
    Row{"misalignment.centre_distance", "centre distance deviation"},
    Row{"misalignment.axial_offset", "axial offset"},
    Row{"misalignment.pinion_lead_angle", "pinion lead angle deviation"},
    Row{"misalignment.pinion_pressure_angle", "pinion pressure angle deviation"},
    Row{"load.torque", "pinion torque"},
};

/// Outputs that are no entries of cycle_quantities().
constexpr std::array outputs{
    Row{"edge_load", "line load near the edges"},
    Row{"effective_contact_ratio", "effective contact ratio"},
    Row{"contact_damage", "contact damage"},
    Row{"root_damage", "root damage"},
    Row{"loss_factor", "gear loss factor", "H_VL"},
    Row{"specific_film_thickness", "specific film thickness", "λ_GF"},
    Row{"flash_temperature", "flash temperature", "θ_fl"},
    Row{"contact_temperature", "contact temperature", "θ_B"},
    Row{"contact_utilisation", "contact stress utilisation"},
    Row{"root_utilisation", "root stress utilisation"},
    Row{"micropitting_utilisation", "micropitting utilisation"},
    Row{"scuffing_utilisation", "scuffing utilisation"},
    Row{"peak_to_peak_arcsec", "unloaded peak-to-peak TE"},
    Row{"peak_to_peak_um", "unloaded peak-to-peak TE"},
    Row{"iso6336_K_Hbeta", "K_Hβ by ISO 6336"},
    Row{"iso6336_K_Halpha", "K_Hα by ISO 6336"},
};

/// Effects and settings whose key is no English yet.
constexpr std::array others{
    Row{"hertzian_contact", "Hertzian contact"},
    Row{"thin_slice", "thin slices"},
    Row{"fe", "finite elements"},
};

std::vector<PlainName> make_names() {
  std::vector<PlainName> names;
  const auto add = [&names](const std::string& key, const std::string& name, const Row& row) {
    names.push_back({key, name, std::string(row.symbol), std::string(row.sense)});
  };
  for (const std::string gear : {"pinion", "wheel"}) {
    for_each_modification_key([&](const auto& key) {
      const Row row = [&]() -> Row {
        if constexpr (requires { key.symbol; })
          return {key.key, key.name, key.symbol, key.sense};
        else
          return {key.key, key.name};
      }();
      add(gear + ".modification." + std::string(row.key), gear + " " + std::string(row.name), row);
    });
    for (const ProcessDescriptor& d : process_parameters) {
      add(gear + "." + std::string(d.key), gear + " " + std::string(d.name), {d.key, d.name, d.symbol, d.sense});
    }
    for (const Row& row : errors) add(gear + "." + std::string(row.key), gear + " " + std::string(row.name), row);
  }
  for (const Row& row : of_pair) add(std::string(row.key), std::string(row.name), row);
  for (const Row& row : outputs) add(std::string(row.key), std::string(row.name), row);
  for (const Row& row : others) add(std::string(row.key), std::string(row.name), row);
  for (const CycleEntry& entry : cycle_entries()) {
    names.push_back({entry.name(), entry.words(), "", ""});
    if (entry.key() != entry.name()) names.push_back({entry.key(), entry.words(), "", ""});
  }
  for (int order = 1; order <= highest_te_harmonic; ++order) {
    names.push_back({"te_harmonic_" + std::to_string(order) + "_arcsec", std::string(ordinal(order)) + " harmonic of unloaded TE", "", ""});
  }
  return names;
}

/// A word of a sum: its name, or itself where it is a number or a sign.
std::string word_in_words(const std::string& word) {
  static const std::map<std::string, std::string> by_key = [] {
    std::map<std::string, std::string> found;
    for (const PlainName& known : plain_names()) found.emplace(known.key, known.name);
    return found;
  }();
  const auto known = by_key.find(word);
  if (known != by_key.end()) return known->second;
  if (word.empty() || std::isalpha(static_cast<unsigned char>(word.front())) == 0) return word;
  std::string words = word;
  std::ranges::replace_if(
      words, [](char c) { return c == '.' || c == '_'; }, ' ');
  return words;
}

}  // namespace

const std::vector<PlainName>& plain_names() {
  static const std::vector<PlainName> names = make_names();
  return names;
}

std::string plain_name(std::string_view text) {
  std::string words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (at > 0) words += ' ';
    words += word_in_words(std::string(text.substr(at, end - at)));
    at = end + 1;
  }
  return words;
}

}  // namespace flankwright::studies

#include "studies/base/plain_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "core/fidelity/cycle_quantities.hpp"

namespace flankwright::studies {

namespace {

struct Row {
  std::string_view key, name, symbol{}, sense{};
};

/// Below "pinion." and "wheel.".
constexpr std::array of_gear{
    Row{"modification.lead_crowning", "lead crowning", "C_β"},
    Row{"modification.lead_slope", "lead slope", "C_Hβ", "+ removes at z = +b/2"},
    Row{"modification.profile_crowning", "profile crowning", "C_α"},
    Row{"modification.addendum_crowning", "addendum crowning"},
    Row{"modification.dedendum_crowning", "dedendum crowning"},
    Row{"modification.profile_slope", "profile slope", "C_Hα", "+ removes at the tip"},
    Row{"modification.tip_relief.amount", "tip relief", "C_αa"},
    Row{"modification.tip_relief.height", "tip relief height"},
    Row{"modification.tip_relief.shape", "tip relief shape"},
    Row{"modification.root_relief.amount", "root relief", "C_αf"},
    Row{"modification.root_relief.height", "root relief height"},
    Row{"modification.root_relief.shape", "root relief shape"},
    Row{"modification.end_relief.amount", "end relief", "C_βI, C_βII"},
    Row{"modification.end_relief.length", "end relief length", "L_CβI, L_CβII"},
    Row{"modification.twist", "twist", "S_α", "+ removes at the tip at z = +b/2"},
    Row{"modification.parabolic_te", "parabolic transmission error"},
    Row{"modification.topography.face_2", "topography, lead order 2", "", "Legendre polynomials; + removes at both face ends"},
    Row{"modification.topography.profile_2", "topography, profile order 2", "", "Legendre polynomials; + removes at tip and root"},
    Row{"modification.topography.face_3", "topography, lead order 3", "", "Legendre polynomials; + removes at z = +b/2"},
    Row{"modification.topography.profile_3", "topography, profile order 3", "", "Legendre polynomials; + removes at the tip"},
    Row{"modification.topography.profile_1_face_2", "topography, profile order 1 by lead order 2", "", "Legendre polynomials; + removes at the tip at both face ends"},
    Row{"modification.topography.profile_2_face_1", "topography, profile order 2 by lead order 1", "", "Legendre polynomials; + removes at tip and root at z = +b/2"},
    Row{"modification.topography.face_4", "topography, lead order 4", "", "Legendre polynomials; + removes at both face ends"},
    Row{"modification.topography.profile_4", "topography, profile order 4", "", "Legendre polynomials; + removes at tip and root"},
    Row{"modification.topography.profile_1_face_3", "topography, profile order 1 by lead order 3", "", "Legendre polynomials; + removes at the tip at z = +b/2"},
    Row{"modification.topography.profile_3_face_1", "topography, profile order 3 by lead order 1", "", "Legendre polynomials; + removes at the tip at z = +b/2"},
    Row{"modification.topography.profile_2_face_2", "topography, profile order 2 by lead order 2", "", "Legendre polynomials; + removes at the four corners"},
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

constexpr std::array<std::string_view, 10> ordinals{"first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"};

std::vector<PlainName> make_names() {
  std::vector<PlainName> names;
  const auto add = [&names](const std::string& key, const std::string& name, const Row& row) {
    names.push_back({key, name, std::string(row.symbol), std::string(row.sense)});
  };
  for (const std::string gear : {"pinion", "wheel"}) {
    for (const Row& row : of_gear) add(gear + "." + std::string(row.key), gear + " " + std::string(row.name), row);
  }
  for (const Row& row : of_pair) add(std::string(row.key), std::string(row.name), row);
  for (const Row& row : outputs) add(std::string(row.key), std::string(row.name), row);
  for (const Row& row : others) add(std::string(row.key), std::string(row.name), row);
  for (const CycleEntry& entry : cycle_entries()) {
    names.push_back({entry.name(), entry.words(), "", ""});
    if (entry.key() != entry.name()) names.push_back({entry.key(), entry.words(), "", ""});
  }
  for (std::size_t i = 0; i < ordinals.size(); ++i) {
    const std::string name = std::string(ordinals[i]) + " harmonic of ", key = "te_harmonic_" + std::to_string(i + 1);
    names.push_back({key + "_arcsec", name + "unloaded TE", "", ""});
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
  std::ranges::replace_if(words, [](char c) { return c == '.' || c == '_'; }, ' ');
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

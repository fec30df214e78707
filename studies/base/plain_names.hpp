#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The plain name of a key of the study file or of an output: tables, sentences and the report take their words from here, while
/// results.json and CSV files keep the keys.
namespace flankwright::studies {

struct PlainName {
  std::string key;     ///< "pinion.modification.tip_relief.amount", "te_harmonic_1"
  std::string name;    ///< "pinion tip relief", "first harmonic of TE"
  std::string symbol;  ///< of ISO 21771, ISO 1328 or ISO 6336, "C_αa"; empty where they have none
  std::string sense;   ///< effect of a positive value, where its sign can be mistaken; else empty
};

/// All keys that have one: modifications and manufacturing errors of both gears, misalignment, load, outputs, those of sweeps too, and what
/// settings and effects a report names.
const std::vector<PlainName>& plain_names();

/// The words of a key. In a sum such as "2 * pinion.modification.lead_crowning - te_mean" every key becomes its words; a key without
/// a name of its own is written without dots and underscores, and numbers and signs stay.
std::string plain_name(std::string_view text);

/// What follows a number: a space and its unit; nothing where the unit is that of a plain number, "1".
inline std::string behind_number(std::string_view unit) { return unit.empty() || unit == "1" ? std::string() : " " + std::string(unit); }

}  // namespace flankwright::studies

#pragma once

#include <filesystem>
#include <string>

#include "studies/base/results_folder.hpp"
#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study/study_errors.hpp"

/// REXS files of one pair, as text, and what becomes of them.
namespace flankwright::studies::small_rexs {

inline std::string sample_file(const std::string& name) {
  return read_whole(std::filesystem::path(FLANKWRIGHT_SOURCE_DIR) / "tests/studies/exchange/rexs/data" / name);
}

inline rexs::ImportedStudy import_text(const std::string& text, const rexs::RexsImportOptions& options = {.grid_stem = "s"}) {
  return rexs::import_stage(text, "gears.rexs", options);
}

inline std::string refusal(const std::string& text, const rexs::RexsImportOptions& options = {}) {
  try {
    import_text(text, options);
  } catch (const StudyErrors& errors) {
    return errors.what();
  }
  return "";
}

inline std::string attribute(const std::string& id, const std::string& value, const std::string& unit = "mm") {
  return "<attribute id=\"" + id + "\" unit=\"" + unit + "\">" + value + "</attribute>\n";
}

/// A spur pair in XML whose tips are sharp; `more` stands among the components, at the pinion's right flank (id 6) where `at_flank` refers to it.
inline std::string small_file(const std::string& more = "", const std::string& relations = "") {
  const auto gear = [](const std::string& id, const std::string& teeth) {
    return "<component id=\"" + id + "\" type=\"cylindrical_gear\">\n" + attribute("number_of_teeth", teeth, "none") +
           attribute("normal_module", "4") + attribute("tip_form_diameter", std::to_string(4 * (std::stoi(teeth) + 2))) +
           attribute("face_width", "40") + attribute("helix_angle_reference_diameter", "0", "deg") + "</component>\n";
  };
  return "<model version=\"1.6\">\n<relations>\n<relation id=\"1\" type=\"stage\">"
         "<ref id=\"1\" role=\"stage\"/><ref id=\"2\" role=\"gear_1\"/><ref id=\"3\" role=\"gear_2\"/></relation>\n"
         "<relation id=\"2\" type=\"flank\"><ref id=\"2\" role=\"gear\"/><ref id=\"5\" role=\"left\"/><ref id=\"6\" role=\"right\"/></relation>\n" +
         relations + "</relations>\n<components>\n<component id=\"1\" type=\"cylindrical_stage\"/>\n" + gear("2", "20") + gear("3", "40") +
         "<component id=\"5\" type=\"cylindrical_gear_flank\"/>\n<component id=\"6\" type=\"cylindrical_gear_flank\"/>\n" + more +
         "</components>\n</model>\n";
}

}  // namespace flankwright::studies::small_rexs

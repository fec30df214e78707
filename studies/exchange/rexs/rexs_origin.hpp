#pragma once

#include <string>

#include "studies/exchange/rexs/rexs_model.hpp"

namespace flankwright::studies::rexs {

/// Where in a file a value of the study came from.
struct Origin {
  std::string words;                    ///< the remark behind the value, components with their names: material 47 "Steel" elastic_modulus
  const Component* component{nullptr};  ///< that it names first; null: none
  int line{0};                          ///< of that component's attribute, or of the component where no attribute is named; 0: the file has no lines
};

/// @param remark  as the study has it: "cylindrical_gear 6 face_width", "shaft_section 12, shaft_section 13", "not in the file"
Origin origin_of(const Model& model, const std::string& remark);

}  // namespace flankwright::studies::rexs

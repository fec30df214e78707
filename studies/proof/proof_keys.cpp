#include "studies/key_rows.hpp"

namespace flankwright::studies {

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> proof_rows() {
  using enum ValueKind;
  return {
      {.path = "optimise.comparison.rules", .kind = Word, .words = {"on", "off"}, .fallback = "\"on\"",
       .meaning = "on: the optimum is held against rules of thumb over the same scenes",
       .store = [](Draft& d, Member, const Value& v) { d.study.optimise.proof.rules = v.text == "on"; }},
      {.path = "optimise.comparison.variants", .range = from_zero(1000.0), .fallback = "0",
       .meaning = "analyses of a full-factorial search of the variables for each analysis of the optimiser; 0: none",
       .store = [](Draft& d, Member, const Value& v) { d.study.optimise.proof.variants = v.number; }},
  };
}

// clang-format on

}  // namespace flankwright::studies

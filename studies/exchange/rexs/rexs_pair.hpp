#pragma once

#include "studies/exchange/rexs/rexs_mesh.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

/// Macro-geometry of a stage.
struct ImportedPair {
  PairData data;
  Remarks remarks;
};

/// Reads what PairData wants. Absent or impossible values that have a sensible substitute are replaced, and it is said so.
/// @throws StudyErrors with one problem, component, id and attribute, where something without substitute is missing or two components
/// contradict each other
ImportedPair read_pair(Reading& reading, const StageParts& parts);

/// [pair], [pinion] and [wheel] of a study.
void write_pair(const ImportedPair& pair, StudyText& text);

}  // namespace flankwright::studies::rexs

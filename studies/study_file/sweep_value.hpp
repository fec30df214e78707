#pragma once

#include <string>

#include "core/contact/assembly/flank_condition.hpp"
#include "studies/study/study.hpp"
#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

/// True for the height or length of a relief.
bool is_extent(const SchemaKey& key);

/// True for keys that a sweep may vary: the numbers of a working condition (misalignment, torque, errors), of a modification and of the grinding's twist compensation. All
/// else changes the gears or how they are analysed.
bool is_sweepable(const SchemaKey& key);

/// True where the value is allowed for a key; both in the unit of a bare number. A relief's height and length must be above 0.
bool is_in_range(const SchemaKey& key, double value);

/// What a study says of a swept key, and where the sample puts its own value.
struct SweptCondition {
  Scene scene;
  PerGear<Modification> modification;  ///< the study's, of the pair's own flanks
  bool other_flanks{false};            ///< as FlankCondition has it

  /// Of the study itself, the nominal sample.
  static SweptCondition of(const Study& study) { return {study.scenes.front(), study.modification, loads_other_flanks(study, study.scenes.front())}; }
  FlankCondition flanks() const {
    FlankCondition condition{{}, scene.error, scene.misalignment, other_flanks};
    condition.set_design(modification);
    return condition;
  }
};

/// Puts a value, in the unit of a bare number, in the place of a sweepable key's.
/// @throws InvalidInput where it is out of the key's range
void set_swept(SweptCondition& condition, const SchemaKey& key, double value);

/// The pitch deviations that a value stands for, drawn_pitch(), as a study file writes them [um]; and put in the place of a gear's.
std::vector<double> pitch_of_draw(const PitchTolerance& tolerance, double value);
void set_drawn_pitch(ManufacturingError& error, const PitchTolerance& tolerance, double value);

}  // namespace flankwright::studies

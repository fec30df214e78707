#pragma once

#include <memory>

#include "studies/study_file/study_reading.hpp"

/// The load spectrum, material strength and lubricant of a study.
namespace flankwright::studies {

/// Reads a spectrum's file, checks the bins and gives their torques to the base working condition; before scenes are read.
void read_spectrum(StudyReading& reading);

/// Checks S-N curves, lubricant and what scenes say beside a spectrum.
void check_life(StudyReading& reading);

/// What outputs of life need; null where the study says nothing about it.
std::shared_ptr<const LifeModel> life_model(const Study& study);

/// Whether the study gives a strength of a flank or a root.
bool has_strength(const Study& study);

/// Whether an analysis computes life, loss or film: the study has a spectrum, a strength, a lubricant or a speed.
bool asks_for_life(const Study& study);

}  // namespace flankwright::studies

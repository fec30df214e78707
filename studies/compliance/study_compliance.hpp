#pragma once

#include "core/compliance/model/gear_structures.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Whether an optimisation minimises or bounds root stress: a search that does not goes without it.
bool asks_for_root_stress(const Study& study);

/// Whether the study's finite elements include root stress: where its compliance is "fitted" or "fe", or an objective, constraint
/// or expectation names it, and the study's own list of effects, if it has one, does not leave it out.
bool wants_root_stress(const Study& study);

/// Whether the study needs its gears on rigid bodies as well: to leave the effect `gear_body_compliance` out, by its list of
/// effects, at a fidelity level or for an accuracy, or for that effect's exact size. An estimate of the size is not worth its
/// own runs.
bool wants_rigid_bodies(const Study& study);

/// Whether the study solves finite elements of its gears at all: for its task, or, where there is a torque, its compliance
/// or root stress.
bool solves_finite_elements(const Study& study);

/// Inputs of the compliance and the root stress of a study. The task `fit` takes each gear by itself, without its shaft, and all of
/// its values from finite elements.
ComplianceTask compliance_task(const Study& study, const GearPair& pair);

/// The structure that a study's compliance model asks for, and its root stress, with runs and fits kept between runs of the program. Says
/// what a gear outside the library costs before the wait for it.
/// @throws InvalidInput  as build_compliance()
GearStructures gear_structures(const Study& study, const GearPair& pair, const ProgressReport& progress);

}  // namespace flankwright::studies

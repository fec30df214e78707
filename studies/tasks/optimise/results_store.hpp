#pragma once

#include <filesystem>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Writes an optimisation's results.sqlite, for whoever compares many runs with SQL; results.md describes its tables.
///
/// Units are those of the report (um, mm, MPa, N/mm, N·m, s) and stand beside each value; a number that was not
/// computed is NULL. The file appears whole or not at all: one transaction into a temporary file in the same folder,
/// which is then renamed.
/// @param results  of an optimisation
/// @throws InvalidInput ("output folder") with SQLite's or the system's reason where it cannot be written
void write_results_store(const std::filesystem::path& file, const StudyResults& results);

}  // namespace flankwright::studies

#pragma once

#include <string>
#include <string_view>

#include "core/rating/load_signal.hpp"

/// A torque over time as a table of its samples, see column_table.hpp:
///
///     time_s, torque_Nm, speed_rpm
///     0.00, 310, 1480
///     0.01, 322, 1479
///
/// time and torque are required. Without a unit they are in s, N·m and rpm.
namespace flankwright::studies {

inline constexpr std::size_t most_samples = 2'000'000;

/// @param name  stands for the file in messages
/// @return      torque as written; speed is empty where the table has none
/// @throws StudyErrors with file, line and column of the first problem: what is no number or too large, a time that is not above the one before, less than two
///         samples or more than most_samples
LoadSignal parse_signal(std::string_view text, const std::string& name);

/// @throws StudyErrors likewise, or where the file cannot be read or has more than 100 bytes for each of most_samples
LoadSignal read_signal_file(const std::string& path);

}  // namespace flankwright::studies

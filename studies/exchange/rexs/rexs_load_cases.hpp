#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "studies/exchange/rexs/rexs_load.hpp"
#include "studies/exchange/rexs/rexs_operation.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

/// The conditions of a file for one stage: its torques with speed, time and oil temperature.
class LoadCases {
 public:
  /// Reads what the conditions say beside their torques, of all of them, so that a bad value is found wherever it is.
  /// @param torques  see read_torques()
  /// @param hours    life of the unit, where it is given beside the file [h]; else its operating_time counts
  /// @throws StudyErrors as read_operation() and total_hours()
  LoadCases(Reading& reading, const StageParts& parts, std::vector<ImportedTorque> torques, std::optional<double> hours);

  const std::vector<ImportedTorque>& torques() const { return torques_; }
  const ImportedTorque& reference() const { return reference_of(torques_); }
  /// Of the oil in the reference condition.
  const std::optional<Taken>& temperature() const;

  /// [load], and [[scenes]] where there are several conditions with a torque.
  ///
  /// A load spectrum where all of them have a speed and a time in hours and load one flank. Else scenes, each with its speed, and its share of time as
  /// weight where all have one. Conditions that do not occur, have no torque or load flanks that the study does not describe are left out and named.
  /// @param one_sided     what the study describes for the working flanks alone, so that no scene may load the others; empty: nothing
  /// @param misalignment  what the loads from outside add by load case, see ImportedUnit::misalignment
  void write(const std::string& one_sided, const std::map<const LoadCase*, double>& misalignment, StudyText& text);

 private:
  struct Case {
    const ImportedTorque* torque;
    const OperatingCondition* operation;
    double hours{not_given};   ///< [h]
    double weight{not_given};  ///< share of the time, or hours where only these are known
    double misalignment{0.0};  ///< F_beta_y that its loads from outside add to those of the reference, scaled with the torque [mm]
  };

  void check_shares();
  std::vector<Case> loaded(const std::string& one_sided);
  /// Hours and weights, where all cases have them; cases without time are left out.
  void settle_times(std::vector<Case>& cases);
  bool are_spectrum(const std::vector<Case>& cases) const;
  void write_spectrum(const std::vector<Case>& cases, StudyText& text) const;
  void write_scenes(const std::vector<Case>& cases, StudyText& text);

  Reading& reading_;
  std::vector<ImportedTorque> torques_;
  std::vector<OperatingCondition> operations_;  ///< of the torques, one each
  std::optional<Taken> total_;                  ///< life [h]
};

}  // namespace flankwright::studies::rexs

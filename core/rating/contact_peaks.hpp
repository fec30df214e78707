#pragma once

#include <functional>
#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// The rule by which part of a contact line counts as a spike at its end.
///
/// Where a helical line is cut off by a tip edge (at A or E), the tooth beyond it carries nothing and supports the end:
/// line load and stress rise there, and most where the whole line has shrunk to a point at a face corner. Haddad 1991,
/// ch. 4, leaves these out by choosing intermediate phases by eye. Here, so that the answer depends on no choice of
/// phases: a point counts `without spikes` where
///
///     its line is, between A and E, at least line_share of the longest line that the pair has, and
///     it lies between A and E, at least end_distance along the axis from where its line crosses either.
///
/// Ends of lines on the faces are no spikes. On spur gears, whose lines are parallel to the tip edges, the rule leaves out
/// only what lies before A and after E.
///
/// Where contact reaches a rounded tip edge its pressure is that of the edge and several times that of the flanks. Such a point counts neither with nor without
/// spikes, but only `everywhere`: a load distribution compares flanks.
struct SpikeRule {
  double line_share{0.5};    ///< [-], 0 .. 1
  double end_distance{1.0};  ///< [m_n], >= 0; in the thesis the distance of two points on a line (section 3.4: 1.1 m_n)
};

/// The largest value of something over contact lines, and where.
struct LinePeak {
  double value{not_given};
  double phase{not_given};  ///< of the mesh position [base pitches], 0 .. 1
  int tooth{0};             ///< tooth pair
  double z{not_given};      ///< [mm]
};

/// Peaks over the points whose contact reaches no rounded tip edge, over those of them that are no spikes, and over all points where these were asked for.
struct ContactPeaks {
  struct Pair {
    LinePeak contact_stress;  ///< sigma_H [MPa]
    LinePeak line_load;       ///< [N/mm]
  };
  Pair with_spikes, without_spikes;   ///< value NaN without a point
  Pair everywhere;                    ///< edges included; NaN where they were not sought
  int positions{0};                   ///< mesh positions solved
  int failures{0};                    ///< of these without a usable load distribution: the peaks are then those of the others
  double phase_tolerance{not_given};  ///< used [base pitches]
  SpikeRule spikes{};                 ///< used
};

/// At one mesh position. A point has what is highest on its part of the line, crests and ends between points included, see
/// LoadedPosition::peak_load. Where the rule's cut falls between two points, the cut counts too: w and sigma_H^2 of the points are taken as linear
/// in between, so that the peak is a continuous function of the phase.
/// All of them, `everywhere` included.
ContactPeaks peaks_at(const MeshModel& model, const MeshPosition& at, const LoadedPosition& loaded, const SpikeRule& rule = {});

/// The same mesh at any phases [base pitches].
using MeshAt = std::function<MeshModel(const std::vector<double>& phases)>;

struct PeakSearch {
  SpikeRule spikes{};
  bool everywhere{false};  ///< peaks of tip edges are sought as well
  /// First positions are at most this far apart, in addition to all at which a line begins or ends at A0, A, E or B0 or passes the
  /// length of the spike rule [base pitches], > 0.
  double step{1.0 / 32};
  /// A maximum is enclosed until neighbouring positions are at most this far apart [base pitches], > 0,
  double phase_tolerance{2e-4};
  /// or the peak falls so little to them that it rises by no more than this share of it [-], >= 0.
  double value_tolerance{1e-5};
  /// Maxima of the first positions are enclosed where they reach this share of the highest one [-], 0 .. 1: one that
  /// lies lower would have to rise by the rest within one step. One that can no longer be the highest is given up.
  double worth{0.95};
};

/// Peaks over one whole mesh cycle, located in continuous phase by golden section and so not a matter of the phase step. Lines begin
/// and end at exact phases, which are looked at for themselves: there the peaks have kinks or jumps.
/// @param pinion_torque  [N mm], > 0
/// @throws InvalidInput where a search parameter is out of range
ContactPeaks locate_peaks(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque, const PeakSearch& search = {});

/// All phases at which some line of the pair begins or ends at A0, A, E or B0 at either face end, or at which its
/// length between A and E is line_share of the longest. They are not reduced by whole pitches, and their order is the
/// same for every mesh of a pair.
std::vector<double> unsorted_line_events(const MeshModel& model, double line_share);

/// Phases within [0, 1) at which some line of the pair begins or ends at A0, A, E or B0 at either face end, and at which its
/// length between A and E is line_share of the longest; rising, without repetition.
std::vector<double> line_events(const MeshModel& model, double line_share);

}  // namespace flankwright

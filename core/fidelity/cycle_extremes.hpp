#pragma once

#include <functional>
#include <vector>

#include "core/rating/contact_peaks.hpp"
#include "core/load/cycle/cycle_figures.hpp"
#include "core/load/cycle/loaded_point.hpp"

namespace flankwright {

/// A reading of a contact point under load, whose largest value over the cycle is sought beside the cycle's own figures, such as a flash temperature; >= 0, NaN counts as 0.
using PointReading = std::function<double(const LoadedPoint&)>;

struct ExtremeSearch {
  /// Located where no interval between positions looks as if the extreme rose by more than this [-], > 0: of the peak to peak (at least
  /// quiet_share of the mean deflection) for the transmission error, of the peak for stress, line load and further readings, of the peak contact stress for the stress on tip edges.
  /// Their share of the load is read where these are sought.
  double tolerance{2e-3};
  int most{32};                 ///< positions looked at before the search gives up, >= 1
  std::vector<double> first{};  ///< positions looked at before all others [base pitches], 0 .. 1, see tip_edge_passages()
  std::vector<PointReading> further{};
};

/// A cycle's extremes between its positions: each of these positions has the largest or smallest transmission error,
/// the largest contact stress, the largest line load, the largest stress on tip edges, their largest share of the load or the largest of a further reading of all that were solved, or
/// its tip edge is nearest to touching, by less than 1 % of the mean deflection.
struct CycleExtremes {
  std::vector<double> phases;      ///< [base pitches], rising; empty where the cycle's own positions have all extremes
  PerFigure unseen{};              ///< by how much extremes may still be larger, in the figures' units; 0 for what is no extreme
  double unseen_edge_stress{0.0};  ///< likewise of the stress on tip edges [MPa]
  double unseen_edge_share{0.0};   ///< likewise of their share of the load [-]
  PerGear<double> edge_approach{not_given,
                                not_given};  ///< to which the edges of either gear may come, see EdgeApproach [mm]; -infinity: no point has one
  std::vector<double> unseen_further;        ///< likewise of the further readings, in their units
  int looked_at{0};                          ///< positions solved
};

/// Phases before A and after E at which a tip edge may carry load between two positions of a cycle. On spur gears a whole line passes the edge at once, and the edge
/// carries for less than the spacing of the positions, a little outside A and E. On crowned or misaligned gears of small helix angle only the loaded part of the face
/// counts. For each of the two sides that point of the face is taken whose flank has the largest load within a spacing of the edge.
/// Four phases follow its passage, a third of the spacing apart. There are none where a line takes four spacings or more to pass, because several positions then
/// know how far the edge is from its mate, where three positions or more know the edge loaded, where no edge has a contact law, and where the flank next to the
/// edge carries no load.
/// @param cycle  of the model, at equally spaced phases
std::vector<double> tip_edge_passages(const MeshModel& model, const LoadedCycle& cycle);

/// Seeks the extremes of a cycle in continuous phase. What is read at points is followed for each tooth pair by itself, because the pair that has most hides another one
/// that is about to have more. Curves consist of smooth pieces with kinks where lines begin and end. In every interval both sides are continued straight until they meet (as unseen_rise() does), by the last secant
/// or by the slope extrapolated from the last two secants, whichever is steeper: curves grow steeper towards a kink. On
/// a smooth top, such as that of a load that passes a corner of the face, a parabola through three neighbours is taken. Beside a position that is
/// alone on its piece the curve may go on rising, see rise_between(). Stress on a tip edge begins steeply, perhaps between two positions without any. There the
/// gap that is left between the edge and its mate is continued in the same way, and looked at where it seems to close to less than the tolerance of the mean deflection.
/// The most promising phase is solved next. On a kink both meet near the extreme itself, so that two or three positions
/// a curve are enough.
/// @param model    of the cycle
/// @param mesh_at  likewise; no root stress is needed
/// @param cycle    at equally spaced phases over one base pitch, at least 4, usable
CycleExtremes locate_extremes(const MeshModel& model, const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque,
                              const LoadedCycle& cycle, const ExtremeSearch& search = {});

}  // namespace flankwright

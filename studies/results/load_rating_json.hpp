#pragma once

#include <map>

#include "core/rating/line_ends.hpp"
#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// "peaks" of a load case: with and without spikes, where, and by which rule.
Json peaks_json(const LoadRating& rating, const MeshModel& model);

/// "load_factors": K_Hbeta, K_Halpha, K_H and the product of the first two, by contact stress without and with spikes, and by line loads without spikes.
Json load_factors_json(const LoadRating& rating);

/// "iso6336": stiffness and load distribution factors by the standard, and what they were calculated from.
Json iso_json(const IsoStiffness& stiffness, const IsoLoadFactors& factors);

/// "te_convergence": what the last doubling of positions has changed; null where their number is odd.
Json te_convergence_json(const LoadedCycle& cycle);

/// "line_ends" of each tooth of a position.
std::map<int, Json> line_ends_json(const std::vector<LineEnd>& ends);

/// Share of the force by tooth.
std::map<int, double> shares_by_tooth(const MeshPosition& at, const LoadedPosition& position);

}  // namespace flankwright::studies

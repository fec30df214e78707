#pragma once

#include <optional>
#include <vector>

#include "optimize/design/two_level.hpp"
#include "optimize/assessment/optimum.hpp"
#include "optimize/assessment/relaxation.hpp"
#include "optimize/assessment/rules_of_thumb.hpp"
#include "optimize/assessment/sensitivity.hpp"
#include "optimize/assessment/usual_signs.hpp"
#include "optimize/assessment/validation.hpp"
#include "optimize/assessment/variant_search.hpp"
#include "core/compliance/model/gear_structures.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Designs over fresh draws from the study's tolerances.
struct Validation {
  unsigned long seed{0};
  std::string load_cases;                ///< that the value of a draw is made of, see load_cases_in_words()
  std::vector<std::string> draws;        ///< names
  std::vector<ValidatedDesign> designs;  ///< "before", "after", then the best rule of thumb where there is one
  double seconds{not_given};
};

/// Which design the active conditions and the sensitivities are of.
enum class AssessedDesign { Shown, BeforeRounding, BeforeChoices, WithoutScatter };

/// Assessment of an optimum: comparison with other designs, validation on fresh draws, and its active conditions.
struct Assessment {
  std::optional<RuleBasis> basis;          ///< of the rules, where they were asked for
  std::vector<ComparedDesign> rules;       ///< empty: not asked for
  std::vector<std::string> out_of_reach;   ///< what the best of them has that the variables do not reach, see out_of_reach()
  std::vector<VariantSearch> variants;     ///< one a placement of the levels; empty: not asked for
  std::optional<Validation> validation;    ///< of the design that is shown; none: not asked for
  AssessedDesign is_of{};                  ///< what the optimum and its usual signs are of
  std::optional<Optimum> optimum;          ///< of the design before rounding and scatter; none where it cannot be analysed
  std::vector<Sensitivity> sensitivities;  ///< of that optimum
  std::optional<DesignTask>
      judged;  ///< the problem of the optimum under the limits asked for: the task, or for a list of objectives the last one under limits on those before it
  std::optional<UsualSigns> usual;       ///< where the optimum asks for what is seldom ground; none where it does not
  std::optional<Relaxation> relaxation;  ///< where no design keeps the constraints; then there is no optimum
  double seconds{not_given};
};

/// @param problem  that was optimised; its limits may be tighter than those asked for, by what extremes between the positions exceed those at them
/// @param found    by the search
/// @param asked    the task with the limits asked for, by which other designs are judged and which sentences name
Assessment assess_optimum(const Study& study, const DesignProblem& problem, const DesignTask& asked, const TwoLevelDesign& found,
                          const ProgressReport& progress);

/// The designs before and after, and the best rule of thumb where there is one, over draws.
/// @param drawn  load cases of the draws
Validation validate(const Study& study, const DesignTask& task, const DesignResult& design, const std::vector<DesignScene>& drawn,
                    const ComparedDesign* best_rule);

/// "the optimum before rounding to the steps"; empty for the design that is shown.
std::string assessed_design_in_words(AssessedDesign design);

/// What an optimum has that is seldom ground, and the best design without it with its price.
std::string usual_signs_in_words(const UsualSigns& usual, const DesignTask& judged);

/// What keeps a task from having a feasible design and what would help most, a sentence each: the least excess, the limits that are exceeded with
/// their scenes, and the six moves of the largest gain.
std::vector<std::string> relaxation_in_words(const Relaxation& relaxation, const DesignTask& task);

/// Of rules of which none is feasible: how many, and which exceeds the constraints by least.
std::string no_rule_in_words(const std::vector<ComparedDesign>& rules);

/// "Over 500 draws that the search has not seen (seed 1) the design is better in 98.2 %, ..."
std::string validation_in_words(const Validation& validation, const DesignTask& task);

/// The active conditions at the optimum, a sentence each: scenes with their weights where a design decides on them, variables at a bound, constraints and earlier
/// objectives at their limit with the gain of a step beyond; a gain below the optimum's resolution is treated as zero.
/// @param judged  Assessment::judged
/// A last sentence says where at least half of the variables, and two or more, lie at a bound.
std::vector<std::string> optimum_in_words(const Optimum& optimum, const DesignTask& judged);

}  // namespace flankwright::studies

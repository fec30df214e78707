#pragma once

#include "studies/base/json_format.hpp"
#include "studies/tasks/optimise/proof.hpp"

namespace flankwright::studies {

/// Adds `comparison`, `validation`, `governing` and `sensitivity` to the `optimise` part of the results.
void add_proof(const Proof& proof, const DesignTask& task, const ProofTable& asked, Json& optimise);

}  // namespace flankwright::studies

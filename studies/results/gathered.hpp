#pragma once

#include <string>

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// What results.json has under a dotted name, as [expect] names it. A number in it picks an entry of a list, from 0; a list that it passes
/// through without one gives a list with what each of its entries has there, null where an entry has nothing.
///
/// @param results  results_document()
/// @throws InvalidInput "quantity" where no entry has anything there; it says which name was probably meant
Json gathered(const Json& results, const std::string& name);

}  // namespace flankwright::studies

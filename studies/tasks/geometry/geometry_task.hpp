#pragma once

#include "studies/study/task.hpp"

namespace flankwright::studies {

/// Sizes of both gears and of their mesh; no contact is analysed.
extern const Task geometry_task;

}  // namespace flankwright::studies

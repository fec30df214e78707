#pragma once

#include "studies/study/task.hpp"

namespace flankwright::studies {

extern const Task optimise_task;

}  // namespace flankwright::studies

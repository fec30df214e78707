#pragma once

#include "studies/study/task.hpp"

namespace flankwright::studies {

extern const Task sweep_task;

}  // namespace flankwright::studies

#pragma once

#include "studies/study/task.hpp"

namespace flankwright::studies {

extern const Task accuracy_task;

}  // namespace flankwright::studies

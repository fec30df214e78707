#pragma once

#include "studies/study/task.hpp"

namespace flankwright::studies {

extern const Task fit_task;

}  // namespace flankwright::studies

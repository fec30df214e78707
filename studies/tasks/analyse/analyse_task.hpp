#pragma once

#include "studies/study/task.hpp"

namespace flankwright::studies {

extern const Task analyse_task;

}  // namespace flankwright::studies

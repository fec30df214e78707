#include "studies/tasks/study_template.hpp"

#include "core/base/error.hpp"
#include "studies/study/task.hpp"
#include "studies/tasks/sweep/slurm_script.hpp"

namespace flankwright::studies {

std::string study_template(const std::string& kind) {
  if (kind == "slurm") return slurm_script();
  std::string allowed;
  for (const Task* task : registered_tasks()) {
    if (kind == task->name) return task->study_template();
    allowed += std::string("\"") + task->name + "\", ";
  }
  throw InvalidInput("KIND", kind, allowed + "or \"slurm\"");
}

}  // namespace flankwright::studies

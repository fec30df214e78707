#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "optimize/design/problem/design_task.hpp"
#include "studies/study/task.hpp"

namespace flankwright::studies {

// Each is defined in the folder of its name.
extern const Task analyse_task, optimise_task, sweep_task, accuracy_task, fit_task, geometry_task;

std::span<const Task* const> registered_tasks() {
  static constexpr std::array tasks{
      &analyse_task, &optimise_task, &sweep_task, &accuracy_task, &fit_task, &geometry_task,
  };
  return tasks;
}

std::vector<DesignVariable> varied_by_tasks(const Study& study) {
  std::vector<DesignVariable> all;
  for (const Task* task : registered_tasks()) {
    if (task->varied == nullptr) continue;
    for (const DesignVariable& variable : task->varied(study)) all.push_back(variable);
  }
  return all;
}

const Task& find_task(std::string_view name) {
  const auto tasks = registered_tasks();
  const auto found = std::ranges::find_if(tasks, [&](const Task* task) { return name == task->name; });
  if (found == tasks.end()) throw InvalidInput("task", std::string(name), "the name of a task");
  return **found;
}

}  // namespace flankwright::studies

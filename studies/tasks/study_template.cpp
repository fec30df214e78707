#include "studies/tasks/study_template.hpp"

#include <string_view>

#include "core/base/error.hpp"
#include "studies/study/task.hpp"

namespace flankwright::studies {

namespace {

constexpr std::string_view slurm_script = R"(#!/bin/bash
# A sweep on a Slurm cluster, one shard a task of a job array:
#
#     sbatch sweep.sbatch my-gear.toml results/my-gear
#
# and when it is done, anywhere:   flankwright merge my-gear.toml --out results/my-gear
# The merge names shards that were lost; run those again:   sbatch --array=4,17 sweep.sbatch my-gear.toml results/my-gear
# A shard that was stopped goes on where it ended. Make shards of minutes: starting a task takes Slurm half a second, and each
# analyses the nominal sample first.
#SBATCH --job-name=flankwright
#SBATCH --array=1-20                 # shards 1 .. 20; the last number is also the one below
#SBATCH --cpus-per-task=4
#SBATCH --mem-per-cpu=500M           # "fitted" and "fe" need gigabytes where no earlier run has kept the finite elements
#SBATCH --time=01:00:00
#SBATCH --requeue
#SBATCH --output=flankwright-%A-%a.log
set -eu
shards=20
study=$1
folder=$2
exec "${FLANKWRIGHT:-flankwright}" run "$study" --out "$folder" --threads "${SLURM_CPUS_PER_TASK:-1}" --shard "$SLURM_ARRAY_TASK_ID/$shards"
)";

}  // namespace

std::string study_template(const std::string& kind) {
  if (kind == "slurm") return std::string(slurm_script);
  std::string allowed;
  for (const Task* task : registered_tasks()) {
    if (kind == task->name) return task->study_template();
    allowed += std::string("\"") + task->name + "\", ";
  }
  throw InvalidInput("KIND", kind, allowed + "or \"slurm\"");
}

}  // namespace flankwright::studies

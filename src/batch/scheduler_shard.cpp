#include "batch/scheduler_shard.h"

#include <fmt/core.h>

#include <string_view>
#include <vector>

#include "asdf_vk/error.h"
#include "batch/input_list.h"
#include "core/text.h"

namespace asdfvk {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::OptionOutOfRange, message); }

/// The variables of a scheduler. Indices begin at 0, except for arrays of Slurm.
struct Scheduler {
  const char *index, *count;
};
constexpr const char* kArrayIndex = "SLURM_ARRAY_TASK_ID";
constexpr Scheduler kSchedulers[]{{"AWS_BATCH_JOB_ARRAY_INDEX", "AWS_BATCH_JOB_ARRAY_SIZE"},
                                  {"JOB_COMPLETION_INDEX", nullptr},  // Kubernetes sets no number of pods.
                                  {kArrayIndex, "SLURM_ARRAY_TASK_COUNT"},
                                  {"RANK", "WORLD_SIZE"},
                                  {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};  // srun sets both.

class Environment {
 public:
  explicit Environment(const EnvironmentLookup& lookup) : lookup_(lookup) {}

  [[nodiscard]] bool has(const char* name) const {
    const char* const value = lookup_(name);
    return value != nullptr && *value != '\0';
  }

  [[nodiscard]] uint32_t number(const char* name) const {
    if (!has(name)) refuse(fmt::format("auto: {} is not set; give I/N", name));
    const auto number = numberIn<uint32_t>(lookup_(name));
    if (!number) refuse(oneLine(fmt::format("auto: {} is '{}', not a whole number; give I/N", name, lookup_(name))));
    return *number;
  }

 private:
  const EnvironmentLookup& lookup_;
};

/// Index of this task in an array of Slurm, from 0.
uint32_t slurmArrayIndex(const Environment& environment) {
  const uint32_t least = environment.number("SLURM_ARRAY_TASK_MIN"),
                 greatest = environment.number("SLURM_ARRAY_TASK_MAX"),
                 step = environment.has("SLURM_ARRAY_TASK_STEP") ? environment.number("SLURM_ARRAY_TASK_STEP") : 1,
                 id = environment.number(kArrayIndex), count = environment.number("SLURM_ARRAY_TASK_COUNT");
  // With --array=3,5,9 the variables do not determine the position of a task.
  if (step == 0 || id < least || id > greatest || (id - least) % step != 0 || (greatest - least) / step + 1 != count)
    refuse(fmt::format("auto: the {} tasks of the Slurm array, {} to {}, are not a range; give --array=1-N, or I/N",
                       count, least, greatest));
  return (id - least) / step;
}

Shard shardOf(const Scheduler& scheduler, std::optional<uint32_t> given, const Environment& environment) {
  const uint32_t index =
      scheduler.index == kArrayIndex ? slurmArrayIndex(environment) : environment.number(scheduler.index);
  const bool hasCount = scheduler.count != nullptr && environment.has(scheduler.count);
  if (!hasCount && !given)
    refuse(fmt::format("auto: {} is {}, but the number of parts is unknown; give auto/N", scheduler.index, index));
  const uint32_t count = hasCount ? environment.number(scheduler.count) : *given;
  if (given && *given != count) refuse(fmt::format("auto/{}: {} is {}; give auto", *given, scheduler.count, count));
  if (index >= count || count > kMaxShardCount)
    refuse(
        fmt::format("auto: index {} of {} parts ({}) is out of range; indices begin at 0, and there are at most {} "
                    "parts; give I/N",
                    index, count, scheduler.index, kMaxShardCount));
  return {index + 1, count, scheduler.index};
}

std::string variableNames() {
  std::vector<std::string> names;
  for (const Scheduler& scheduler : kSchedulers)
    names.push_back(scheduler.count == nullptr ? fmt::format("{} (with auto/N)", scheduler.index)
                                               : fmt::format("{} with {}", scheduler.index, scheduler.count));
  return enumeration(names, "or");
}

}  // namespace

Shard shardOfScheduler(std::optional<uint32_t> given, const EnvironmentLookup& lookup) {
  const Environment environment(lookup);
  const Scheduler* chosen = nullptr;
  for (const Scheduler& scheduler : kSchedulers) {
    if (!environment.has(scheduler.index)) continue;
    // An image that sets RANK=0 and WORLD_SIZE=1, for example, does not hide an array.
    const bool isSingle = scheduler.count != nullptr && environment.has(scheduler.count) &&
                          lookup(scheduler.count) == std::string_view("1");
    if (chosen == nullptr || !isSingle) chosen = &scheduler;
    if (!isSingle) break;
  }
  if (chosen == nullptr)
    refuse(fmt::format("auto: none of these variables of schedulers is set: {}; give I/N", variableNames()));
  return shardOf(*chosen, given, environment);
}

}  // namespace asdfvk

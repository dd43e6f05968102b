#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace asdfvk {

struct Shard;

/// The value of an environment variable; null if it is not set.
using EnvironmentLookup = std::function<const char*(const char* name)>;

/// Returns the shard that a scheduler assigns to this process by environment variables: of AWS Batch, of an indexed job
/// of Kubernetes, of an array of Slurm, of a launcher such as torchrun, or of a task of Slurm. If several of them are
/// set, the first one in this order with more than one shard counts, and if there is none, the first one. given: number
/// of shards, for schedulers that do not set it. Throws Error{OptionOutOfRange} if no variable is set, if the number of
/// shards is unknown, if `given` contradicts the scheduler, and for wrong values.
[[nodiscard]] Shard shardOfScheduler(std::optional<uint32_t> given, const EnvironmentLookup& lookup);

}  // namespace asdfvk

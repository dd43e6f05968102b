#include "batch/input_list.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

std::vector<InputFile> manyInputs() {
  std::vector<InputFile> inputs;
  uint64_t state = 1;
  for (int i = 0; i < 1000; ++i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    inputs.push_back({.path = fmt::format("m{}.off", i), .byteCount = (state >> 33) % 300'000});
  }
  return inputs;
}

TEST_CASE("shards are disjoint, their union is the whole, and their sizes differ by less than 2 %") {
  const std::vector<InputFile> inputs = manyInputs();
  std::set<std::string> paths;
  std::vector<uint64_t> bytes;
  for (uint32_t index = 1; index <= 7; ++index) {
    bytes.push_back(0);
    for (const size_t i : selectShard(inputs, {index, 7})) {
      CHECK_MESSAGE(paths.insert(inputs[i].path).second, inputs[i].path);
      bytes.back() += inputs[i].byteCount;
    }
  }
  CHECK_EQ(paths.size(), inputs.size());
  const auto [least, most] = std::minmax_element(bytes.begin(), bytes.end());
  CHECK_LT(static_cast<double>(*most), 1.02 * static_cast<double>(*least));
}

TEST_CASE("a shard keeps the order of the inputs and does not depend on it") {
  std::vector<InputFile> inputs = manyInputs();
  const auto namesOf = [&] {
    std::vector<std::string> names;
    for (const size_t i : selectShard(inputs, {3, 7})) names.push_back(inputs[i].path);
    return names;
  };
  const std::vector<std::string> forwards = namesOf();
  std::reverse(inputs.begin(), inputs.end());
  std::vector<std::string> backwards = namesOf();
  std::reverse(backwards.begin(), backwards.end());
  CHECK_EQ(forwards, backwards);
}

TEST_CASE("there may be more shards than meshes") {
  const std::vector<InputFile> one{{.path = "a.off", .byteCount = 0}};
  CHECK_EQ(selectShard(one, {1, 3}).size(), 1);
  CHECK(selectShard(one, {2, 3}).empty());
}

TEST_CASE("a shard is I/N") {
  CHECK_EQ(parseShard("2/7").index, 2);
  CHECK_EQ(parseShard("2/7").count, 7);
  for (const char* text : {"auto/0", "auto/x", "auto/", "auto/1000001", "automatic", "au", "", "1", "0/3", "4/3", "1/0",
                           "-1/3", "a/3", "1/3x", "1 / 3", "/", "1/", "1/1000001", "1/4294967295"})
    CHECK_THROWS_AS_MESSAGE((void)parseShard(text), Error, text);
}

using Variables = std::map<std::string, std::string>;

Shard shardIn(const Variables& variables, const std::string& text = "auto") {
  return parseShard(text, [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

/// "I/N of VARIABLE", or the message of the refusal.
std::string textOf(const Variables& variables, const std::string& text = "auto") {
  try {
    const Shard shard = shardIn(variables, text);
    return fmt::format("{}/{} {}", shard.index, shard.count, shard.variable);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::OptionOutOfRange);
    return error.what();
  }
}

const Variables kAws{{"AWS_BATCH_JOB_ARRAY_INDEX", "4"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "9"}},
    kKubernetes{{"JOB_COMPLETION_INDEX", "6"}}, kLauncher{{"RANK", "2"}, {"WORLD_SIZE", "3"}},
    kSlurmTask{{"SLURM_PROCID", "1"}, {"SLURM_STEP_NUM_TASKS", "2"}};

Variables slurmArray(const char* id, const char* least, const char* greatest, const char* step, const char* count) {
  return {{"SLURM_ARRAY_TASK_ID", id},
          {"SLURM_ARRAY_TASK_MIN", least},
          {"SLURM_ARRAY_TASK_MAX", greatest},
          {"SLURM_ARRAY_TASK_STEP", step},
          {"SLURM_ARRAY_TASK_COUNT", count}};
}

TEST_CASE("auto is the index of a scheduler, which begins at 0, or at the first index of a Slurm array") {
  CHECK_EQ(textOf(kAws), "5/9 AWS_BATCH_JOB_ARRAY_INDEX");
  CHECK_EQ(textOf(kKubernetes, "auto/7"), "7/7 JOB_COMPLETION_INDEX");
  CHECK_EQ(textOf(kLauncher), "3/3 RANK");
  CHECK_EQ(textOf(kSlurmTask), "2/2 SLURM_PROCID");
  CHECK_EQ(textOf(slurmArray("1", "1", "100", "1", "100")), "1/100 SLURM_ARRAY_TASK_ID");
  CHECK_EQ(textOf(slurmArray("9", "5", "9", "2", "3")), "3/3 SLURM_ARRAY_TASK_ID");
  CHECK_EQ(textOf(kAws, "auto/9"), "5/9 AWS_BATCH_JOB_ARRAY_INDEX");
  CHECK_EQ(textOf({{"RANK", "2"}}, "auto/4"), "3/4 RANK");
}

TEST_CASE("of several schedulers the first with more than one part counts, in the order of the documentation") {
  Variables all = kAws;
  for (const Variables& each : {kKubernetes, slurmArray("2", "1", "3", "1", "3"), kLauncher, kSlurmTask})
    all.insert(each.begin(), each.end());
  CHECK_EQ(textOf(all), "5/9 AWS_BATCH_JOB_ARRAY_INDEX");
  all["AWS_BATCH_JOB_ARRAY_SIZE"] = "1";
  CHECK_EQ(textOf(all, "auto/7"), "7/7 JOB_COMPLETION_INDEX");
  all["JOB_COMPLETION_INDEX"] = "";
  CHECK_EQ(textOf(all), "2/3 SLURM_ARRAY_TASK_ID");
  all.erase("SLURM_ARRAY_TASK_ID");
  CHECK_EQ(textOf(all), "3/3 RANK");
  all.erase("RANK");
  CHECK_EQ(textOf(all), "2/2 SLURM_PROCID");
  all.erase("SLURM_PROCID");
  all["AWS_BATCH_JOB_ARRAY_INDEX"] = "0";
  CHECK_EQ(textOf(all), "1/1 AWS_BATCH_JOB_ARRAY_INDEX");
}

TEST_CASE("without variables, or with wrong ones, auto is refused with their names and values") {
  const std::string none = textOf({});
  for (const char* name :
       {"AWS_BATCH_JOB_ARRAY_INDEX", "AWS_BATCH_JOB_ARRAY_SIZE", "JOB_COMPLETION_INDEX (with auto/N)",
        "SLURM_ARRAY_TASK_ID", "RANK with WORLD_SIZE", "SLURM_PROCID", "; give I/N"})
    CHECK_MESSAGE(none.find(name) != std::string::npos, none);
  CHECK_EQ(textOf(kKubernetes), "auto: JOB_COMPLETION_INDEX is 6, but the number of parts is unknown; give auto/N");
  CHECK_EQ(textOf({{"SLURM_PROCID", "0"}}), "auto: SLURM_PROCID is 0, but the number of parts is unknown; give auto/N");
  CHECK_EQ(textOf(kAws, "auto/10"), "auto/10: AWS_BATCH_JOB_ARRAY_SIZE is 9; give auto");
  CHECK_EQ(textOf({{"RANK", "x\n"}, {"WORLD_SIZE", "2"}}), "auto: RANK is 'x ', not a whole number; give I/N");
  CHECK_EQ(textOf({{"RANK", "0"}, {"WORLD_SIZE", "-2"}}), "auto: WORLD_SIZE is '-2', not a whole number; give I/N");
  for (const auto& [index, count] : {std::pair("3", "3"), {"0", "0"}, {"0", "4294967295"}})
    CHECK(textOf({{"RANK", index}, {"WORLD_SIZE", count}}).find("(RANK) is out of range") != std::string::npos);
  CHECK_NE(textOf(kKubernetes, "auto/6").find("index 6 of 6 parts"), std::string::npos);
  // --array=3,5 and an array whose variables are missing.
  CHECK_NE(textOf(slurmArray("5", "3", "5", "1", "2")).find("are not a range"), std::string::npos);
  CHECK_NE(textOf(slurmArray("5", "3", "5", "0", "3")).find("are not a range"), std::string::npos);
  CHECK_EQ(textOf({{"SLURM_ARRAY_TASK_ID", "1"}}), "auto: SLURM_ARRAY_TASK_MIN is not set; give I/N");
}

}  // namespace
}  // namespace asdfvk

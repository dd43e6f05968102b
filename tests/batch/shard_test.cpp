#include "batch/input_list.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
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
  for (const char* text :
       {"", "1", "0/3", "4/3", "1/0", "-1/3", "a/3", "1/3x", "1 / 3", "/", "1/", "1/1000001", "1/4294967295"})
    CHECK_THROWS_AS_MESSAGE((void)parseShard(text), Error, text);
}

}  // namespace
}  // namespace asdfvk

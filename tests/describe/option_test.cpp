#include "describe/option.h"

#include <doctest/doctest.h>

namespace asdfvk {
namespace {

TEST_CASE("names with few other letters are similar, and those with a word that begins so") {
  const std::vector<std::string> names{"--seeds", "--rng-seed", "--segment", "--rays", "--thinner-than", "--parts"};
  CHECK_EQ(similarNames("--seed", names), "--seeds or --rng-seed");
  CHECK_EQ(similarNames("--ray", names), "--rays");
  CHECK_EQ(similarNames("--thin", names), "--thinner-than");
  CHECK_EQ(similarNames("--than", names), "--thinner-than");
  CHECK_EQ(similarNames("--sgement", names), "--segment");
  CHECK_EQ(similarNames("--output", names), "");
  CHECK_EQ(similarNames("seed", {"seeds", "random_seed", "rays"}), "seeds or random_seed");
  CHECK_EQ(similarNames("", names), "");
  CHECK_EQ(similarNames("seed", {"seed1", "seed2", "seed3", "seed4"}), "seed1 or seed2 or seed3");
}

}  // namespace
}  // namespace asdfvk

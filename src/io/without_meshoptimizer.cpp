#include <fmt/core.h>

#include "io/input_failure.h"
#include "io/meshopt_view.h"

namespace asdfvk {

bool readsMeshopt() { return false; }

std::vector<char> decodeMeshopt(std::span<const char>, const MeshoptView&, std::string_view where) {
  failInput(
      fmt::format("{} is compressed by meshopt, which this build cannot read; build it with libmeshoptimizer-dev, "
                  "or export without compression",
                  where));
}

}  // namespace asdfvk

#include <fmt/core.h>

#include "io/draco_mesh.h"
#include "io/input_failure.h"

namespace asdfvk {

DracoMesh decodeDraco(std::span<const char>, const DracoRequest&, DracoBudget&, std::string_view where) {
  failInput(
      fmt::format("{} is compressed by Draco, which this build cannot read; build it with libdraco-dev, or export "
                  "without compression",
                  where));
}

}  // namespace asdfvk

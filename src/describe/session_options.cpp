// One row per option of a session, and the options that the report lists.
#include <array>

#include "describe/computation_options.h"

namespace asdfvk {
namespace {

const std::array kSessionRows{
    OptionRow{.name = "backend",
              .group = kDeviceGroup,
              .access = ASDFVK_MEMBER(SessionSettings, backend),
              .text = "Backend that traces the rays. vulkan: a Vulkan device. cpu: the cores of the CPU. reference: "
                      "the CPU in double precision. auto: the first of these that is available",
              .valueNames = "auto|vulkan|cpu|reference"},
    OptionRow{.name = "device",
              .access = ASDFVK_MEMBER(SessionSettings, device),
              .text = "Vulkan device: its number in --list-devices or a part of its name",
              .placeholder = "N|NAME",
              .defaultText = "the best",
              .keywordType = "str | int"},
    OptionRow{.name = "require-gpu",
              .access = ASDFVK_MEMBER(SessionSettings, requireGpu),
              .text = "Fail if no GPU is usable",
              .more = "The exit code is then 3. CPU devices, `cpu` and `reference` are not used."},
    OptionRow{.name = "threads",
              .access = ASDFVK_MEMBER(SessionSettings, threadCount),
              .range = fromTo(0, 1024),
              .text = "Number of CPU threads, also of lavapipe; 0: the number of cores. Results do not depend on the "
                      "number",
              .placeholder = "N"},
    OptionRow{.name = "kernel",
              .group = kExperimentGroup,
              .access = ASDFVK_MEMBER(SessionSettings, variant.kernel),
              .text = "Vulkan: rays that neighbouring lanes trace. seed: the same ray of neighbouring seeds. ray: the "
                      "rays of one seed. packet: as ray, but the lanes traverse the hierarchy together",
              .more = "For `--kernel` and `--fetch`, `auto` depends on the class of the device and the size of the "
                      "mesh ([devices.md](devices.md)).",
              .keyword = "",
              .valueNames = "auto|seed|ray|packet",
              .emptyIsAuto = true},
    OptionRow{.name = "fetch",
              .access = ASDFVK_MEMBER(SessionSettings, variant.fetch),
              .text = "Vulkan: kind of buffers from which the kernels read the hierarchy",
              .keyword = "",
              .valueNames = "auto|texel|storage",
              .emptyIsAuto = true},
};

}  // namespace

OptionRows sessionRows() {
  static const auto rows = withGroups(kSessionRows);
  return rows;
}

std::vector<std::pair<std::string, OptionValue>> reportedOptions(const ComputationSettings& computation,
                                                                 const SessionSettings& session) {
  std::vector<std::pair<std::string, OptionValue>> values;
  const auto add = [&](OptionRows rows, const void* target) {
    for (const OptionRow& row : rows)
      if (target != &session || row.name != std::string_view("threads"))
        values.emplace_back(spelled(row, OptionSpelling::CamelCase),
                            isNeedMet(row, rows, target) ? valueOf(row, target) : OptionValue());
  };
  add(computationRows(), &computation);
  add(sessionRows(), &session);
  return values;
}

}  // namespace asdfvk

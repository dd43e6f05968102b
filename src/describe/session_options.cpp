#include "describe/session_options.h"

#include "describe/option_values.h"

namespace asdfvk {
OptionRows sessionRows(SessionSettings& settings) {
  return withGroups({
      OptionRow{.name = "backend",
                .group = kDeviceGroup,
                .member = choice<kBackendNames>(&settings.backend),
                .text = "Backend that traces the rays. vulkan: a Vulkan device. cpu: the cores of the CPU. reference: "
                        "the CPU in double precision. auto: the first of these that is available"},
      OptionRow{.name = "device",
                .member = memberAs<DeviceCodec>(&settings.device),
                .text = "Vulkan device: its number in the list of devices or a part of its name",
                .more = "`{list-devices}` lists the devices.",
                .placeholder = "N|NAME",
                .defaultText = "the best"},
      OptionRow{.name = "require-gpu",
                .member = &settings.requireGpu,
                .text = "Fail if no GPU is usable",
                .more = "The exit code is then 3. CPU devices, `cpu` and `reference` are not used."},
      OptionRow{.name = "threads",
                .member = &settings.threadCount,
                .range = fromTo(0, 1024),
                .text = "Number of CPU threads, also of lavapipe; 0: the number of cores. Results do not depend on the "
                        "number",
                .placeholder = "N"},
      OptionRow{
          .name = "kernel",
          .group = kExperimentGroup,
          .member = memberAs<AutoChoiceCodec<kKernels>>(&settings.variant.kernel),
          .text = "Vulkan: rays that neighbouring lanes trace. seed: the same ray of neighbouring seeds. ray: the "
                  "rays of one seed. packet: as ray, but the lanes traverse the hierarchy together",
          .more = "With `{kernel}`, `auto` is `seed`. With `{fetch}`, `auto` depends on the class of the device and "
                  "the size of the mesh ([devices.md](devices.md)).",
          .where = OptionPlace::Program},
      OptionRow{.name = "fetch",
                .member = memberAs<AutoChoiceCodec<kFetches>>(&settings.variant.fetch),
                .text = "Vulkan: kind of buffers from which the kernels read the hierarchy",
                .where = OptionPlace::Program},
  });
}

void requireValid(SessionSettings session, OptionSpelling spelling) {
  const OptionRows rows = sessionRows(session);
  requireInRange(rows, spelling);
  if (mayUseDevice(session.backend)) return;
  if (session.requireGpu)
    refuse(rows, "{require-gpu} contradicts {backend=cpu} and reference, which run on the CPU; drop one", spelling);
  if (!session.device.empty())
    refuse(rows, "{device} chooses a Vulkan device, which {backend=cpu} and reference do not use; drop one", spelling);
  if (session.variant.kernel || session.variant.fetch)
    refuse(rows, "{kernel} and {fetch} choose shaders, which {backend=cpu} and reference do not use; drop one",
           spelling);
}

std::vector<std::pair<std::string, OptionValue>> reportedOptions(ComputationSettings computation,
                                                                 SessionSettings session) {
  std::vector<std::pair<std::string, OptionValue>> values;
  const auto add = [&](const OptionRows& rows) {
    for (const OptionRow& row : rows)
      if (row.name != std::string_view("threads"))
        values.emplace_back(spelled(row, OptionSpelling::CamelCase),
                            isNeedMet(row, rows) ? row.member.write() : OptionValue());
  };
  add(computationRows(computation));
  add(sessionRows(session));
  return values;
}

}  // namespace asdfvk

#include <fmt/format.h>

#include <string>

#include "io/result_formats.h"

namespace asdfvk {

void writeNpy(AtomicFile& file, const FaceValues& face) {
  // Magic, version 1.0, the header's length, then the header, filled up so that the data start at a multiple of 64.
  constexpr size_t kBeforeHeader = 10;
  std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({},), }}", face.values.size());
  header.append(63 - (kBeforeHeader + header.size()) % 64, ' ');
  header += '\n';
  file.write("\x93NUMPY\x01");
  file.put(uint8_t{0});
  file.put(static_cast<uint16_t>(header.size()));
  file.write(header);
  for (const double value : face.values) file.put(static_cast<float>(value));
}

}  // namespace asdfvk

#include "io/number_text.h"
#include "io/result_formats.h"

namespace asdfvk {

void writeCsv(AtomicFile& file, const FaceValues& face) {
  file.write("face,sdf,seed\n");
  for (size_t i = 0; i < face.values.size(); ++i) {
    char* const row = file.reserve(2 * kNumberTextSize + 4);
    char* to = appendNumber(row, i);
    *to++ = ',';
    to = appendNumber(to, face.values[i]);
    *to++ = ',';
    *to++ = face.isSeed[i] != 0 ? '1' : '0';
    *to++ = '\n';
    file.advance(static_cast<size_t>(to - row));
  }
}

}  // namespace asdfvk

// NumPy's .npy, version 1.0: the first field of a result, with shape (n,) or (n, 3) and type '<f4', '|u1' or '<u4'.
#include "io/npy_file.h"

#include <fmt/core.h>

#include <array>
#include <type_traits>
#include <vector>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "io/formats.h"
#include "io/result_view.h"
#include "io/row_blocks.h"

namespace asdfvk {
namespace {

constexpr std::string_view kMagic("\x93NUMPY\x01\x00", 8);  // The last two bytes are version 1.0.
constexpr size_t kPrefixSize = 10;                          // The magic and the size of the remaining header.
// One entry for each alternative of Field::Values.
constexpr std::array<std::string_view, 3> kTypes{"<f4", "|u1", "<u4"};
constexpr std::array<uint64_t, 3> kEntrySizes{4, 1, 4};

}  // namespace

std::string npyHeader(const Field& field) {
  const std::string shape = field.componentCount == 1
                                ? fmt::format("({},)", field.itemCount())
                                : fmt::format("({}, {})", field.itemCount(), field.componentCount);
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", kTypes[field.values.index()], shape);
  header.append(63 - (kPrefixSize + header.size()) % 64, ' ');
  header += '\n';
  std::string prefix(kMagic);
  prefix += static_cast<char>(header.size() & 0xff);
  prefix += static_cast<char>(header.size() >> 8);
  return prefix + header;
}

uint64_t npyEntriesSize(const Field& field) { return field.size() * kEntrySizes[field.values.index()]; }

void putNpyEntries(const Field& field, ByteBuffer& to, uint64_t begin, uint64_t end) {
  std::visit(
      [&]<typename T>(const std::vector<T>& entries) {
        if constexpr (!std::is_same_v<T, double>) return to.write(entries.data() + begin, (end - begin) * sizeof(T));
        for (uint64_t i = begin; i < end; ++i) to.put(static_cast<float>(entries[i]));
      },
      field.values);
}

void writeNpyEntries(AtomicFile& file, const Field& field) {
  writeRowBlocks(file, field.size(),
                 [&](ByteBuffer& to, uint64_t begin, uint64_t end) { putNpyEntries(field, to, begin, end); });
}

namespace {

void writeNpy(AtomicFile& file, const ResultView& result) {
  if (result.fields().empty()) throw Error(ErrorCode::OptionConflict, "a .npy holds one field, and there is none");
  const Field& field = result.fields().front();
  file.write(npyHeader(field));
  writeNpyEntries(file, field);
}

}  // namespace

extern const FileFormat kNpyFormat{.name = "npy", .extensions = {"npy"}, .write = writeNpy, .holdsOneLocation = true};

}  // namespace asdfvk

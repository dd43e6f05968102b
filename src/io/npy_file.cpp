// NumPy's .npy, version 1.0: the first field of a result, with shape (n,) or (n, 3) and type '<f4', '|u1' or '<u4'.
#include "io/npy_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "io/formats.h"
#include "io/result_view.h"

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

void putNpyEntries(const Field& field, const std::function<void(std::span<const char>)>& put) {
  const auto putBytes = [&](const void* data, size_t size) { put({static_cast<const char*>(data), size}); };
  std::visit(
      [&]<typename T>(const std::vector<T>& entries) {
        if constexpr (!std::is_same_v<T, double>) return putBytes(entries.data(), entries.size() * sizeof(T));
        std::array<float, 4096> part;
        for (size_t first = 0; first < entries.size(); first += part.size()) {
          const size_t count = std::min(part.size(), entries.size() - first);
          for (size_t i = 0; i < count; ++i) part[i] = static_cast<float>(entries[first + i]);
          putBytes(part.data(), count * sizeof(float));
        }
      },
      field.values);
}

namespace {

void writeNpy(AtomicFile& file, const ResultView& result) {
  if (result.fields().empty()) throw Error(ErrorCode::OptionConflict, "a .npy holds one field, and there is none");
  const Field& field = result.fields().front();
  file.write(npyHeader(field));
  putNpyEntries(field, [&](std::span<const char> part) { file.write(part.data(), part.size()); });
}

}  // namespace

extern const FileFormat kNpyFormat{.name = "npy", .extensions = {"npy"}, .write = writeNpy, .holdsOneLocation = true};

}  // namespace asdfvk

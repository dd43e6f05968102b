// The first field: version 1.0, shape (n,) or (n, 3), '<f4', '|u1' or '<u4'. Read as a face field named `values`: the
// format has neither names nor locations. Also reads '<f8'.
#include "io/npy_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <type_traits>
#include <vector>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/text.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/stored_fields.h"

namespace asdfvk {
namespace {

constexpr std::string_view kMagic("\x93NUMPY\x01\x00", 8);  // With version 1.0.
constexpr size_t kPrefixSize = 10;                          // The magic and the size of the rest of the header.
// Of the alternatives of Field::Values.
constexpr std::array<std::string_view, 3> kTypes{"<f4", "|u1", "<u4"};
constexpr std::array<uint64_t, 3> kEntrySizes{4, 1, 4};

/// The dictionary of a .npy header, as NumPy and npyHeader() write it.
class NpyDictionary {
 public:
  /// byte: the position of the text in the file.
  NpyDictionary(std::string_view text, uint64_t byte) : text_(text), byte_(byte) {
    take("{'descr': '");
    type = text_.substr(0, text_.find('\''));
    take(type);
    take("', 'fortran_order': False, 'shape': (");
    itemCount = takeNumber();
    if (!text_.starts_with(",)")) {
      take(", ");
      componentCount = takeNumber();
      if (componentCount != 3) fail("an array has a second dimension other than 3");
    } else {
      take(",");
    }
    take("), }");
    if (!text_.ends_with('\n') || text_.find_first_not_of(' ') != text_.size() - 1)
      fail("expected blanks and a line break at the end of the header");
  }

  std::string_view type;
  uint64_t itemCount = 0;
  uint64_t componentCount = 1;

 private:
  [[noreturn]] void fail(std::string_view reason) const { failAtByte(byte_, reason); }
  void take(std::string_view expected) {
    if (!text_.starts_with(expected)) fail(fmt::format("expected {} in the header of an array", quoted(expected)));
    text_.remove_prefix(expected.size());
    byte_ += expected.size();
  }
  uint64_t takeNumber() {
    uint64_t number = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
    if (error != std::errc()) fail("expected a dimension of the array");
    take(text_.substr(0, static_cast<size_t>(end - text_.data())));
    return number;
  }

  std::string_view text_;
  uint64_t byte_;
};

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

Field parseNpy(std::span<const char> bytes, uint64_t byte) {
  const std::string_view text(bytes.data(), bytes.size());
  if (!text.starts_with(kMagic) || text.size() < kPrefixSize) failAtByte(byte, "not an array of .npy version 1.0");
  uint16_t headerSize = 0;
  std::memcpy(&headerSize, bytes.data() + kMagic.size(), sizeof headerSize);
  if (text.size() - kPrefixSize < headerSize) failAtByte(byte, "the header of the array is truncated");
  const NpyDictionary header(text.substr(kPrefixSize, headerSize), byte + kPrefixSize);
  const std::span<const char> entries = bytes.subspan(kPrefixSize + headerSize);
  Field field;
  field.componentCount = static_cast<uint32_t>(header.componentCount);
  size_t entrySize = sizeof(uint32_t);
  if (header.type == "<f4") {
    field.values = storedEntries<float>(entries);
  } else if (header.type == "<f8") {
    field.values = storedEntries<double>(entries);
    entrySize = sizeof(double);
  } else if (header.type == "<u4") {
    field.values = storedEntries<uint32_t>(entries);
  } else if (header.type == "|u1") {
    field.values = storedEntries<uint8_t>(entries);
    entrySize = sizeof(uint8_t);
  } else {
    failAtByte(byte + kPrefixSize, fmt::format("arrays of type {} are not supported", quoted(header.type)));
  }
  const uint64_t itemSize = entrySize * header.componentCount;
  if (entries.size() % itemSize != 0 || entries.size() / itemSize != header.itemCount)
    failAtByte(
        byte + kPrefixSize + headerSize,
        fmt::format("an array of {} with {} each must not have {}; the file is truncated or the shape is wrong",
                    counted(header.itemCount, "item"), counted(itemSize, "byte"), counted(entries.size(), "byte")));
  return field;
}

namespace {

Match detectNpy(std::span<const char> bytes) {
  return std::string_view(bytes.data(), bytes.size()).starts_with("\x93NUMPY") ? Match::Certain : Match::None;
}

std::vector<Field> parseNpyFields(std::span<const char> bytes) {
  std::vector<Field> fields{parseNpy(bytes, 0)};
  fields[0].name = "values";
  return fields;
}

void writeNpy(AtomicFile& file, const ResultView& result) {
  if (result.fields().empty()) throw Error(ErrorCode::OptionConflict, "a .npy holds one field, and there is none");
  const Field& field = result.fields().front();
  file.write(npyHeader(field));
  putNpyEntries(field, [&](std::span<const char> part) { file.write(part.data(), part.size()); });
}

}  // namespace

extern const FileFormat kNpyFormat{
    .name = "npy", .extensions = {"npy"}, .detect = detectNpy, .parseFields = parseNpyFields, .write = writeNpy};

}  // namespace asdfvk

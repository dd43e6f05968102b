// NumPy's .npz: an uncompressed zip archive (APPNOTE.TXT of PKWARE, 4.3) with a member FIELD.npy per field. The comment
// of a member is "face" or "vertex". A vertex field with the name of a face field is the member vertex_FIELD.npy with
// the comment "vertex FIELD". The central directory follows the members and their local headers.
#include <fmt/core.h>
#include <zlib.h>

#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/parallel.h"
#include "io/formats.h"
#include "io/npy_file.h"
#include "io/result_view.h"

namespace asdfvk {
namespace {

constexpr uint32_t kLocalSignature = 0x04034b50, kCentralSignature = 0x02014b50, kEndSignature = 0x06054b50;
constexpr uint64_t kLocalSize = 30, kCentralSize = 46, kEndSize = 22;
// First word of the comment of a member whose name differs from the name of its field.
constexpr std::string_view kRenamed = "vertex ";
constexpr uint16_t kZipVersion = 20;
// 1980-01-01, the first date of the format. The current date would make the bytes of a result vary.
constexpr uint16_t kFirstDate = 0x21;

struct Checksum {
  uint32_t value = 0;
  uint64_t size = 0;  ///< Number of bytes.
};

Checksum checksumOf(std::string_view bytes) {
  return {static_cast<uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size())),
          bytes.size()};
}

/// The checksum of the bytes of a, followed by those of b.
Checksum joinedChecksum(const Checksum& a, const Checksum& b) {
  const auto size = static_cast<z_off_t>(b.size);
  return {static_cast<uint32_t>(::crc32_combine(a.value, b.value, size)), a.size + b.size};
}

/// The checksum of the .npy of a field.
Checksum npyChecksum(const Field& field) {
  constexpr size_t kEntriesPerBlock = size_t{1} << 16;
  const auto checksumOfEntries = [&](size_t begin, size_t end) {
    ByteBuffer entries;
    putNpyEntries(field, entries, begin, end);
    return checksumOf(entries.written());
  };
  return joinedChecksum(checksumOf(npyHeader(field)),
                        foldInParallel<Checksum, kEntriesPerBlock>(field.size(), checksumOfEntries, joinedChecksum));
}

struct ZipMember {
  std::string name;  ///< FIELD.npy, the name that NumPy expects.
  std::string kind;  ///< "face", "vertex" or "vertex FIELD", the comment of the member.
  uint32_t checksum = 0;
  uint32_t size = 0;
  uint32_t offset = 0;  ///< Position of the local header.
};

/// Writes the words that the local header and the central directory share.
void putCommonHeader(AtomicFile& file, const ZipMember& member) {
  for (const uint16_t word : {kZipVersion, uint16_t{0}, uint16_t{0}, uint16_t{0}, kFirstDate}) file.put(word);
  for (const uint32_t number : {member.checksum, member.size, member.size}) file.put(number);
  file.put(static_cast<uint16_t>(member.name.size()));
  file.put(uint16_t{0});  // No extra fields.
}

void putCentralHeader(AtomicFile& file, const ZipMember& member) {
  file.put(kCentralSignature);
  file.put(kZipVersion);
  putCommonHeader(file, member);
  file.put(static_cast<uint16_t>(member.kind.size()));
  for (int i = 0; i < 4; ++i) file.put(uint16_t{0});  // Disk, internal and external attributes.
  file.put(member.offset);
  file.write(member.name);
  file.write(member.kind);
}

/// Returns a member per field, without sizes and checksums.
std::vector<ZipMember> namedMembers(FieldReferences fields) {
  std::set<std::string_view> faceNames;
  for (const Field& field : fields)
    if (field.location == FieldLocation::PerFace) faceNames.insert(field.name);
  std::vector<ZipMember> members;
  std::set<std::string> names;
  for (const Field& field : fields) {
    ZipMember& member = members.emplace_back();
    member.name = field.name + ".npy";
    member.kind = field.location == FieldLocation::PerFace ? "face" : "vertex";
    if (field.location == FieldLocation::PerVertex && faceNames.contains(field.name)) {
      member.name = "vertex_" + member.name;
      member.kind = std::string(kRenamed) + field.name;
    }
    if (!names.insert(member.name).second)
      throw Error(ErrorCode::OptionConflict, fmt::format("two fields have the same name {} in the .npz", member.name));
  }
  return members;
}

void writeNpz(AtomicFile& file, const ResultView& result) {
  std::vector<ZipMember> members = namedMembers(result.fields());
  uint64_t offset = 0, directorySize = 0;
  for (size_t i = 0; i < members.size(); ++i) {
    const Field& field = result.fields()[i];
    ZipMember& member = members[i];
    member.offset = static_cast<uint32_t>(offset);
    const uint64_t size = npyHeader(field).size() + npyEntriesSize(field);
    member.size = static_cast<uint32_t>(size);
    offset += kLocalSize + member.name.size() + size;
    directorySize += kCentralSize + member.name.size() + member.kind.size();
  }
  if (offset + directorySize > std::numeric_limits<uint32_t>::max() ||
      members.size() > std::numeric_limits<uint16_t>::max())
    throw Error(ErrorCode::OutputNotWritable,
                "the fields exceed the limits of .npz, 4 GiB and 65,535 members; write .npy");
  for (size_t i = 0; i < members.size(); ++i) {
    const Field& field = result.fields()[i];
    members[i].checksum = npyChecksum(field).value;
    file.put(kLocalSignature);
    putCommonHeader(file, members[i]);
    file.write(members[i].name);
    file.write(npyHeader(field));
    writeNpyEntries(file, field);
  }
  for (const ZipMember& member : members) putCentralHeader(file, member);
  file.put(kEndSignature);
  for (const size_t count : {size_t{0}, size_t{0}, members.size(), members.size()})
    file.put(static_cast<uint16_t>(count));  // Numbers of disks, then numbers of members.
  file.put(static_cast<uint32_t>(directorySize));
  file.put(static_cast<uint32_t>(offset));
  file.put(uint16_t{0});  // No comment.
}

}  // namespace

extern const FileFormat kNpzFormat{.name = "npz", .extensions = {"npz"}, .write = writeNpz};

}  // namespace asdfvk

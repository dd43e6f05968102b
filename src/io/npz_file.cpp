// .npz of NumPy: a zip archive (APPNOTE.TXT of PKWARE, 4.3), not compressed: a member FIELD.npy per field, with "face"
// or "vertex" as its comment. A vertex field with the name of a face field is the member vertex_FIELD.npy with the
// comment "vertex FIELD". The members, each after its local header, then the central directory. Members without a
// comment, as NumPy writes them, are face fields.
#include <fmt/core.h>
#include <zlib.h>

#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "io/formats.h"
#include "io/input_failure.h"
#include "io/npy_file.h"
#include "io/stored_fields.h"

namespace asdfvk {
namespace {

constexpr uint32_t kLocalSignature = 0x04034b50, kCentralSignature = 0x02014b50, kEndSignature = 0x06054b50;
constexpr uint64_t kLocalSize = 30, kCentralSize = 46, kEndSize = 22;
constexpr std::string_view kRenamed = "vertex ";  // Start of the comment of a member with another name than its field.
constexpr uint16_t kZipVersion = 20;
constexpr uint16_t kFirstDate = 0x21;  // 1980-01-01, the first one; the current date would change the bytes.

/// CRC-32; of several parts one after another, each with the checksum of the earlier ones.
uint32_t checksumOf(std::span<const char> part, uint32_t earlier = 0) {
  if (part.empty()) return earlier;  // zlib starts again at a null pointer.
  return static_cast<uint32_t>(::crc32_z(earlier, reinterpret_cast<const Bytef*>(part.data()), part.size()));
}

struct ZipMember {
  std::string name;  ///< FIELD.npy, the name that NumPy expects.
  std::string kind;  ///< "face", "vertex" or "vertex FIELD", the comment of the member.
  uint32_t checksum = 0;
  uint32_t size = 0;
  uint32_t offset = 0;  ///< Of the local header.
};

/// The part that the local header and the central directory share.
void putCommonHeader(AtomicFile& file, const ZipMember& member) {
  for (const uint16_t word : {kZipVersion, uint16_t{0}, uint16_t{0}, uint16_t{0}, kFirstDate}) file.put(word);
  for (const uint32_t number : {member.checksum, member.size, member.size}) file.put(number);
  file.put(static_cast<uint16_t>(member.name.size()));
  file.put(uint16_t{0});  // Extra fields.
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

/// Little-endian numbers of a zip archive, within a part of the file.
class ZipCursor {
 public:
  ZipCursor(std::span<const char> bytes, uint64_t at, uint64_t end) : bytes_(bytes), at_(at), end_(end) {}

  template <typename T>
  T take() {
    T number;
    std::memcpy(&number, take(sizeof(T)).data(), sizeof(T));
    return number;
  }
  std::string_view take(uint64_t size) {
    if (end_ - at_ < size) failAtByte(at_, "a header of the zip archive is truncated");
    at_ += size;
    return {bytes_.data() + at_ - size, size};
  }
  void requireSignature(uint32_t signature) {
    const uint64_t byte = at_;
    if (take<uint32_t>() != signature) failAtByte(byte, "expected another header of the zip archive");
  }
  [[nodiscard]] uint64_t at() const { return at_; }

 private:
  std::span<const char> bytes_;
  uint64_t at_, end_;
};

/// Reads the members in their order, without gaps, as the central directory lists them.
class ZipReader {
 public:
  explicit ZipReader(std::span<const char> bytes) : bytes_(bytes) {
    if (bytes.size() < kEndSize) failAtByte(0, "the zip archive is truncated");
    ZipCursor end(bytes, bytes.size() - kEndSize, bytes.size());
    end.requireSignature(kEndSignature);
    static_cast<void>(end.take(2 * sizeof(uint16_t)));
    memberCount_ = end.take<uint16_t>();
    const auto totalCount = end.take<uint16_t>();
    const auto directorySize = end.take<uint32_t>();
    directoryAt_ = end.take<uint32_t>();
    if (memberCount_ != totalCount || uint64_t{directoryAt_} + directorySize != bytes.size() - kEndSize)
      failAtByte(bytes.size() - kEndSize, "the sizes of the zip archive contradict each other");
  }

  std::vector<Field> readFields() {
    std::vector<Field> fields;
    ZipCursor directory(bytes_, directoryAt_, bytes_.size() - kEndSize);
    for (uint32_t i = 0; i < memberCount_; ++i) fields.push_back(readMember(directory));
    if (next_ != directoryAt_ || directory.at() != bytes_.size() - kEndSize)
      failAtByte(next_, "unexpected bytes in the zip archive");
    return fields;
  }

 private:
  Field readMember(ZipCursor& directory) {
    const uint64_t headerAt = directory.at();
    directory.requireSignature(kCentralSignature);
    static_cast<void>(directory.take(3 * sizeof(uint16_t)));  // Versions, flags.
    const auto method = directory.take<uint16_t>();
    static_cast<void>(directory.take(2 * sizeof(uint16_t)));  // Time, date.
    const auto checksum = directory.take<uint32_t>(), storedSize = directory.take<uint32_t>(),
               size = directory.take<uint32_t>();
    const auto nameSize = directory.take<uint16_t>(), extraSize = directory.take<uint16_t>(),
               commentSize = directory.take<uint16_t>();
    static_cast<void>(directory.take(4 * sizeof(uint16_t)));  // Disk, attributes.
    const auto offset = directory.take<uint32_t>();
    std::string_view name = directory.take(nameSize);
    static_cast<void>(directory.take(extraSize));
    const std::string_view kind = directory.take(commentSize);
    if (method != 0 || storedSize != size) failAtByte(headerAt, "a member of the zip archive is compressed");
    if (offset != next_) failAtByte(headerAt, "the members of the zip archive overlap or are out of order");
    if (!name.ends_with(".npy")) failAtByte(headerAt, fmt::format("member {} is not a .npy", quoted(name)));

    ZipCursor local(bytes_, offset, directoryAt_);
    local.requireSignature(kLocalSignature);
    static_cast<void>(local.take(kLocalSize - sizeof(kLocalSignature) - 2 * sizeof(uint16_t)));
    const auto localNameSize = local.take<uint16_t>(), localExtraSize = local.take<uint16_t>();
    if (local.take(localNameSize) != name) failAtByte(headerAt, "a member of the zip archive has two names");
    static_cast<void>(local.take(localExtraSize));
    const uint64_t dataAt = local.at();
    const std::string_view data = local.take(size);
    next_ = local.at();
    if (checksumOf(data) != checksum)
      failAtByte(dataAt, fmt::format("the checksum of member {} is wrong", quoted(name)));
    Field field = parseNpy(data, dataAt);
    name.remove_suffix(4);
    field.name = kind.starts_with(kRenamed) ? kind.substr(kRenamed.size()) : name;
    field.location = kind.starts_with("vertex") ? FieldLocation::PerVertex : FieldLocation::PerFace;
    return field;
  }

  std::span<const char> bytes_;
  uint32_t memberCount_ = 0;
  uint32_t directoryAt_ = 0;
  uint64_t next_ = 0;  ///< First byte of the next member.
};

/// Named; the other members are not set.
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
      throw Error(ErrorCode::OptionConflict, fmt::format("two fields need the member {} of a .npz", member.name));
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
    throw Error(ErrorCode::OutputNotWritable, "the fields exceed the 4 GiB or 65,535 members of a .npz; write .npy");
  for (size_t i = 0; i < members.size(); ++i) {
    const Field& field = result.fields()[i];
    const std::string header = npyHeader(field);
    uint32_t checksum = checksumOf(header);
    putNpyEntries(field, [&](std::span<const char> part) { checksum = checksumOf(part, checksum); });
    members[i].checksum = checksum;
    file.put(kLocalSignature);
    putCommonHeader(file, members[i]);
    file.write(members[i].name);
    file.write(header);
    putNpyEntries(field, [&](std::span<const char> part) { file.write(part.data(), part.size()); });
  }
  for (const ZipMember& member : members) putCentralHeader(file, member);
  file.put(kEndSignature);
  for (const size_t count : {size_t{0}, size_t{0}, members.size(), members.size()})
    file.put(static_cast<uint16_t>(count));  // Disks, then members.
  file.put(static_cast<uint32_t>(directorySize));
  file.put(static_cast<uint32_t>(offset));
  file.put(uint16_t{0});  // Comment.
}

Match detectNpz(std::span<const char> bytes) {  // Other formats are zip archives, too.
  const std::string_view text(bytes.data(), bytes.size());
  return text.starts_with("PK\x03\x04") || text.starts_with("PK\x05\x06") ? Match::Possible : Match::None;
}

std::vector<Field> parseNpzFields(std::span<const char> bytes) {
  std::vector<Field> fields = ZipReader(bytes).readFields();
  requireReadableNames(fields);
  return fields;
}

}  // namespace

extern const FileFormat kNpzFormat{
    .name = "npz", .extensions = {"npz"}, .detect = detectNpz, .parseFields = parseNpzFields, .write = writeNpz};

}  // namespace asdfvk

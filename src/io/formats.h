#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/field.h"
#include "asdf_vk/files.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

class AtomicFile;
class FilesBeside;
class ResultView;

/// Limits of faces, memory and unpacked bytes count at most this multiple of the size of a compressed file.
inline constexpr uint64_t kMaxUnpackRatio = 20;

/// The bytes of a mesh file, and what its reader may use.
struct MeshSource {
  std::span<const char> bytes;
  std::filesystem::path path = {};  ///< Its extension decides the format of an ambiguous content.
  ReadOptions options = {};
  uint64_t packedSize = 0;  ///< Size of the compressed file that has the bytes; 0 if the file has them directly.

  FilesBeside* beside = nullptr;  ///< Null for standard input and for bytes in memory.

  /// The size on which limits depend: the number of bytes with those of files beside, but for a compressed file at most
  /// kMaxUnpackRatio times the packed size.
  [[nodiscard]] uint64_t sizeForLimits() const;
  /// A limit that grows with this size.
  [[nodiscard]] uint64_t limit(uint64_t least, uint64_t perByte) const {
    return std::max(least, perByte * sizeForLimits());
  }

  /// The greatest number of faces that the reader may return.
  [[nodiscard]] uint64_t maxFaceCount() const;
};

/// Counts of faces and vertices saturate at this number, which is far above any limit.
inline constexpr uint64_t kSaturatedCount = uint64_t{1} << 50;

/// Throws Error{TooManyFaces} if faceCount is greater than source.maxFaceCount().
void requireFaceCount(uint64_t faceCount, const MeshSource& source);

/// How certainly the content has a format. The extension overrides Match::Possible; Match::Certain overrides the
/// extension.
enum class Match { None, Possible, Certain };

/// A file format, defined as kNAMEFormat in src/io/NAME_*.cpp. A function is null if the format does not have the
/// operation.
struct FileFormat {
  std::string_view name;                       ///< Lower case.
  std::array<std::string_view, 4> extensions;  ///< Lower case, without the dot; unused entries are empty.
  /// Null for a format that is only written.
  Match (*detect)(std::span<const char> bytes) = nullptr;

  /// Reads a mesh. Text may have LF, CRLF or CR line ends and a UTF-8 byte order mark. Polygons are triangulated and
  /// stored in Mesh::polygons (mesh/input_faces.h). Memory: at most 64 times the size of the input, plus a few MB.
  /// Throws Error{UnreadableInput} for a file that is truncated, has further bytes after its end, has an index out of
  /// range, or has no face with three corners; Error{MeshTooLarge} for a mesh beyond the limits of mesh/mesh.h. A
  /// format in which a small file can have many faces calls requireFaceCount() before it makes them.
  Mesh (*parseMesh)(const MeshSource& source) = nullptr;

  /// Writes a result by the rules of writeResult() (asdf_vk/files.h). The caller commits the file.
  void (*write)(AtomicFile& file, const ResultView& result) = nullptr;
  /// Writes the second file, at besidePathOf(). The first file refers to the second one by ResultView::besideName().
  /// Called if needsBeside(result) is true and the first file has a name. Null for a format of one file.
  void (*writeBeside)(AtomicFile& file, const ResultView& result) = nullptr;
  bool (*needsBeside)(const ResultView& result) = nullptr;
  bool writesDoubles = false;     ///< Real numbers of fields are double in the file, not float32.
  bool hasText = false;           ///< WriteOptions::ascii is possible.
  bool coloursByChoice = false;   ///< WriteOptions::coloursVertices is possible.
  bool holdsOneLocation = false;  ///< A file has either face fields or vertex fields.
};

/// The path of the second file of a result, for example "horse.obj.mtl" for "horse.obj".
[[nodiscard]] std::filesystem::path besidePathOf(const std::filesystem::path& path);

/// The formats are in the order of detection.
[[nodiscard]] std::span<const FileFormat* const> fileFormats();

/// extension: in upper or lower case, with or without the dot. Null if unknown.
[[nodiscard]] const FileFormat* formatOfExtension(std::string_view extension);

/// The name without the extension of gzip: "part.stl" for "part.stl.gz". Other names stay as they are.
[[nodiscard]] std::filesystem::path unpackedName(const std::filesystem::path& name);

/// The extension that names the format of a mesh: ".stl" for "part.stl" and for "part.stl.gz".
[[nodiscard]] std::string meshExtension(const std::filesystem::path& name);

/// The first format with Match::Certain, or null.
[[nodiscard]] const FileFormat* certainFormat(std::span<const char> bytes);

/// The format of the extension, else the first format with Match::Possible. Null if there is neither. Precondition:
/// certainFormat() is null.
[[nodiscard]] const FileFormat* uncertainFormat(std::span<const char> bytes, std::string_view extension);

/// certainFormat(), else uncertainFormat().
[[nodiscard]] const FileFormat* detectFormat(std::span<const char> bytes, std::string_view extension);

}  // namespace asdfvk

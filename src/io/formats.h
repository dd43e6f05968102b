#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/field.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

class AtomicFile;
class ResultView;

/// Whether the content of a file is of a format. Possible is weaker than the extension of the file, Certain is
/// stronger.
enum class Match { None, Possible, Certain };

/// A row of the table in formats.cpp. A function is null where the format lacks the operation.
struct FileFormat {
  std::string_view name;                       ///< Lower case.
  std::array<std::string_view, 4> extensions;  ///< Lower case, without the dot; unused entries are empty.
  Match (*detect)(std::span<const char> bytes);
  Mesh (*parseMesh)(std::span<const char> bytes);
  std::vector<Field> (*parseFields)(std::span<const char> bytes);
  void (*write)(AtomicFile& file, const ResultView& result);  ///< The caller commits the file.
};

[[nodiscard]] std::span<const FileFormat> fileFormats();

/// extension: in any case, with or without the dot. Null for an unknown one.
[[nodiscard]] const FileFormat* formatOfExtension(std::string_view extension);

/// The first format whose content matches with certainty, else that of the extension, else the first possible one, else
/// null.
[[nodiscard]] const FileFormat* detectFormat(std::span<const char> bytes, std::string_view extension);

/// "stl, ply or off", for messages: the formats that have the operation.
[[nodiscard]] std::string namesOfFormatsWith(bool (*hasOperation)(const FileFormat& format));

// Readers of meshes. Text may have LF, CRLF or CR line ends and a UTF-8 byte order mark. Each throws
// Error{UnreadableInput} for a file that is truncated, continues after its end, has an index out of range, or has no
// face with three corners. Memory: at most 64 times the size of the input and a few MB. A file with other faces than
// triangles fills Mesh::polygons, and is triangulated (triangulate.h).

/// ASCII STL, or binary STL, recognised by the exact size that its face count implies. Corners at the same point become
/// one vertex, in order of first appearance (-0 equals 0, NaN equals nothing).
[[nodiscard]] Match detectStl(std::span<const char> bytes);
[[nodiscard]] Mesh parseStl(std::span<const char> bytes);

/// PLY 1.0, ASCII and binary of either byte order. Required: element `vertex` with x, y, z of any numeric type, and
/// element `face` with the list vertex_indices or vertex_index, or `tristrips`, or both; in any order. Ignores all
/// other elements and properties. In ASCII each row begins on a new line.
[[nodiscard]] Match detectPly(std::span<const char> bytes);
[[nodiscard]] Mesh parsePly(std::span<const char> bytes);

/// ASCII OFF with the prefixes ST, C and N, or without the OFF line. One vertex per line; the numbers after its
/// coordinates must agree with the prefixes. Up to four colour numbers may follow a face.
[[nodiscard]] Match detectOff(std::span<const char> bytes);
[[nodiscard]] Mesh parseOff(std::span<const char> bytes);

/// OBJ: `v` and `f`. Ignores all other statements of the format except `call`, which is an error, as is an unknown one.
[[nodiscard]] Match detectObj(std::span<const char> bytes);
[[nodiscard]] Mesh parseObj(std::span<const char> bytes);

// Writers of results. See writeResult() of asdf_vk/files.h for the common rules.

/// Vertices with their fields, then faces: the list `uchar int vertex_indices` (`int int` above 255 corners), `float
/// quality` and its colour `uchar red green blue alpha`, then the other face fields: float, uchar or uint.
void writePly(AtomicFile& file, const ResultView& result);
/// Unstructured grid of VTK with inline base64: PointData and CellData of Float32, UInt8 and UInt32.
void writeVtu(AtomicFile& file, const ResultView& result);
/// The first field: version 1.0, shape (n,) or (n, 3), '<f4', '|u1' or '<u4'.
void writeNpy(AtomicFile& file, const ResultView& result);
/// A zip archive, not compressed: a member FIELD.npy per field, with "face" or "vertex" as its comment.
void writeNpz(AtomicFile& file, const ResultView& result);
/// Columns `face` and the face fields, or `vertex` and the vertex fields, with the shortest numbers that read back the
/// same. Fields of both kinds are an Error{OptionConflict}.
void writeCsv(AtomicFile& file, const ResultView& result);

// Readers of the fields of results. Each throws Error{UnreadableInput} for a file that is truncated or contradicts
// itself, and for fields with invalid or equal names.

/// The numbers of vertices and faces in files of any program: uchar as uint8, ushort and uint as uint32, others as
/// real.
[[nodiscard]] std::vector<Field> parsePlyFields(std::span<const char> bytes);
[[nodiscard]] Match detectVtu(std::span<const char> bytes);
[[nodiscard]] std::vector<Field> parseVtuFields(std::span<const char> bytes);
/// One face field named `values`: the format has neither names nor locations. Also reads '<f8'.
[[nodiscard]] Match detectNpy(std::span<const char> bytes);
[[nodiscard]] std::vector<Field> parseNpyFields(std::span<const char> bytes);
/// Members without a comment, as NumPy writes them, are face fields.
[[nodiscard]] Match detectNpz(std::span<const char> bytes);
[[nodiscard]] std::vector<Field> parseNpzFields(std::span<const char> bytes);
/// All fields are real.
[[nodiscard]] Match detectCsv(std::span<const char> bytes);
[[nodiscard]] std::vector<Field> parseCsvFields(std::span<const char> bytes);

}  // namespace asdfvk

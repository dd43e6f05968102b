#include "io/foreign_formats.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "core/text.h"
#include "io/text_scanner.h"

namespace asdfvk {
namespace {

constexpr std::string_view kExportRemedy = "export the mesh as STL, PLY, OBJ, 3MF or glTF";
constexpr std::string_view kUnpackRemedy = "unpack it";
constexpr std::string_view kPointCloudRemedy = "it has points and no faces; make a mesh of the points first";

struct ForeignFormat {
  std::string_view what;  ///< Completes "is ...".
  std::string_view remedy;
  std::string_view extensions;                  ///< Lower case, separated by blanks; may be empty.
  std::array<std::string_view, 2> magics = {};  ///< The first bytes of a file; unused entries are empty.
  /// The root element of an XML document, in lower case; empty for other formats.
  std::string_view element = {};
};

using namespace std::string_view_literals;  // Some of the first bytes are zero.
constexpr auto kForeignFormats = std::to_array<ForeignFormat>({
    {"compressed by xz",
     kUnpackRemedy,
     "xz",
     {"\xfd"
      "7zXZ\0"sv}},
    {"compressed by Zstandard", kUnpackRemedy, "zst", {"\x28\xb5\x2f\xfd"}},
    {"compressed by bzip2", kUnpackRemedy, "bz2", {"BZh"}},
    {"compressed by LZ4", kUnpackRemedy, "lz4", {"\x04\x22\x4d\x18"}},
    {"compressed by compress", kUnpackRemedy, "z", {"\x1f\x9d"}},
    {"a 7z archive", kUnpackRemedy, "7z", {"7z\xbc\xaf\x27\x1c"}},
    {"a RAR archive", kUnpackRemedy, "rar", {"Rar!\x1a\x07"}},
    {"a pointer of Git LFS, not the mesh", "run git lfs pull", "", {"version https://git-lfs"}},
    {"an HTML page, not a mesh", "download the file itself", "html htm", {}, "html"},
    {"an IGES file", kExportRemedy, "iges igs"},
    {"a Parasolid file", kExportRemedy, "x_t x_b", {"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "PS\0\0\0"sv}},
    {"an ACIS file", kExportRemedy, "sat sab", {"ACIS BinaryFile"}},
    {"a JT file", kExportRemedy, "jt"},
    {"a Rhino file", kExportRemedy, "3dm", {"3D Geometry File Format"}},
    {"an FBX file", kExportRemedy, "fbx", {"Kaydara FBX Binary", "; FBX "}},
    {"a Blender file", kExportRemedy, "blend", {"BLENDER"}},
    {"a DWG drawing", kExportRemedy, "dwg", {"AC10"}},
    {"a DXF drawing", kExportRemedy, "dxf", {"AutoCAD Binary DXF"}},
    {"an AMF file", kExportRemedy, "amf", {}, "amf"},
    {"an X3D file", kExportRemedy, "x3d", {}, "x3d"},
    {"a VRML file", kExportRemedy, "wrl vrml", {"#VRML", "#Inventor"}},
    {"a COLLADA file", kExportRemedy, "dae", {}, "collada"},
    {"a 3D Studio file", kExportRemedy, "3ds max"},
    {"a LightWave file", kExportRemedy, "lwo"},
    {"a USD file", kExportRemedy, "usd usda usdc usdz", {"#usda", "PXR-USDC"}},
    {"a CAD document",
     kExportRemedy,
     "sldprt sldasm ipt iam prt asm catpart catproduct par f3d skp fcstd",
     {"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"}},
    {"a VTK file", kExportRemedy, "vtk vtp vtkhdf", {"# vtk DataFile"}},
    {"a Gmsh file", kExportRemedy, "msh", {"$MeshFormat"}},
    {"a mesh compressed by Draco", kExportRemedy, "drc", {"DRACO"}},
    {"a PCD file", kPointCloudRemedy, "pcd", {"# .PCD", "VERSION .7"}},
    {"a LAS file", kPointCloudRemedy, "las laz", {"LASF"}},
    {"an E57 file", kPointCloudRemedy, "e57", {"ASTM-E57"}},
    {"a PDF document", kExportRemedy, "pdf", {"%PDF-"}},
    {"an image, not a mesh", kExportRemedy, "png jpg jpeg svg", {"\x89PNG", "\xff\xd8\xff"}, "svg"},
});

/// The text from `at` on; empty beyond its end.
std::string_view partFrom(std::string_view text, size_t at) { return text.substr(std::min(at, text.size())); }

std::string reasonOf(const ForeignFormat& format) { return fmt::format("is {}; {}", format.what, format.remedy); }

/// The name of the root element of an XML document or HTML page in lower case; empty for other texts.
std::string rootElement(std::string_view text) {
  constexpr size_t kMaxProlog = 1 << 16;
  text = text.substr(0, kMaxProlog);
  for (size_t at = text.find_first_not_of(" \t\r\n"); at < text.size() && text[at] == '<';) {
    const std::string_view tag = text.substr(at);
    const bool isComment = tag.starts_with("<!--");
    if (lowerCase(tag.substr(0, 14)) == "<!doctype html") return "html";
    if (!isComment && !tag.starts_with("<?") && !tag.starts_with("<!"))
      return lowerCase(tag.substr(1, std::min(tag.find_first_of(" \t\r\n/>"), tag.size()) - 1));
    const size_t end = tag.find(isComment ? "-->" : ">");
    if (end == std::string_view::npos) return {};
    at = text.find_first_not_of(" \t\r\n", at + end + (isComment ? 3 : 1));
  }
  return {};
}

bool isIges(std::string_view text) {
  constexpr size_t kSectionColumn = 72;
  const std::string_view section = partFrom(text, kSectionColumn).substr(0, 8);
  return section == "S      1" || section == "S0000001";
}

bool isDxf(std::span<const char> bytes) {
  if (bytes.empty() || (bytes[0] != ' ' && bytes[0] != '0')) return false;
  TextScanner text(bytes.first(std::min<size_t>(bytes.size(), 64)));
  return !text.atEnd() && text.wordOnLine() == "0" && !text.atEnd() && text.wordOnLine() == "SECTION";
}

bool is3ds(std::string_view text) {
  uint32_t size = 0;
  if (!text.starts_with("MM") || text.size() < 2 + sizeof size) return false;
  std::memcpy(&size, text.data() + 2, sizeof size);
  return size == text.size();
}

bool lacksByteOrderMark(std::string_view text) {
  constexpr size_t kTestedCount = 16;
  if (text.size() < kTestedCount) return false;
  const auto isWide = [&](size_t zero) {
    for (size_t i = 0; i < kTestedCount; ++i)
      if ((text[i] == '\0') != (i % 2 == zero)) return false;
    return true;
  };
  return isWide(0) || isWide(1);
}

std::string formatWithoutMagic(std::span<const char> bytes, std::string_view text) {
  constexpr size_t kTarMagicOffset = 257;
  if (partFrom(text, kTarMagicOffset).starts_with("ustar")) return "is a tar archive; unpack it";
  if (isIges(text)) return foreignExtension("iges");
  if (isDxf(bytes)) return foreignExtension("dxf");
  if (is3ds(text)) return foreignExtension("3ds");
  if (text.starts_with("FORM") && partFrom(text, 8).starts_with("LWO")) return foreignExtension("lwo");
  if (lacksByteOrderMark(text)) return "is a text in UTF-16 without a byte order mark; save it as UTF-8";
  if (text.find_first_not_of('\0') == std::string_view::npos)
    return "has only zero bytes, because it was not copied completely; copy or download it again";
  const std::string_view first = firstWord(bytes).substr(0, 1);
  if ((first == "{" || first == "[") && text.find("\"asset\"") == std::string_view::npos)
    return fmt::format("is JSON, but not glTF; {}", kExportRemedy);
  return {};
}

}  // namespace

std::string foreignContent(std::span<const char> bytes) {
  const std::string_view text = withoutByteOrderMark({bytes.data(), bytes.size()});
  const std::string element = rootElement(text);
  for (const ForeignFormat& format : kForeignFormats) {
    if (!element.empty() && element == format.element) return reasonOf(format);
    for (const std::string_view magic : format.magics)
      if (!magic.empty() && text.starts_with(magic)) return reasonOf(format);
  }
  return formatWithoutMagic(bytes, text);
}

std::string foreignExtension(std::string_view extension) {
  if (extension.starts_with('.')) extension.remove_prefix(1);
  const std::string lower = lowerCase(extension);
  for (const ForeignFormat& format : kForeignFormats) {
    const std::vector<std::string> extensions = splitAt(format.extensions, ' ');
    if (std::find(extensions.begin(), extensions.end(), lower) != extensions.end()) return reasonOf(format);
  }
  return {};
}

}  // namespace asdfvk

// Files that are compressed by gzip, texts in UTF-16, and formats without a reader.
#include <doctest/doctest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "io/gzip_file.h"
#include "reading.h"
#include "written_file.h"

using namespace asdfvk;
using asdfvk::test::holds;

namespace {

/// The text as one member of a gzip file.
std::string errorOfContent(std::string_view bytes, std::string_view extension = {}) {
  try {
    static_cast<void>(parseMesh(bytes, {.format = std::string(extension)}));
  } catch (const Error& error) {
    return error.kind() == ErrorKind::Input ? error.what() : "an error of another kind";
  }
  return "no error";
}

std::string binaryTriangle(std::string_view header) {
  std::string bytes(header);
  bytes.resize(84 + 50, '\0');
  bytes[80] = 1;
  const float one = 1;
  std::memcpy(bytes.data() + 84 + 24, &one, sizeof one);
  std::memcpy(bytes.data() + 84 + 40, &one, sizeof one);
  return bytes;
}

const std::string kContentObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kContentOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kContentPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kContentStl =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

const std::vector<Face> kOneFace{{0, 1, 2}};

}  // namespace

TEST_CASE("meshes of every format are read from gzip files, by content and by the extension before .gz") {
  const Folder folder;
  for (const auto& [name, text] : {std::pair<const char*, std::string>{"mesh.obj.gz", kContentObj},
                                   {"mesh.OFF.GZ", kContentOff},
                                   {"mesh.ply.gz", kContentPly},
                                   {"mesh.stl.gz", kContentStl},
                                   {"mesh.gz", binaryTriangle("binary")},
                                   {"counts.off.gz", kContentOff.substr(4)}}) {
    const std::string shown = name;  // Clang 14 captures no structured binding.
    CAPTURE(shown);
    std::ofstream(folder / name, std::ios::binary) << test::gzipped(text);
    CHECK(readMesh(folder / name).faces == kOneFace);
  }
  // Without the keyword, only the extension says that the content is OFF.
  const std::string counts = test::gzipped(kContentOff.substr(4));
  for (const char* extension : {"off.gz", ".off.gz", "OFF.GZ", "off"})
    CHECK(parseMesh(counts, {.format = extension}).faces == kOneFace);
  CHECK(holds(errorOfContent(counts, "gz"), "unknown format"));
  CHECK(meshExtension("a/part.stl.gz") == ".stl");
  CHECK(meshExtension("a/part.STL") == ".STL");
  CHECK(meshExtension("a.stl/part").empty());
}

TEST_CASE("a gzip file may have several members and zero bytes after them") {
  const std::string packed =
      test::gzipped(kContentObj.substr(0, 10)) + test::gzipped("") + test::gzipped(kContentObj.substr(10));
  CHECK(parseMesh(packed).faces == kOneFace);
  CHECK(parseMesh(packed + std::string(512, '\0')).faces == kOneFace);
  CHECK(errorOfContent(packed + "rubbish") == "is compressed by gzip and continues with 7 bytes after its end");
  std::string text = kContentObj;
  for (int i = 0; i < 100'000; ++i) text += "f 1 2 3\n";
  CHECK(parseMesh(test::gzipped(text)).faces.size() == 100'001);
}

TEST_CASE("a gzip file that is damaged, truncated, empty or packed twice is refused") {
  const std::string packed = test::gzipped(kContentObj);
  for (size_t size = 18; size < packed.size(); ++size)
    CHECK(errorOfContent(packed.substr(0, size)) == "is compressed by gzip and truncated; copy or download it again");
  for (const size_t fromEnd : {1, 5, 12}) {  // The size, the checksum and the data.
    std::string damaged = packed;
    damaged[damaged.size() - fromEnd] ^= 1;
    CHECK(holds(errorOfContent(damaged), "is compressed by gzip and "));
  }
  CHECK(errorOfContent(test::gzipped("")) == "is compressed by gzip and has no content");
  CHECK(errorOfContent(test::gzipped(packed)) == "is compressed by gzip more than once; unpack it first");
}

TEST_CASE("a gzip file with more content than the limit is refused, and limits of faces depend on the content") {
  CHECK(maxUnpackedSize(1) == uint64_t{1} << 30);
  CHECK(maxUnpackedSize(uint64_t{1} << 30) == 20 * (uint64_t{1} << 30));
  // Each member unpacks to 64 MiB.
  const std::string member = test::gzipped(std::string(64 << 20, ' '));
  std::string bomb;
  for (int i = 0; i < 17; ++i) bomb += member;
  try {
    static_cast<void>(parseMesh(bomb));
    FAIL_CHECK("no error");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::InputTooLarge);
    CHECK(holds(error.what(), "its content exceeds the limit of 1024 MiB"));
  }
  const std::string content(5000, ' ');
  const std::span<const char> bytes(content);
  CHECK(MeshSource{.bytes = bytes}.sizeForLimits() == 5000);
  CHECK(MeshSource{.bytes = bytes, .packedSize = 1000}.sizeForLimits() == 5000);
  CHECK(MeshSource{.bytes = bytes, .packedSize = 10}.sizeForLimits() == 200);
}

TEST_CASE("texts in UTF-16 with a byte order mark are read") {
  for (const bool isBig : {false, true})
    for (const std::string& text :
         {kContentObj, kContentOff, kContentPly, kContentStl, "# comment\ng ply\n" + kContentObj}) {
      CHECK(parseMesh(test::utf16(text, isBig)).faces == kOneFace);
      CHECK(parseMesh(test::gzipped(test::utf16(text, isBig))).faces == kOneFace);
      CHECK(holds(errorOfContent(test::utf16(text, isBig) + "x"), "UTF-16 with an odd number of bytes"));
      CHECK(holds(errorOfContent(test::utf16(text, isBig).substr(2)),
                  "UTF-16 without a byte order mark; save it as UTF-8"));
    }
  // A name with characters of two, three and four bytes in UTF-8, and an unpaired surrogate.
  const std::string name("\x00\xe4\x20\xac\xd8\x3d\xde\x00\xd8\x00\x00\n", 12);
  std::string obj = test::utf16("o ", true) + name + test::utf16(kContentObj, true).substr(2);
  CHECK(parseMesh(obj).faces == kOneFace);
  obj.replace(obj.find('o'), 1, "w");
  CHECK(holds(errorOfContent(obj, "obj"), "line 1: 'w' is not an OBJ keyword"));
}

TEST_CASE("a binary STL may begin as any other file does") {
  for (const char* header : {"\xff\xfe", "\xff\xfes\x01o\x01l\x01", "\x1f\x8b\x08", "BLENDER", "<html>",
                             "Kaydara FBX Binary", "; FBX 7", "PK\x03\x04", "version https://git-lfs"})
    CHECK(parseMesh(binaryTriangle(header)).faces.size() == 1);
}

TEST_CASE("files of formats without a reader are refused with the format and a remedy") {
  const auto refused = [](std::string_view bytes, std::string_view reason, std::string_view extension = "stl") {
    CAPTURE(bytes);
    CHECK(holds(errorOfContent(bytes, extension), reason));
  };
  using namespace std::string_view_literals;
  refused(
      "\xfd"
      "7zXZ\0..."sv,
      "is compressed by xz; unpack it");
  refused("\x28\xb5\x2f\xfd....", "is compressed by Zstandard; unpack it");
  refused("BZh91AY&SY", "is compressed by bzip2; unpack it");
  refused("7z\xbc\xaf\x27\x1c", "is a 7z archive; unpack it");
  refused("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n",
          "is a pointer of Git LFS, not the mesh; run git lfs pull");
  for (const char* page :
       {"<html><body>", "<!DOCTYPE html>\n<html>", "\n <!-- saved --> <!doctype HTML><html>", "<HTML lang=en>"})
    refused(page, "is an HTML page, not a mesh; download the file itself");
  refused(std::string(72, ' ') + "S      1\n", "is an IGES file; export the mesh as STL, PLY, OBJ, 3MF or glTF");
  refused("; FBX 7.4.0 project file\n", "is an FBX file");
  refused("Kaydara FBX Binary  \0"sv, "is an FBX file");
  refused("BLENDER-v280", "is a Blender file");
  refused("AC1032....", "is a DWG drawing");
  refused("  0\r\nSECTION\r\n  2\r\n", "is a DXF drawing");
  refused("#VRML V2.0 utf8\n", "is a VRML file", "obj");
  refused("<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", "is a COLLADA file");
  refused("<?xml version=\"1.0\"?>\n<!DOCTYPE X3D PUBLIC \"\">\n<X3D>", "is an X3D file");
  refused("<amf unit=\"inch\">", "is an AMF file");
  refused("MM\x0a\0\0\0\0\0\0\0"sv, "is a 3D Studio file");
  refused("# .PCD v.7", "is a PCD file; it has points and no faces", "obj");
  refused("FORM....LWO2", "is a LightWave file");
  refused("FORM", "has at least 84 bytes");
  refused("{\"a\": 1}", "is JSON, but not glTF", "json");
  refused("[1, 2]", "is JSON, but not glTF", "");
  refused(std::string(257, 'a') + "ustar", "is a tar archive; unpack it");
  refused(std::string(600, '\0'), "has only zero bytes", "ply");
  refused("", "is empty");
  refused("rubbish", "is a Rhino file; export", "3dm");
  refused("rubbish", "is a Parasolid file; export", "X_T");
  refused(test::gzipped("BLENDER-v280...."), "is a Blender file");
  refused("rubbish", "has an unknown format; meshes are read from", "txt");
}

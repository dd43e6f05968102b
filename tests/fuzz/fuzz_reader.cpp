// The harness of the reader of ASDFVK_FORMAT, or of parseMesh() for "gz". It requires that the reader either throws
// Error of kind Input with one line, or returns a mesh whose arrays fit together; and that its memory never exceeds 64
// times the input plus 256 KiB, or 128 MiB more for formats with instances. For "gz" the input counts with its greatest
// unpacked size. A model of 3MF may also be given without its archive. For "gltf" the document ends before the first
// zero byte, and the bytes after it are the file data.bin beside it.
#include <sanitizer/allocator_interface.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include "asdf_vk/error.h"
#include "io/files_beside.h"
#include "io/formats.h"
#include "stored_archive.h"

namespace asdfvk {
namespace {

constexpr int64_t kMaxBytesPerInputByte = 64;
constexpr int64_t kGreatestDeflateRatio = 1032;
constexpr int64_t kAllowance = 256 << 10;
constexpr int64_t kInstanceAllowance = 128 << 20;

std::atomic<bool> isCounting = false;
std::atomic<int64_t> liveBytes = 0;
std::atomic<int64_t> peakBytes = 0;

void onMalloc(const volatile void*, size_t size) {
  if (!isCounting) return;
  const int64_t live = liveBytes += static_cast<int64_t>(size);
  if (live > peakBytes) peakBytes = live;
}

void onFree(const volatile void* pointer) {
  if (isCounting && pointer != nullptr)
    liveBytes -= static_cast<int64_t>(__sanitizer_get_allocated_size(const_cast<const void*>(pointer)));
}

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "FINDING: %s\n", what);
  std::abort();
}

void requireSound(const Mesh& mesh) {
  require(!mesh.faces.empty(), "a mesh without faces was returned");
  for (const Face& face : mesh.faces)
    for (const uint32_t corner : face) require(corner < mesh.vertices.size(), "a face names no vertex");
  const Polygons& polygons = mesh.polygons;
  if (polygons.isEmpty()) {
    require(polygons.corners.empty() && polygons.inputFaceOf.empty(), "polygons are half set");
    return;
  }
  require(polygons.firstCorner.front() == 0, "the first polygon does not begin with the first corner");
  require(polygons.firstCorner.back() == polygons.corners.size(), "the polygons do not end with the last corner");
  require(polygons.inputFaceOf.size() == mesh.faces.size(), "not every triangle has its input face");
  for (const uint32_t corner : polygons.corners) require(corner < mesh.vertices.size(), "a polygon names no vertex");
  size_t triangle = 0;
  for (size_t i = 0; i + 1 < polygons.firstCorner.size(); ++i) {
    require(polygons.firstCorner[i] <= polygons.firstCorner[i + 1], "a polygon ends before it begins");
    const size_t cornerCount = polygons.firstCorner[i + 1] - polygons.firstCorner[i];
    for (size_t t = 2; t < cornerCount; ++t, ++triangle)
      require(triangle < mesh.faces.size() && polygons.inputFaceOf[triangle] == i, "a polygon lost a triangle");
  }
  require(triangle == mesh.faces.size(), "a triangle belongs to no polygon");
}

/// A folder of this process with the file beside.
class FolderWithData {
 public:
  FolderWithData() : path_(std::filesystem::temp_directory_path() / ("asdf-vk-fuzz-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~FolderWithData() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FolderWithData(const FolderWithData&) = delete;
  FolderWithData& operator=(const FolderWithData&) = delete;

  [[nodiscard]] std::string document() const { return path_ / "mesh.gltf"; }
  void write(std::string_view data) const {
    std::ofstream(path_ / "data.bin", std::ios::binary).write(data.data(), static_cast<std::streamsize>(data.size()));
  }

 private:
  std::filesystem::path path_;
};

/// The mesh of a document with a file beside.
Mesh parseWithFile(const FileFormat& format, std::span<const char> bytes) {
  static const FolderWithData folder;
  const size_t end = std::string_view(bytes.data(), bytes.size()).find('\0');
  if (end == std::string_view::npos) return format.parseMesh({.bytes = bytes});
  folder.write({bytes.data() + end + 1, bytes.size() - end - 1});
  FilesBeside beside(folder.document(), [](std::span<const char>) {});
  return format.parseMesh({.bytes = bytes.first(end), .path = folder.document(), .beside = &beside});
}

/// format: null for parseMesh().
int readOnce(const FileFormat* format, const uint8_t* data, size_t size, bool hasFile = false) {
  static const int isInstalled = __sanitizer_install_malloc_and_free_hooks(onMalloc, onFree);
  require(isInstalled != 0, "the allocation hooks could not be installed");
  liveBytes = 0;
  peakBytes = 0;
  isCounting = true;
  try {
    const std::span bytes(reinterpret_cast<const char*>(data), size);
    static_cast<void>(detectFormat(bytes, ""));
    const Mesh mesh = format == nullptr ? parseMesh(bytes)
                      : hasFile         ? parseWithFile(*format, bytes)
                                        : format->parseMesh({.bytes = bytes});
    isCounting = false;
    requireSound(mesh);
  } catch (const Error& error) {
    isCounting = false;
    require(error.kind() == ErrorKind::Input, "an error of another kind than Input");
    const std::string_view message = error.what();
    require(!message.empty(), "an error without a message");
    require(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }),
            "a message that is not one printable line");
  }
  const bool hasInstances = format == nullptr || format->name == "glb" || format->name == "3mf";
  const int64_t byteCount = static_cast<int64_t>(size) * (format == nullptr ? kGreatestDeflateRatio : 1);
  require(peakBytes <= kMaxBytesPerInputByte * byteCount + kAllowance + (hasInstances ? kInstanceAllowance : 0),
          "more memory than 64 times the input");
  return 0;
}

}  // namespace
}  // namespace asdfvk

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const asdfvk::FileFormat* const format = asdfvk::formatOfExtension(ASDFVK_FORMAT);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (format != nullptr && format->name == "3mf" && !text.starts_with("PK")) {
    const std::string archive = asdfvk::storedArchive(text);
    return asdfvk::readOnce(format, reinterpret_cast<const uint8_t*>(archive.data()), archive.size());
  }
  return asdfvk::readOnce(format, data, size, std::string_view(ASDFVK_FORMAT) == "gltf");
}

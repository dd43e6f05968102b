#include "io/result_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "core/text.h"
#include "io/result_formats.h"

namespace asdfvk {
namespace {

constexpr std::array<std::string_view, 4> kFormats{"ply", "vtu", "npy", "csv"};

std::string findFormat(std::string_view name) {
  if (name.starts_with('.')) name.remove_prefix(1);
  const std::string lower = lowerCase(name);
  return std::find(kFormats.begin(), kFormats.end(), lower) == kFormats.end() ? std::string() : lower;
}

}  // namespace

std::vector<std::string> resultFormats() { return {kFormats.begin(), kFormats.end()}; }

std::string resultFormatOf(const std::filesystem::path& path, const WriteOptions& options) {
  if (!options.format.empty()) return options.format;
  if (path == "-") throw Error(ErrorCode::UnknownFormat, "standard output has no extension that names a format");
  if (const std::string format = findFormat(path.extension().string()); !format.empty()) return format;
  throw Error(ErrorCode::UnknownFormat, fmt::format("the extension of {} is not that of a result format", path.string()));
}

bool verticesAreFloats(const TriangleMesh& mesh) {
  const auto isFloat = [](double c) { return !std::isfinite(c) || static_cast<double>(static_cast<float>(c)) == c; };
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [&](const Vec3d& p) { return isFloat(p.x) && isFloat(p.y) && isFloat(p.z); });
}

void writeResult(const std::filesystem::path& path, const MeshView& view, std::span<const Field> fields,
                 const WriteOptions& options) {
  const std::string format = resultFormatOf(path, options);
  const TriangleMesh mesh = *view.mesh();
  const FaceValues face{std::get<0>(fields[0].values), std::get<1>(fields[1].values)};
  AtomicFile file(path);
  if (format == "ply") writePly(file, mesh, face, options.ascii);
  if (format == "vtu") writeVtu(file, mesh, face);
  if (format == "npy") writeNpy(file, face);
  if (format == "csv") writeCsv(file, face);
  file.commit();
}

}  // namespace asdfvk

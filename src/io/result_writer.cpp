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

constexpr std::array<std::pair<std::string_view, ResultFormat>, 4> kFormats{
    {{"ply", ResultFormat::Ply}, {"vtu", ResultFormat::Vtu}, {"npy", ResultFormat::Npy}, {"csv", ResultFormat::Csv}}};

std::optional<ResultFormat> findFormat(std::string_view name) {
  if (name.starts_with('.')) name.remove_prefix(1);
  const std::string lower = lowerCase(name);
  for (const auto& [known, format] : kFormats)
    if (known == lower) return format;
  return std::nullopt;
}

}  // namespace

ResultFormat resultFormatNamed(std::string_view name) {
  if (const auto format = findFormat(name)) return *format;
  throw Error(ErrorCode::UnknownFormat,
              fmt::format("no result format is called '{}'; there are ply, vtu, npy and csv", name));
}

ResultFormat resultFormatOf(const std::filesystem::path& path, const WriteOptions& options) {
  if (options.format) return *options.format;
  if (path == "-")
    throw Error(ErrorCode::UnknownFormat, "standard output has no extension; give the format: ply, vtu, npy or csv");
  if (const auto format = findFormat(path.extension().string())) return *format;
  throw Error(ErrorCode::UnknownFormat,
              fmt::format("the extension of {} tells no format; use .ply, .vtu, .npy or .csv", path.string()));
}

bool verticesAreFloats(const TriangleMesh& mesh) {
  const auto isFloat = [](double c) { return !std::isfinite(c) || static_cast<double>(static_cast<float>(c)) == c; };
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [&](const Vec3d& p) { return isFloat(p.x) && isFloat(p.y) && isFloat(p.z); });
}

void writeResult(const std::filesystem::path& path, const TriangleMesh& mesh, const FaceValues& face,
                 const WriteOptions& options) {
  const ResultFormat format = resultFormatOf(path, options);
  ASDFVK_CHECK_OP(face.values.size(), ==, mesh.inputFaceCount());
  ASDFVK_CHECK_OP(face.isSeed.size(), ==, mesh.inputFaceCount());
  AtomicFile file(path);
  switch (format) {
    case ResultFormat::Ply:
      writePly(file, mesh, face, options.ascii);
      break;
    case ResultFormat::Vtu:
      writeVtu(file, mesh, face);
      break;
    case ResultFormat::Npy:
      writeNpy(file, face);
      break;
    case ResultFormat::Csv:
      writeCsv(file, face);
      break;
  }
  file.commit();
}

}  // namespace asdfvk

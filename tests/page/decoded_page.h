#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "page/page.h"

/// Reads pages as docs/page-format.md describes them, and shares no code with src/page.
namespace asdfvk::test {

struct DecodedMesh {
  nlohmann::ordered_json description;
  std::vector<Vec3d> positions;  ///< In mesh units.
  std::vector<Face> faces;
  std::vector<uint32_t> faceIds;
  std::map<std::string, std::vector<double>> fields;  ///< Per face; NaN = no value.
  std::vector<DecodedMesh> thinSurface;               ///< One where something is thinner than a limit.
};

struct DecodedPage {
  std::string html;
  nlohmann::ordered_json json;
  std::vector<std::vector<uint8_t>> arrays;  ///< Inflated.
  std::vector<DecodedMesh> meshes;
};

/// The file that the page writes.
[[nodiscard]] std::string htmlOf(const Page& page);

/// Throws where the page does not follow the format.
[[nodiscard]] DecodedPage decodePage(const std::string& html);

}  // namespace asdfvk::test

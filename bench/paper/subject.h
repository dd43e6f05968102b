#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "render/view.h"

namespace asdfvk::bench {

/// A mesh that the evaluation is about.
struct Subject {
  std::string name;  ///< Letters, digits, "-", "_" and "." only, one of its kind: part of file names.
  Mesh mesh;
  View view = {};  ///< To draw it from.
};

/// Reads all of them, so that an unreadable one is told before anything is computed. Throws Error{Input}.
[[nodiscard]] std::vector<Subject> readSubjects(const std::vector<std::string>& paths);

/// The generator's creatures with about that many faces each.
[[nodiscard]] std::vector<Subject> generateSubjects(uint64_t faceCount);

}  // namespace asdfvk::bench

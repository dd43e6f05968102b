#include "paper/subject.h"

#include "generate/shapes.h"
#include "io/mesh_reader.h"
#include "paper/plots/file_stems.h"

namespace asdfvk::bench {

std::vector<Subject> readSubjects(const std::vector<std::string>& paths) {
  const std::vector<std::string> stems = uniqueStems(paths);
  std::vector<Subject> subjects;
  for (size_t i = 0; i < paths.size(); ++i) subjects.push_back({stems[i], readMesh(paths[i])});
  return subjects;
}

std::vector<Subject> generateSubjects(uint64_t faceCount) {
  std::vector<Subject> subjects;
  for (const char* shape : {"animal", "hand", "figure"})
    subjects.push_back({shape, generateShape(shape, faceCount).mesh, {.up = Up::Z}});
  return subjects;
}

}  // namespace asdfvk::bench

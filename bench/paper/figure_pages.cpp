#include "paper/figure_pages.h"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "core/text.h"

namespace asdfvk::bench {

void FigurePages::add(int figure, const NamedMesh& mesh, const Result& result, const std::string& label) {
  std::vector<std::reference_wrapper<const Field>> fields;
  for (const char* name : {"sdf", "seed", "error"})
    if (const Field* field = result.field(name)) fields.emplace_back(*field);
  PageTexts texts{.name = mesh.name, .label = label};
  texts.report.summary = {{"Faces", groupDigits(result.report.faceCount)},
                          {"Seeds", groupDigits(result.report.seedCount)}};
  const auto page = pages_.try_emplace(figure, fmt::format("asdf-vk {}", ASDFVK_VERSION)).first;
  page->second.add(mesh.scene->scene.mesh, fields, std::move(texts));
}

void FigurePages::write(const OutputFolder& folder) const {
  for (const auto& [figure, page] : pages_) folder.write(fmt::format("figure{}.html", figure), page);
}

}  // namespace asdfvk::bench

#include "page/result_page.h"

#include <algorithm>
#include <utility>

#include "asdf_vk/version.h"
#include "core/atomic_file.h"
#include "render/camera.h"
#include "trace/scene_data.h"

namespace asdfvk {
namespace {

/// The segments; empty if the page does not show the field "segment".
std::vector<PageSegment> segmentsOf(const Result& result, FieldSpan shown) {
  const auto segment =
      std::find_if(shown.begin(), shown.end(), [](const Field& field) { return field.name == "segment"; });
  const auto* const labels =
      segment == shown.end() ? nullptr : std::get_if<std::vector<uint32_t>>(&segment->get().values);
  if (labels == nullptr) return {};
  const TraceScene& scene = result.scene->scene;
  const Field* const sdf = result.field("sdf");
  const std::vector<double> none(labels->size(), kNoValue);
  return listSegments(scene.mesh, scene.geometry.areas, scene.geometry.barycentres, *labels,
                      sdf != nullptr && sdf->reals() != nullptr ? *sdf->reals() : none);
}

}  // namespace

Page emptyPage() { return Page(std::string("asdf-vk ") + ASDFVK_VERSION + " (" + ASDFVK_COMMIT + ")"); }

void writePage(const std::filesystem::path& path, const Page& page) {
  AtomicFiles files;
  writePage(files, path, page);
  files.commit();
}

void writePage(AtomicFiles& files, const std::filesystem::path& path, const Page& page) {
  files.write(path, [&](AtomicFile& file) { page.write(file); });
}

void addResult(Page& page, PageTexts texts, const Result& result, FieldSpan fields, const View& view) {
  if (std::optional<ShownPlaces> shown = shownPlaces(result.report))
    texts.thin = {.shown = *std::move(shown), .surface = result.thinSurface};
  texts.least = leastPlace(result.report);
  texts.up = view.up ? nameOf(kUps, *view.up) : "auto";
  texts.azimuthDegrees = view.azimuthDegrees;
  texts.elevationDegrees = view.elevationDegrees;
  texts.segments = segmentsOf(result, fields);
  page.add(result.scene->scene.mesh, fields, std::move(texts));
}

}  // namespace asdfvk

#include "paper/gallery.h"
#include "core/text.h"

#include <fmt/format.h>

#include "cli/report_text.h"
#include "paper/evaluation.h"
#include "paper/paper_numbers.h"

namespace asdfvk::bench {

void addGallery(Page& page, const Studio& studio, Session& session, std::vector<Subject>& subjects,
                const RunControl& control) {
  std::vector<PageImage> images;
  for (Subject& subject : subjects) {
    const Result result = session.compute(subject.mesh, recipeOptions(Recipe::Balanced, kTeaserPercent, 1), control);
    images.push_back(
        studio.field("figure8-" + subject.name, subject, result.sdf, {"SDF", percentileRange(result.sdf)},
                     fmt::format("{}, {} faces, {} seeds", subject.name, groupDigits(result.report.faceCount),
                                 groupDigits(result.report.seedCount))));
  }
  page.figure(images, 3, "Figure 8",
              fmt::format("The balanced recipe at {:g} % of the faces, applied to different meshes; each has a colour "
                          "scale of its own, in its unit of length.",
                          kTeaserPercent));
}

}  // namespace asdfvk::bench

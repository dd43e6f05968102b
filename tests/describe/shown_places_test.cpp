#include "describe/shown_places.h"

#include <doctest/doctest.h>

namespace asdfvk {
namespace {

ThicknessReport measured(ThicknessVerdict verdict, double min, uint64_t face) {
  ThicknessReport report;
  report.verdict = verdict;
  report.min = min;
  report.minFace = face;
  report.minPlace = {1, 0, 0};
  report.minOpposite = {1, 0, min};
  return report;
}

TEST_CASE("the least place is that of the thickness, also if nothing is too thin") {
  Report report;
  CHECK_FALSE(leastPlace(report));
  report.thickness = measured(ThicknessVerdict::Passed, 2, 7);
  const std::optional<LeastPlace> least = leastPlace(report);
  REQUIRE(least);
  CHECK_EQ(std::string(least->kind), "wall");
  CHECK_EQ(least->value, 2);
  CHECK_EQ(least->face, 7);
  CHECK(least->opposite == Vec3d{1, 0, 2});
}

TEST_CASE("the least place is that of the comparison that failed, with the kind of its region") {
  Report report;
  report.thickness = measured(ThicknessVerdict::Passed, 2, 7);
  report.gap = measured(ThicknessVerdict::Failed, 0.1, 3);
  report.gap->isOfGaps = true;
  CHECK_EQ(std::string(leastPlace(report)->kind), "gap");
  CHECK_EQ(leastPlace(report)->value, 0.1);
  report.thickness = measured(ThicknessVerdict::Failed, 0.5, 7);
  ThinRegion region;
  region.kind = ThinKind::Detail;
  region.min = 0.5;
  region.minFace = 7;
  report.thickness->regions = {region};
  CHECK_EQ(std::string(leastPlace(report)->kind), "detail");
}

}  // namespace
}  // namespace asdfvk

#include "bindings.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "arrays.h"
#include "asdf_vk/cgal.h"
#include "asdf_vk/run_control.h"
#include "interruptible.h"
#include "options.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

py::tuple postprocess(const py::object& mesh, const py::array& values, uint32_t threadCount,
                      const py::object& progress) {
  requireSameProcess();
  const MeshView view = viewOf(mesh);
  const std::span<const double> numbers = entriesOf<double>(values);
  PostprocessedSdf result;
  runInterruptibly(
      [&](const RunControl& control) {
        const ThreadLimit limit(threadCount);
        result = postprocessSdf(view, numbers, control);
      },
      progress);
  return py::make_tuple(asArray(std::move(result.normalized)), result.min, result.max);
}

py::tuple segment(const py::object& mesh, const py::array& values, const py::dict& options, bool returnsClusters,
                  uint32_t threadCount, const py::object& progress) {
  requireSameProcess();
  const MeshView view = viewOf(mesh);
  const CgalSegmentationOptions parsed = optionsOf(options)->cgalSegmentation;
  const CgalLabels kind = returnsClusters ? CgalLabels::Clusters : CgalLabels::Segments;
  const std::span<const double> numbers = entriesOf<double>(values);
  LabelledFaces result;
  runInterruptibly(
      [&](const RunControl& control) {
        const ThreadLimit limit(threadCount);
        result = segmentSdf(view, numbers, parsed, kind, control);
      },
      progress);
  // In int32, kNoSegment is -1.
  return py::make_tuple(asArray(std::vector<int32_t>(result.labels.begin(), result.labels.end())), result.count);
}

}  // namespace

void bindCgal(py::module_& module) {
  module.def("postprocess_sdf", postprocess);
  module.def("segment_sdf", segment);
}

}  // namespace asdfvk::python

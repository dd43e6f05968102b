#include "arrays.h"

#include <string>

#include "asdf_vk/error.h"

namespace py = pybind11;

namespace asdfvk::python {

template <typename T>
std::span<const T> entriesOf(const py::array& array) {
  const bool isAligned = (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
  if (!py::isinstance<py::array_t<T, py::array::c_style>>(array) || !isAligned)
    throw Error(ErrorCode::ArrayType,
                "an array is not aligned, C-contiguous and of type " + std::string(py::str(py::dtype::of<T>())));
  return {static_cast<const T*>(array.data()), static_cast<size_t>(array.size())};
}

template std::span<const double> entriesOf<double>(const py::array&);
template std::span<const float> entriesOf<float>(const py::array&);
template std::span<const uint32_t> entriesOf<uint32_t>(const py::array&);
template std::span<const uint8_t> entriesOf<uint8_t>(const py::array&);

MeshView viewOf(const py::object& mesh) {
  if (py::isinstance<Mesh>(mesh)) return mesh.cast<const Mesh&>();
  if (!py::isinstance<py::tuple>(mesh) || py::len(mesh) != 2)
    throw Error(ErrorCode::ArrayType, "a mesh is a Mesh, or a tuple of vertices and faces");
  const auto arrays = mesh.cast<std::pair<py::array, py::array>>();
  const std::span<const uint32_t> corners = entriesOf<uint32_t>(arrays.second);
  if (py::isinstance<py::array_t<float>>(arrays.first)) return {entriesOf<float>(arrays.first), corners};
  return {entriesOf<double>(arrays.first), corners};
}

}  // namespace asdfvk::python

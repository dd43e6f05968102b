#include "arrays.h"

#include <algorithm>
#include <string>

#include "asdf_vk/error.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

std::vector<py::ssize_t> shapeOf(const Field& field) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(field.itemCount())};
  if (field.componentCount != 1) shape.push_back(field.componentCount);
  return shape;
}

/// Makes a field from an array of double, uint8 or uint32, (items,) or (items, components).
Field fieldOf(const std::string& name, const py::array& array, FieldLocation location) {
  Field field{.name = name, .label = name, .unit = {}, .location = location, .componentCount = 1, .values = {}};
  if (array.ndim() == 2) field.componentCount = static_cast<uint32_t>(array.shape(1));
  const auto assign = [&]<typename T>(std::span<const T> entries) {
    field.values = std::vector<T>(entries.begin(), entries.end());
  };
  if (py::isinstance<py::array_t<uint8_t>>(array)) {
    assign(entriesOf<uint8_t>(array));
  } else if (py::isinstance<py::array_t<uint32_t>>(array)) {
    assign(entriesOf<uint32_t>(array));
  } else {
    assign(entriesOf<double>(array));
  }
  return field;
}

}  // namespace

bool isFlag(const py::handle& object) {
  return py::isinstance<py::bool_>(object) || py::isinstance(object, py::module_::import("numpy").attr("bool_"));
}

template <typename T>
std::span<const T> entriesOf(const py::array& array) {
  const bool isAligned = (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
  if (!py::isinstance<py::array_t<T, py::array::c_style>>(array) || !isAligned)
    throw Error(ErrorCode::ArrayType,
                "an array must be aligned, C-contiguous and of type " + std::string(py::str(py::dtype::of<T>())));
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

py::array_t<float> singles(std::span<const double> numbers, const std::string& name) {
  requireSingles(numbers, name);
  py::array_t<float> array(static_cast<py::ssize_t>(numbers.size()));
  std::transform(numbers.begin(), numbers.end(), array.mutable_data(),
                 [](double number) { return static_cast<float>(number); });
  return array;
}

py::array arrayOf(const Field& field, bool single) {
  const auto convert = [&]<typename T>(const auto& entries, T) -> py::array {
    py::array_t<T> array(shapeOf(field));
    std::transform(entries.begin(), entries.end(), array.mutable_data(),
                   [](auto entry) { return static_cast<T>(entry); });
    return array;
  };
  if (const std::vector<double>* reals = field.reals()) {
    if (single && field.componentCount == 1) return singles(*reals, "'" + field.name + "'");
    return convert(*reals, 0.0);
  }
  if (const auto* flags = std::get_if<std::vector<uint8_t>>(&field.values)) return convert(*flags, uint8_t{});
  return convert(std::get<std::vector<uint32_t>>(field.values), int32_t{});
}

std::vector<Field> fieldsOf(const py::dict& perFace, const py::dict& perVertex) {
  std::vector<Field> fields;
  for (const auto& [name, array] : perFace)
    fields.push_back(fieldOf(name.cast<std::string>(), array.cast<py::array>(), FieldLocation::PerFace));
  for (const auto& [name, array] : perVertex)
    fields.push_back(fieldOf(name.cast<std::string>(), array.cast<py::array>(), FieldLocation::PerVertex));
  return fields;
}

}  // namespace asdfvk::python

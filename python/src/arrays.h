#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "asdf_vk/field.h"
#include "asdf_vk/mesh.h"

namespace asdfvk::python {

[[nodiscard]] bool isFlag(const pybind11::handle& object);

/// The entries of a C-contiguous array of T, without a copy. Throws Error{ArrayType} for any other array.
template <typename T>
[[nodiscard]] std::span<const T> entriesOf(const pybind11::array& array);

/// A view of a Mesh, or of a tuple of vertices (#V x 3 double or float) and faces (#F x 3 uint32). The object must
/// outlive the view. Throws Error{ArrayType} for objects of other types.
[[nodiscard]] MeshView viewOf(const pybind11::object& mesh);

/// A read-only array that views `data` and keeps `owner` alive.
template <typename T>
[[nodiscard]] pybind11::array_t<T> viewAsArray(const T* data, std::vector<pybind11::ssize_t> shape,
                                               const pybind11::handle& owner) {
  pybind11::array_t<T> array(std::move(shape), data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Fields from two dictionaries, which map names to arrays of double, uint8 or uint32. Throws like entriesOf().
[[nodiscard]] std::vector<Field> fieldsOf(const pybind11::dict& perFace, const pybind11::dict& perVertex);

/// The numbers as float32. Throws like requireSingles().
[[nodiscard]] pybind11::array_t<float> singles(std::span<const double> numbers, const std::string& name);

/// A copy of a field as an array, (items,) or (items, components). If `single` is set and the field has one component,
/// real numbers become float32 (see singles()); in all other cases they are double. uint32 becomes int32, so that
/// 0xffffffff becomes -1.
[[nodiscard]] pybind11::array arrayOf(const Field& field, bool single);

/// The entries as bytes, for pickle.
template <typename T>
[[nodiscard]] pybind11::bytes bytesOf(const std::vector<T>& entries) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char*>(entries.data()), entries.size() * sizeof(T)};
}

/// The inverse of bytesOf().
template <typename T>
void readBytes(const pybind11::object& object, std::vector<T>& entries) {
  const auto bytes = object.cast<std::string_view>();
  entries.resize(bytes.size() / sizeof(T));
  std::memcpy(entries.data(), bytes.data(), entries.size() * sizeof(T));
}

template <typename T>
[[nodiscard]] pybind11::array_t<T> asArray(std::vector<T>&& entries, std::vector<pybind11::ssize_t> shape = {}) {
  if (shape.empty()) shape.push_back(static_cast<pybind11::ssize_t>(entries.size()));
  auto* owned = new std::vector<T>(std::move(entries));
  const pybind11::capsule owner(owned, [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
  return pybind11::array_t<T>(std::move(shape), owned->data(), owner);
}

}  // namespace asdfvk::python

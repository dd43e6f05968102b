#pragma once

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/asdf_vk_c.h"
#include "asdf_vk/mesh.h"

/// Owners of handles, for the tests of the interface in C.
namespace asdfvk::test {

struct DestroyHandle {
  void operator()(asdf_vk_options* handle) const { asdf_vk_options_destroy(handle); }
  void operator()(asdf_vk_session* handle) const { asdf_vk_session_destroy(handle); }
  void operator()(asdf_vk_scene* handle) const { asdf_vk_scene_destroy(handle); }
  void operator()(asdf_vk_result* handle) const { asdf_vk_result_destroy(handle); }
};
template <typename Object>
using Owned = std::unique_ptr<Object, DestroyHandle>;

inline void requireDone(asdf_vk_status status) {
  REQUIRE_MESSAGE(status == ASDF_VK_OK, std::string(asdf_vk_last_error()));
}

using OptionTexts = std::vector<std::pair<const char*, const char*>>;

inline Owned<asdf_vk_options> optionsOfC(const OptionTexts& texts) {
  asdf_vk_options* handle = nullptr;
  requireDone(asdf_vk_options_create(&handle));
  Owned<asdf_vk_options> options(handle);
  for (const auto& text : texts) requireDone(asdf_vk_options_set(handle, text.first, text.second));
  return options;
}

inline Owned<asdf_vk_session> sessionOfC(const char* backend) {
  asdf_vk_session* session = nullptr;
  requireDone(asdf_vk_session_create(optionsOfC({{"backend", backend}}).get(), &session));
  return Owned<asdf_vk_session>(session);
}

/// The triangles of the mesh.
inline Owned<asdf_vk_scene> sceneOfC(asdf_vk_session* session, const Mesh& mesh, const char* unit = nullptr) {
  asdf_vk_scene* scene = nullptr;
  requireDone(asdf_vk_scene_create(session, mesh.vertices.data(), ASDF_VK_FLOAT64, mesh.vertices.size(),
                                   mesh.faces.data(), ASDF_VK_UINT32, mesh.faces.size(), unit, &scene));
  return Owned<asdf_vk_scene>(scene);
}

inline Owned<asdf_vk_result> resultOfC(asdf_vk_scene* scene, const OptionTexts& texts = {}) {
  asdf_vk_result* result = nullptr;
  requireDone(asdf_vk_compute(scene, optionsOfC(texts).get(), nullptr, nullptr, &result));
  return Owned<asdf_vk_result>(result);
}

/// The numbers of a field of real numbers per face.
inline std::vector<double> numbersOf(const asdf_vk_result* result, const char* name) {
  asdf_vk_field field{};
  requireDone(asdf_vk_result_find(result, name, ASDF_VK_PER_FACE, &field));
  REQUIRE(field.type == ASDF_VK_FLOAT64);
  const auto* const numbers = static_cast<const double*>(field.data);
  return {numbers, numbers + field.count * field.components};
}

inline std::string jsonAt(asdf_vk_result* result, const char* pointer) {
  const char* json = nullptr;
  requireDone(asdf_vk_result_json(result, pointer, &json));
  return json;
}

}  // namespace asdfvk::test

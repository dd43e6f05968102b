#include <fmt/core.h>

#include <algorithm>

#include "asdf_vk/files.h"
#include "c/call_guard.h"
#include "c/handle_types.h"
#include "c/handles.h"
#include "describe/report_json.h"

namespace asdfvk::c {
namespace {

FieldLocation locationOf(int location) {
  if (location == ASDF_VK_PER_FACE) return FieldLocation::PerFace;
  if (location == ASDF_VK_PER_VERTEX) return FieldLocation::PerVertex;
  throw Error(ErrorCode::InvalidArgument, "the location is neither PER_FACE nor PER_VERTEX");
}

asdf_vk_field describedField(const Field& field) {
  constexpr asdf_vk_type kTypes[]{ASDF_VK_FLOAT64, ASDF_VK_UINT8, ASDF_VK_UINT32};
  const void* const data =
      std::visit([](const auto& entries) { return static_cast<const void*>(entries.data()); }, field.values);
  return {field.name.c_str(),
          field.unit.c_str(),
          field.location == FieldLocation::PerVertex ? ASDF_VK_PER_VERTEX : ASDF_VK_PER_FACE,
          kTypes[field.values.index()],
          field.componentCount,
          field.itemCount(),
          data};
}

template <typename To>
void convert(const Field& field, void* numbers) {
  std::visit(
      [&](const auto& entries) {
        std::transform(entries.begin(), entries.end(), static_cast<To*>(numbers),
                       [](auto entry) { return static_cast<To>(entry); });
      },
      field.values);
}

void copyNumbers(const Field& field, int type, void* numbers) {
  const std::vector<double>* const reals = field.reals();
  switch (type) {
    case ASDF_VK_FLOAT64:
      return convert<double>(field, numbers);
    case ASDF_VK_FLOAT32:
      if (reals != nullptr) requireSingles(*reals, "'" + field.name + "'");
      return convert<float>(field, numbers);
    case ASDF_VK_UINT8:
      if (field.values.index() == 1) return convert<uint8_t>(field, numbers);
      break;
    case ASDF_VK_UINT32:
      if (reals == nullptr) return convert<uint32_t>(field, numbers);
      break;
    case ASDF_VK_INT32:
      if (reals == nullptr) return convert<int32_t>(field, numbers);
      break;
  }
  throw Error(ErrorCode::ArrayType, fmt::format("the field '{}' cannot be copied as the requested type", field.name));
}

std::string jsonAt(asdf_vk_result& result, const std::string& pointer) {
  if (result.report.is_null())
    result.report = resultJson(result.result.report, result.result.fields, result.computation, result.session);
  try {
    return jsonText(result.report.at(Json::json_pointer(pointer)));
  } catch (const Json::exception&) {
    throw Error(ErrorCode::UnknownField, fmt::format("the report has no value '{}'", pointer));
  }
}

}  // namespace
}  // namespace asdfvk::c

using namespace asdfvk;     // NOLINT: the functions of C have no namespace.
using namespace asdfvk::c;  // NOLINT

extern "C" {

asdf_vk_status asdf_vk_result_field_count(const asdf_vk_result* result, size_t* count) {
  return guarded([&] {
    requireArgument(count, "the output");
    *count = handles<asdf_vk_result>().get(result)->result.fields.size();
  });
}

asdf_vk_status asdf_vk_result_field(const asdf_vk_result* result, size_t index, asdf_vk_field* field) {
  return guarded([&] {
    requireArgument(field, "the output");
    const std::vector<Field>& fields = handles<asdf_vk_result>().get(result)->result.fields;
    if (index >= fields.size())
      throw Error(ErrorCode::UnknownField,
                  fmt::format("there is no field {}: the result has {} fields", index, fields.size()));
    *field = describedField(fields[index]);
  });
}

asdf_vk_status asdf_vk_result_find(const asdf_vk_result* result, const char* name, asdf_vk_location location,
                                   asdf_vk_field* field) {
  return guarded([&] {
    requireArgument(field, "the output");
    requireArgument(name, "the name of the field");
    *field = describedField(
        requireField(handles<asdf_vk_result>().get(result)->result.fields, name, locationOf(numberOf(location))));
  });
}

asdf_vk_status asdf_vk_result_copy(const asdf_vk_result* result, const char* name, asdf_vk_location location,
                                   asdf_vk_type type, void* numbers, size_t capacity) {
  return guarded([&] {
    const auto object = handles<asdf_vk_result>().get(result);
    requireArgument(name, "the name of the field");
    const Field& field = requireField(object->result.fields, name, locationOf(numberOf(location)));
    if (capacity < field.size())
      throw Error(ErrorCode::ArraySize,
                  fmt::format("the array has room for {} numbers; '{}' has {}", capacity, name, field.size()));
    requireArgument(numbers, "the array");
    copyNumbers(field, numberOf(type), numbers);
  });
}

asdf_vk_status asdf_vk_result_json(asdf_vk_result* result, const char* pointer, const char** json) {
  return guarded([&] {
    requireArgument(json, "the output");
    requireArgument(pointer, "the JSON Pointer");
    const auto object = handles<asdf_vk_result>().get(result);
    const std::scoped_lock lock(object->mutex);
    auto found = object->texts.find(pointer);
    if (found == object->texts.end()) found = object->texts.emplace(pointer, jsonAt(*object, pointer)).first;
    *json = found->second.c_str();
  });
}

asdf_vk_status asdf_vk_result_write(const asdf_vk_result* result, const char* path) {
  return guarded([&] {
    const auto object = handles<asdf_vk_result>().get(result);
    requireArgument(path, "the path");
    writeResult(path, *object->mesh, object->result.fields);
  });
}

void asdf_vk_result_destroy(asdf_vk_result* result) { handles<asdf_vk_result>().destroy(result); }

}  // extern "C"

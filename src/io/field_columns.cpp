#include "io/field_columns.h"

#include <fmt/core.h>

#include <array>
#include <set>
#include <utility>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

constexpr std::array<std::string_view, 3> kSuffixes{"_x", "_y", "_z"};

}  // namespace

std::vector<FieldColumn> columnsOf(FieldReferences fields, FieldLocation location, const Field* omitted,
                                   std::initializer_list<std::string_view> reservedNames) {
  std::set<std::string, std::less<>> names(reservedNames.begin(), reservedNames.end());
  std::vector<FieldColumn> columns;
  for (const Field& field : fields) {
    if (field.location != location || &field == omitted) continue;
    for (uint32_t c = 0; c < field.componentCount; ++c) {
      std::string name = field.name;
      if (field.componentCount == 3) name += kSuffixes[c];
      if (!names.insert(name).second)
        throw Error(ErrorCode::OptionConflict,
                    fmt::format("field {} needs a column {}, but the format or another field uses this name",
                                field.name, name));
      columns.push_back({std::move(name), &field, c});
    }
  }
  return columns;
}

}  // namespace asdfvk

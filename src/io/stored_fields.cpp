#include "io/stored_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "asdf_vk/error.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr std::array<std::string_view, 3> kSuffixes{"_x", "_y", "_z"};

/// The common name of the three columns that start there; empty where they are not the components of one field.
std::string_view joinedName(std::span<const Field> columns) {
  if (columns.size() < 3) return {};
  std::string_view name = columns[0].name;
  if (name.size() <= kSuffixes[0].size()) return {};
  name.remove_suffix(kSuffixes[0].size());
  for (size_t c = 0; c < 3; ++c) {
    const Field& column = columns[c];
    if (column.name.size() != name.size() + 2 || !column.name.starts_with(name) ||
        !column.name.ends_with(kSuffixes[c]) || column.location != columns[0].location ||
        column.values.index() != columns[0].values.index())
      return {};
  }
  return name;
}

Field join(std::span<const Field> columns, std::string_view name) {
  Field field{.name = std::string(name), .location = columns[0].location, .componentCount = 3};
  std::visit(
      [&]<typename Entries>(const Entries& xs) {
        Entries entries(3 * xs.size());
        for (size_t c = 0; c < 3; ++c) {
          const Entries& column = std::get<Entries>(columns[c].values);
          for (size_t i = 0; i < column.size(); ++i) entries[3 * i + c] = column[i];
        }
        field.values = std::move(entries);
      },
      columns[0].values);
  return field;
}

}  // namespace

bool isFieldName(std::string_view name) {
  const auto isAllowed = [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), isAllowed);
}

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
        throw Error(
            ErrorCode::OptionConflict,
            fmt::format("field {} needs a column {}, a name that the format or another field uses", field.name, name));
      columns.push_back({std::move(name), &field, c});
    }
  }
  return columns;
}

std::vector<Field> joinColumns(std::vector<Field> columns) {
  std::vector<Field> fields;
  fields.reserve(columns.size());
  for (size_t i = 0; i < columns.size();) {
    const std::span<const Field> rest = std::span(columns).subspan(i);
    const std::string_view name = joinedName(rest);
    if (name.empty()) {
      fields.push_back(std::move(columns[i++]));
    } else {
      fields.push_back(join(rest, name));
      i += 3;
    }
  }
  return fields;
}

void requireReadableNames(std::span<const Field> fields) {
  std::set<std::string_view> names;
  for (const Field& field : fields) {
    if (!isFieldName(field.name)) failInput(fmt::format("{} is not a name of a field", quoted(field.name)));
    if (!names.insert(field.name).second) failInput(fmt::format("has two fields {}", quoted(field.name)));
  }
}

}  // namespace asdfvk

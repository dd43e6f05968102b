#include "cli/program_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "describe/option.h"

namespace asdfvk {
namespace {

[[noreturn]] void reject(const std::string& message) { throw Error(ErrorCode::OptionOutOfRange, message); }

void requireFieldName(const std::string& name) {
  const std::vector<std::string> known = resultFieldNames();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error(ErrorCode::UnknownName,
                fmt::format("'{}' is not a field; the fields are {}", name, joined(known, ", ")));
}

}  // namespace

bool FieldListCodec::read(const OptionValue& value, const OptionRow&, std::vector<std::string>& fields) {
  const std::string_view text = textIn(value);
  std::vector<std::string> names = splitAt(text, ',');
  if (names.empty() || text.ends_with(',')) return false;
  for (const std::string& name : names) {
    if (name.empty()) return false;
    if (std::count(names.begin(), names.end(), name) > 1) reject(fmt::format("'{}' names {} twice", text, name));
    requireFieldName(name);
  }
  fields = std::move(names);
  return true;
}

OptionValue FieldListCodec::write(const std::vector<std::string>& fields) {
  return fields.empty() ? OptionValue() : OptionValue(joined(fields, ","));
}

bool FieldCodec::read(const OptionValue& value, const OptionRow& row, std::string& field) {
  requireFieldName(std::string(textIn(value)));
  return TextCodec::read(value, row, field);
}

bool ShownFieldCodec::read(const OptionValue& value, const OptionRow& row, std::string& field) {
  const std::string_view text = textIn(value);
  const std::string name(text == "seeds" ? "seed" : text);  // Version 0.1 had the name "seeds".
  requireFieldName(name);
  if (name == "centre") reject("'centre' has three components; a picture shows a field of one component");
  return TextCodec::read(name, row, field);
}

bool ViewCodec::read(const OptionValue& value, const OptionRow&, Outputs& outputs) {
  const std::string_view text = textIn(value);
  const size_t comma = std::min(text.find(','), text.size());
  const auto azimuth = numberIn<double>(text.substr(0, comma)),
             elevation = numberIn<double>(text.substr(std::min(comma + 1, text.size())));
  if (!azimuth || !elevation) return false;
  if (!(std::abs(*azimuth) <= 360)) reject(fmt::format("the azimuth in '{}' is not from -360 to 360", text));
  if (!(std::abs(*elevation) <= 90)) reject(fmt::format("the elevation in '{}' is not from -90 to 90", text));
  outputs.pictureView.azimuthDegrees = *azimuth;
  outputs.pictureView.elevationDegrees = *elevation;
  outputs.choosesView = true;
  return true;
}

OptionValue ViewCodec::write(const Outputs& outputs) {
  const View& view = outputs.pictureView;
  return outputs.choosesView ? OptionValue(fmt::format("{},{}", view.azimuthDegrees, view.elevationDegrees))
                             : OptionValue();
}

bool NameCodec::read(const OptionValue& value, const OptionRow& row, std::string& name) {
  return TextCodec::read(value, row, name) && !name.empty();
}

bool FileCodec::read(const OptionValue& value, const OptionRow& row, std::string& name) {
  const std::string extension = lowerCase(std::filesystem::path(textIn(value)).extension().string());
  const std::vector<std::string> allowed = splitAt(row.placeholder, '|');
  const bool isAllowed = std::any_of(allowed.begin(), allowed.end(), [&](const std::string& file) {
    if (file.ends_with('/')) return textIn(value).ends_with('/');
    return std::filesystem::path(file).extension() == extension;
  });
  return (isAllowed || textIn(value) == "-") && NameCodec::read(value, row, name);
}

bool MemoryCodec::read(const OptionValue& value, const OptionRow&, uint64_t& limit) {
  const std::optional<uint64_t> bytes = parseByteCount(std::string(textIn(value)));
  if (bytes) limit = *bytes;
  return bytes.has_value();
}

OptionValue MemoryCodec::write(uint64_t limit) {
  return limit == 0 ? OptionValue() : OptionValue(std::to_string(limit));
}

bool ShardCodec::read(const OptionValue& value, const OptionRow&, std::optional<Shard>& shard) {
  shard = parseShard(std::string(textIn(value)));
  return true;
}

OptionValue ShardCodec::write(const std::optional<Shard>& shard) {
  return shard ? OptionValue(fmt::format("{}/{}", shard->index, shard->count)) : OptionValue();
}

bool ChordErrorCodec::read(const OptionValue& value, const OptionRow& row, ReadOptions& reading) {
  std::optional<LengthLimit> length;
  if (!LengthCodec::read(value, row, length)) return false;
  reading.chordError = length->value;
  reading.chordErrorUnit = length->unit;
  return true;
}

OptionValue ChordErrorCodec::write(const ReadOptions& reading) {
  if (!(reading.chordError > 0)) return {};
  return LengthCodec::write(LengthLimit(reading.chordError, reading.chordErrorUnit));
}

bool MeshNameCodec::read(const OptionValue& value, const OptionRow& row, std::string& name) {
  return TextCodec::read(value, row, name) && !name.empty() && name != "-";
}

bool MeshNamesCodec::read(const OptionValue& value, const OptionRow& row, std::vector<std::string>& names) {
  std::string name;
  const bool isRead = MeshNameCodec::read(value, row, name);
  if (isRead) names.push_back(name);
  return isRead;
}

OptionValue MeshNamesCodec::write(const std::vector<std::string>& names) {
  return names.empty() ? OptionValue() : OptionValue(joined(names, ","));
}

std::optional<uint64_t> parseByteCount(const std::string& text) {
  constexpr std::string_view kUnits = "kmgt";
  const size_t unit = text.empty() ? std::string_view::npos : kUnits.find(lowerCase(text).back());
  const bool hasUnit = unit != std::string_view::npos;
  const auto number = numberIn<double>(std::string_view(text).substr(0, text.size() - (hasUnit ? 1 : 0)));
  if (!number) return std::nullopt;
  const double bytes = hasUnit ? std::ldexp(*number, 10 * (static_cast<int>(unit) + 1)) : *number;
  return bytes >= 1 && bytes < 0x1p63 ? std::optional(static_cast<uint64_t>(bytes)) : std::nullopt;
}

}  // namespace asdfvk

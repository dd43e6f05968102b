#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "batch/input_list.h"
#include "cli/outputs.h"
#include "describe/option_values.h"

/// Codecs of the options that only the program has, see OptionCodec.
namespace asdfvk {

/// Names such as "sdf,seed,error".
struct FieldListCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  static constexpr const char* kWanted = "a list of names such as sdf,seed,error";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow&, std::vector<std::string>& fields);
  [[nodiscard]] static OptionValue write(const std::vector<std::string>& fields);
};

struct FieldCodec : TextCodec {
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::string& field);
};

struct ShownFieldCodec : TextCodec {
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::string& field);
};

/// Azimuth and elevation in degrees, such as "30,18".
struct ViewCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  static constexpr const char* kWanted = "two numbers with a comma between them";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow&, Outputs& outputs);
  [[nodiscard]] static OptionValue write(const Outputs& outputs);
};

struct NameCodec : TextCodec {
  static constexpr const char* kWanted = "a name";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::string& name);
};

/// "-", or a name with one of the extensions of the placeholder, which is for example "FILE.ply|FILE.swc". If the
/// placeholder has FOLDER/, also a name that ends in /.
struct FileCodec : NameCodec {
  static constexpr const char* kWanted = nullptr;
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::string& name);
};

/// A number of bytes; 0 is no limit.
struct MemoryCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  static constexpr const char* kWanted = "a size such as 500M or 2G";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow&, uint64_t& limit);
  [[nodiscard]] static OptionValue write(uint64_t limit);
};

struct ShardCodec {
  static constexpr OptionKind kKind = OptionKind::Text;
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow&, std::optional<Shard>& shard);
  [[nodiscard]] static OptionValue write(const std::optional<Shard>& shard);
};

struct ChordErrorCodec : LengthCodec {
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, ReadOptions& reading);
  [[nodiscard]] static OptionValue write(const ReadOptions& reading);
};

/// The name of a file other than standard input.
struct MeshNameCodec : TextCodec {
  static constexpr const char* kWanted = "the name of a file";
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::string& name);
};

/// Appends a name in each call.
struct MeshNamesCodec : MeshNameCodec {
  [[nodiscard]] static bool read(const OptionValue& value, const OptionRow& row, std::vector<std::string>& names);
  [[nodiscard]] static OptionValue write(const std::vector<std::string>& names);
};

/// Reads a number of bytes, at least 1, such as "500M", "1.5g" or "4096". The letters mean powers of 1024. Returns
/// nothing for other texts.
[[nodiscard]] std::optional<uint64_t> parseByteCount(const std::string& text);

}  // namespace asdfvk

#include "batch/input_list.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <numeric>
#include <optional>
#include <queue>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "asdf_vk/error.h"
#include "core/json.h"
#include "core/text.h"
#include "io/formats.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::UnreadableInput, fmt::format("{}: {}", path, reason));
}

uint64_t byteCountOf(const fs::path& path) {
  std::error_code error;
  const uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

/// Whether the file is a result of this program, such as "horse.asdf.ply" or "horse.asdf.ply.gz".
bool isResult(const fs::path& name) { return unpackedName(name).stem().extension() == ".asdf"; }

class FolderSearch {
 public:
  explicit FolderSearch(const InputRequest& request) : request_(request) {}

  void search(const fs::path& root, std::vector<InputFile>& inputs) const {
    std::vector<InputFile> found;
    searchFolder(root, "", found);
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    inputs.insert(inputs.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  }

 private:
  void searchFolder(const fs::path& folder, const fs::path& below, std::vector<InputFile>& found) const {
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      const fs::path name = entry->path().filename();
      if (name.native().starts_with('.')) continue;
      std::error_code ignored;
      const fs::file_type type = entry->status(ignored).type();
      // Dangling links and files of unknown type are inputs, so that reading them reports an error.
      const bool isFile = type == fs::file_type::regular || type == fs::file_type::not_found ||
                          type == fs::file_type::none || type == fs::file_type::unknown;
      if (type == fs::file_type::directory && !entry->is_symlink(ignored)) {
        if (!isOutputFolder(entry->path())) searchFolder(entry->path(), below / name, found);
      } else if (isFile && isMesh(name)) {
        found.push_back({entry->path().string(), below.string(), byteCountOf(entry->path())});
      }
    }
    if (error) fail(folder.string(), error.message());
  }

  [[nodiscard]] bool isMesh(const fs::path& name) const {
    const std::string extension = lowerCase(meshExtension(name));
    return extension.size() > 1 && !isResult(name) &&
           std::count(request_.formats.begin(), request_.formats.end(), extension.substr(1)) > 0;
  }

  [[nodiscard]] bool isOutputFolder(const fs::path& folder) const {
    std::error_code error;
    return !request_.outputFolder.empty() && fs::equivalent(folder, request_.outputFolder, error) && !error;
  }

  const InputRequest& request_;
};

struct ListEntry {
  std::string path, key;
};

/// Why the key cannot be the name of an output; empty if it can.
std::string flawOf(const std::string& key) {
  if (key.empty()) return "it is empty";
  if (key.front() == '/') return "it is absolute";
  if (oneLine(key) != key) return "it has a control character";
  for (const std::string& part : splitAt(key + "/", '/'))
    if (part.empty() || part == "." || part == "..") return fmt::format("it has the part '{}'", part);
  try {
    (void)Json(key).dump();
  } catch (const Json::exception&) {
    return "it is not UTF-8";
  }
  return {};
}

/// Reads the keys of the lines of a list.
class KeyReader {
 public:
  explicit KeyReader(std::string list) : list_(std::move(list)) {}

  /// The path and the key of the next line.
  ListEntry entryOf(const std::string& line) {
    ++lineNumber_;
    const size_t tab = line.find('\t');
    if (tab == std::string::npos) return {line, ""};
    std::string key = line.substr(tab + 1);
    if (const std::string flaw = flawOf(key); !flaw.empty())
      fail(list_, oneLine(fmt::format("line {}: the key '{}' is not a name such as part-7 or b/part-7: {}", lineNumber_,
                                      key, flaw)));
    if (const auto [first, isNew] = lineOfKey_.emplace(key, lineNumber_); !isNew)
      fail(list_, fmt::format("lines {} and {} have the same key '{}'; give each mesh its own key", first->second,
                              lineNumber_, key));
    if (tab == 0) fail(list_, fmt::format("line {}: there is no path before the key '{}'", lineNumber_, key));
    return {line.substr(0, tab), std::move(key)};
  }

 private:
  std::string list_;
  size_t lineNumber_ = 0;
  std::unordered_map<std::string, size_t> lineOfKey_;
};

std::vector<ListEntry> readList(const InputRequest& request) {
  std::ifstream file;
  const bool isStandardInput = request.list == "-";
  if (!isStandardInput) {
    std::error_code ignored;
    if (fs::is_directory(request.list, ignored)) fail(request.list, "is a folder, not a list of meshes");
    file.open(request.list, std::ios::binary);
    if (!file) fail(request.list, fmt::format("cannot be opened: {}", std::strerror(errno)));
  }
  std::istream& in = isStandardInput ? std::cin : file;
  const std::string name = isStandardInput ? "standard input" : request.list;
  std::vector<ListEntry> entries;
  KeyReader keys(name);
  bool isFirst = true;
  for (std::string line; std::getline(in, line, request.isNullSeparated ? '\0' : '\n');) {
    ListEntry entry{line, ""};
    if (!request.isNullSeparated) {  // In a list from Windows, lines end with "\r\n".
      if (std::exchange(isFirst, false)) line = std::string(withoutByteOrderMark(line));
      if (line.ends_with('\r')) line.pop_back();
      entry = keys.entryOf(line);
    }
    if (!entry.path.empty()) entries.push_back(std::move(entry));
  }
  if (in.bad()) fail(name, "cannot be read");
  return entries;
}

/// The longest common prefix of the components of both paths.
fs::path commonFolder(const fs::path& a, const fs::path& b) {
  fs::path common;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end() && *i == *j; ++i, ++j) common /= *i;
  return common;
}

void addList(const std::vector<ListEntry>& entries, std::vector<InputFile>& inputs) {
  const auto folderOf = [](const ListEntry& entry) {
    return fs::absolute(entry.path).lexically_normal().parent_path();
  };
  std::optional<fs::path> root;
  for (const ListEntry& entry : entries) {
    if (entry.path == "-") fail("-", "a list of meshes cannot contain standard input; give - as an argument");
    if (!entry.key.empty()) continue;
    const fs::path folder = folderOf(entry);
    root = root ? commonFolder(*root, folder) : folder;
  }
  for (const ListEntry& entry : entries) {
    const fs::path below =
        entry.key.empty() ? folderOf(entry).lexically_relative(*root) : fs::path(entry.key).parent_path();
    inputs.push_back({entry.path, below == "." ? "" : below.string(), byteCountOf(entry.path), entry.key});
  }
}

}  // namespace

std::vector<InputFile> listInputs(const InputRequest& request) {
  std::vector<InputFile> inputs;
  const FolderSearch folders(request);
  for (const std::string& argument : request.arguments) {
    std::error_code ignored;
    if (request.recurses && argument != "-" && fs::is_directory(argument, ignored)) {
      folders.search(argument, inputs);
    } else {
      inputs.push_back({argument, "", argument == "-" ? 0 : byteCountOf(argument)});
    }
  }
  if (!request.list.empty()) addList(readList(request), inputs);
  return inputs;
}

Shard parseShard(const std::string& text) {
  return parseShard(text, [](const char* name) { return std::getenv(name); });
}

Shard parseShard(const std::string& text, const EnvironmentLookup& lookup) {
  const size_t slash = std::min(text.find('/'), text.size());
  const auto index = numberIn<uint32_t>(std::string_view(text).substr(0, slash)),
             count = numberIn<uint32_t>(std::string_view(text).substr(std::min(slash + 1, text.size())));
  const bool isAuto = text.starts_with("auto") && (text.size() == 4 || slash == 4);
  if (isAuto && (slash == text.size() || (count && *count >= 1 && *count <= kMaxShardCount)))
    return shardOfScheduler(count, lookup);
  if (!index || !count || *index < 1 || *index > *count || *count > kMaxShardCount)
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("'{}' is not I/N, such as 2/7, or auto or auto/N; I is from 1 to N, and N is at most {}",
                            text, kMaxShardCount));
  return {*index, *count, ""};
}

std::vector<size_t> selectShard(const std::vector<InputFile>& inputs, const Shard& shard) {
  std::vector<size_t> bySize(inputs.size());
  std::iota(bySize.begin(), bySize.end(), size_t{0});
  std::sort(bySize.begin(), bySize.end(), [&](size_t a, size_t b) {
    if (inputs[a].byteCount != inputs[b].byteCount) return inputs[a].byteCount > inputs[b].byteCount;
    return std::tie(inputs[a].path, inputs[a].key) < std::tie(inputs[b].path, inputs[b].key);
  });
  // Bytes and index of a shard. If several shards have equal bytes, the shard with the lowest index comes first.
  using Load = std::pair<uint64_t, uint32_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (uint32_t index = 1; index <= shard.count; ++index) loads.emplace(0, index);
  std::vector<size_t> chosen;
  for (const size_t i : bySize) {
    const auto [bytes, index] = loads.top();
    loads.pop();
    loads.emplace(bytes + inputs[i].byteCount + kBytesPerMesh, index);
    if (index == shard.index) chosen.push_back(i);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace asdfvk

#include "page/decoded_page.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/atomic_file.h"

namespace asdfvk::test {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::vector<uint8_t>;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("page: " + what); }

/// The text between the opening tag and the next closing tag, as a browser ends a script.
std::string elementText(const std::string& html, const std::string& openingTag) {
  const size_t begin = html.find(openingTag);
  if (begin == std::string::npos) fail("no " + openingTag);
  const size_t end = html.find("</script", begin);
  if (end == std::string::npos) fail("unclosed " + openingTag);
  return html.substr(begin + openingTag.size(), end - begin - openingTag.size());
}

Bytes fromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  if (text.size() % 4 != 0) fail("base64 without padding");
  Bytes bytes;
  uint32_t bits = 0;
  int bitCount = 0;
  for (const char c : text.substr(0, text.find('='))) {
    const size_t digit = digits.find(c);
    if (digit == std::string::npos) fail("no base64");
    bits = bits << 6 | static_cast<uint32_t>(digit);
    bitCount += 6;
    if (bitCount < 8) continue;
    bitCount -= 8;
    bytes.push_back(static_cast<uint8_t>(bits >> bitCount));
  }
  return bytes;
}

Bytes inflated(const Bytes& compressed) {
  Bytes bytes;
  constexpr uLongf kMaxSize = 1 << 28;
  for (uLongf size = 4096; size < kMaxSize; size *= 4) {
    bytes.resize(size);
    uLongf written = size;
    const int status = uncompress(bytes.data(), &written, compressed.data(), static_cast<uLong>(compressed.size()));
    bytes.resize(written);
    if (status == Z_OK) return bytes;
    if (status != Z_BUF_ERROR) break;
  }
  fail("damaged array");
}

/// Array `number` of the page.
std::vector<int64_t> numbersOf(const Json& number, size_t count, const std::vector<Bytes>& arrays) {
  const Bytes& planes = arrays.at(number.get<size_t>());
  if (planes.size() % count != 0 || planes.size() / count > 4) fail("planes");
  std::vector<int64_t> numbers(count);
  for (size_t i = 0; i < count; ++i) {
    uint64_t stored = 0;
    for (size_t plane = 0; plane < planes.size() / count; ++plane)
      stored |= uint64_t{planes[plane * count + i]} << 8 * plane;
    numbers[i] = stored % 2 == 0 ? static_cast<int64_t>(stored / 2) : -static_cast<int64_t>(stored / 2) - 1;
  }
  return numbers;
}

std::vector<uint32_t> sumsOf(const Json& number, size_t count, const std::vector<Bytes>& arrays) {
  std::vector<uint32_t> sums;
  int64_t sum = 0;
  for (const int64_t difference : numbersOf(number, count, arrays))
    sums.push_back(static_cast<uint32_t>(sum += difference));
  return sums;
}

std::vector<double> valuesOf(const Json& field, const std::vector<uint32_t>& numbers) {
  std::vector<double> values;
  for (const uint32_t number : numbers) {
    if (field["kind"] == "number") {
      values.push_back(std::bit_cast<float>(number * 512));
    } else {
      values.push_back(number == 0xffffffff ? std::numeric_limits<double>::quiet_NaN() : number);
    }
  }
  return values;
}

DecodedMesh decodeMesh(const Json& description, const std::vector<Bytes>& arrays) {
  DecodedMesh mesh{.description = description};
  const Json& numbers = description["arrays"];
  const size_t faceCount = description["faceCount"], vertexCount = description["vertexCount"];
  std::vector<uint32_t> corners;
  int64_t count = 0;
  for (const int64_t corner : numbersOf(numbers["corners"], 3 * faceCount, arrays)) {
    if (corner > 0 || corner < -count) fail("corners");
    corners.push_back(static_cast<uint32_t>(count + corner));
    if (corner == 0) ++count;
  }
  if (count != static_cast<int64_t>(vertexCount)) fail("vertexCount");
  for (size_t i = 0; i < corners.size(); i += 3) mesh.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
  mesh.positions.resize(vertexCount);
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::vector<uint32_t> steps = sumsOf(numbers[std::string(1, "xyz"[axis])], vertexCount, arrays);
    for (size_t i = 0; i < vertexCount; ++i) {
      if (steps[i] > 65535) fail("step");
      mesh.positions[i][axis] =
          description["boxMin"][axis].get<double>() + steps[i] * description["step"].get<double>();
    }
  }
  mesh.faceIds = sumsOf(numbers["faces"], faceCount, arrays);
  for (const Json& field : description["fields"])
    mesh.fields[field["name"]] = valuesOf(field, sumsOf(field["array"], faceCount, arrays));
  if (description.contains("thin") && description["thin"].contains("surface"))
    mesh.thinSurface.push_back(decodeMesh(description["thin"]["surface"], arrays));
  return mesh;
}

}  // namespace

std::string htmlOf(const Page& page) {
  std::string folder = (std::filesystem::temp_directory_path() / "asdfvk-page-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) fail("no temporary folder");
  const std::filesystem::path path = std::filesystem::path(folder) / "page.html";
  AtomicFile file(path);
  page.write(file);
  file.commit();
  std::ifstream stream(path, std::ios::binary);
  std::string html{std::istreambuf_iterator<char>(stream), {}};
  std::filesystem::remove_all(folder);
  return html;
}

DecodedPage decodePage(const std::string& html) {
  DecodedPage page{.html = html};
  page.json = Json::parse(elementText(html, "<script type=\"application/json\" id=\"asdf-vk-page\">"));
  for (size_t i = 0;; ++i) {
    const std::string tag = "<script type=\"application/octet-stream\" id=\"array-" + std::to_string(i) + "\">";
    if (html.find(tag) == std::string::npos) break;
    page.arrays.push_back(inflated(fromBase64(elementText(html, tag))));
  }
  for (const Json& mesh : page.json["meshes"]) page.meshes.push_back(decodeMesh(mesh, page.arrays));
  return page;
}

}  // namespace asdfvk::test

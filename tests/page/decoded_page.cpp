#include "page/decoded_page.h"

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/atomic_file.h"

namespace asdfvk::test {
namespace {

using Json = nlohmann::ordered_json;
using Stream = std::vector<uint8_t>;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("page: " + what); }

/// The text between the opening tag and the next closing tag, as a browser ends a script.
std::string elementText(const std::string& html, const std::string& openingTag) {
  const size_t begin = html.find(openingTag);
  if (begin == std::string::npos) fail("no " + openingTag);
  const size_t end = html.find("</script", begin);
  if (end == std::string::npos) fail("unclosed " + openingTag);
  return html.substr(begin + openingTag.size(), end - begin - openingTag.size());
}

Stream fromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  if (text.size() % 4 != 0) fail("base64 without padding");
  Stream bytes;
  for (size_t i = 0; i < text.size(); i += 4) {
    uint32_t group = 0;
    size_t count = 3;
    for (size_t k = 0; k < 4; ++k) {
      const char c = text[i + k];
      if (c == '=' && i + 4 == text.size() && k >= 2) {
        count = std::min(count, k - 1);
        group <<= 6;
        continue;
      }
      const size_t digit = digits.find(c);
      if (digit == std::string::npos) fail("no base64");
      group = group << 6 | static_cast<uint32_t>(digit);
    }
    for (size_t k = 0; k < count; ++k) bytes.push_back(static_cast<uint8_t>(group >> (16 - 8 * k)));
  }
  return bytes;
}

Stream inflated(const Stream& compressed) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) fail("zlib");
  stream.next_in = const_cast<Bytef*>(compressed.data());
  stream.avail_in = static_cast<uInt>(compressed.size());
  Stream bytes;
  std::array<uint8_t, 65536> part{};
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = part.data();
    stream.avail_out = static_cast<uInt>(part.size());
    status = inflate(&stream, Z_NO_FLUSH);
    bytes.insert(bytes.end(), part.data(), part.data() + (part.size() - stream.avail_out));
  }
  inflateEnd(&stream);
  if (status != Z_STREAM_END || stream.avail_in != 0) fail("damaged stream");
  return bytes;
}

/// The differences of a stream of `count` numbers.
std::vector<int64_t> differencesOf(const Stream& planes, size_t count) {
  if (count == 0 || planes.size() % count != 0 || planes.size() / count > 4) fail("planes");
  std::vector<int64_t> differences(count);
  for (size_t i = 0; i < count; ++i) {
    uint64_t number = 0;
    for (size_t plane = 0; plane < planes.size() / count; ++plane)
      number |= uint64_t{planes[plane * count + i]} << 8 * plane;
    differences[i] = number % 2 == 0 ? static_cast<int64_t>(number / 2) : -static_cast<int64_t>(number / 2) - 1;
  }
  return differences;
}

bool bitOf(const Stream& bits, size_t i) { return (bits.at(i / 8) >> i % 8 & 1) != 0; }

struct Gate {
  size_t face, start, end, opposite, previous, next;
  bool isOpen = true;
};

class Walk {
 public:
  std::vector<Face> faces;
  std::vector<std::array<size_t, 2>> inFront;         ///< Per face; the face itself for the first.
  std::vector<std::array<size_t, 3>> parallelograms;  ///< Per vertex; three times the same for none.

  Walk(const Stream& symbols, const Stream& references, size_t faceCount) : references_(references) {
    for (size_t at = 0; faces.size() < faceCount; ++at) {
      const int symbol = symbols.at(at / 2) >> (at % 2 * 4) & 15;
      if (isActive_) {
        step(symbol);
      } else {
        begin(symbol);
      }
    }
  }
  [[nodiscard]] size_t gateCount() const { return gates_.size(); }
  [[nodiscard]] bool areReferencesUsed() const { return referenceAt_ == references_.size(); }

 private:
  size_t reference() {
    size_t number = 0;
    for (int shift = 0;; shift += 7) {
      const uint8_t byte = references_.at(referenceAt_++);
      number |= size_t{byte & 0x7fu} << shift;
      if (byte < 0x80) return number;
    }
  }
  size_t newVertex(size_t s, size_t e, size_t o) {
    parallelograms.push_back({s, e, o});
    return parallelograms.size() - 1;
  }
  size_t addFace(size_t a, size_t b, size_t c, size_t first, size_t second) {
    faces.push_back({static_cast<uint32_t>(a), static_cast<uint32_t>(b), static_cast<uint32_t>(c)});
    inFront.push_back({first, second});
    return faces.size() - 1;
  }
  size_t addGate(size_t face, size_t start, size_t end, size_t opposite) {
    gates_.push_back({face, start, end, opposite, 0, 0});
    return gates_.size() - 1;
  }
  void join(size_t gate, size_t next) {
    if (gates_.at(gate).end != gates_.at(next).start) fail("a ring is broken");
    gates_[gate].next = next;
    gates_[next].previous = gate;
  }
  void activate(size_t gate) {
    active_ = gate;
    isActive_ = true;
  }
  void pop() {
    isActive_ = false;
    while (!isActive_ && !stack_.empty()) {
      if (gates_[stack_.back()].isOpen) activate(stack_.back());
      stack_.pop_back();
    }
  }

  void begin(int symbol) {
    if (symbol != 7 && symbol != 8) fail("a symbol without an active gate");
    std::array<size_t, 3> v{};
    for (size_t& vertex : v) {
      const size_t back = reference();
      vertex = back == 0 ? newVertex(0, 0, 0) : parallelograms.size() - back;
    }
    const size_t before = faces.empty() ? 0 : faces.size() - 1;
    const size_t face = addFace(v[0], v[1], v[2], before, before);
    if (symbol == 8) return;
    const size_t ab = addGate(face, v[0], v[1], v[2]), bc = addGate(face, v[1], v[2], v[0]),
                 ca = addGate(face, v[2], v[0], v[1]);
    join(ab, bc);
    join(bc, ca);
    join(ca, ab);
    stack_ = {ca, bc};
    activate(ab);
  }

  void step(int symbol) {
    Gate& active = gates_.at(active_);
    active.isOpen = false;
    const Gate gate = active;
    const size_t s = gate.start, e = gate.end;
    const Gate previous = gates_.at(gate.previous), next = gates_.at(gate.next);
    if (symbol == 6) return pop();
    if (symbol == 1) {
      const size_t face = addFace(e, s, next.end, gate.face, next.face);
      gates_[gate.next].isOpen = false;
      const size_t made = addGate(face, s, next.end, e);
      join(gate.previous, made);
      join(made, next.next);
      return activate(made);
    }
    if (symbol == 2) {
      const size_t face = addFace(e, s, previous.start, gate.face, previous.face);
      gates_[gate.previous].isOpen = false;
      const size_t made = addGate(face, previous.start, e, s);
      join(previous.previous, made);
      join(made, gate.next);
      return activate(made);
    }
    if (symbol == 3) {
      if (previous.start != next.end) fail("both");
      addFace(e, s, next.end, gate.face, next.face);
      gates_[gate.previous].isOpen = gates_[gate.next].isOpen = false;
      join(previous.previous, next.next);
      return pop();
    }
    size_t v = 0, there = 0;
    if (symbol == 0) {
      v = newVertex(s, e, gate.opposite);
    } else if (symbol == 4) {
      there = gates_.size() - reference();
      v = gates_.at(there).start;
    } else if (symbol == 5) {
      v = parallelograms.size() - reference();
    } else {
      fail("an unknown symbol");
    }
    const size_t face = addFace(e, s, v, gate.face, gate.face);
    const size_t sv = addGate(face, s, v, e), ve = addGate(face, v, e, s);
    if (symbol == 4) {
      join(gates_[there].previous, ve);
      join(sv, there);
    } else {
      join(sv, ve);
    }
    join(gate.previous, sv);
    join(ve, gate.next);
    stack_.push_back(sv);
    activate(ve);
  }

  const Stream& references_;
  size_t referenceAt_ = 0;
  std::vector<Gate> gates_;
  std::vector<size_t> stack_;
  size_t active_ = 0;
  bool isActive_ = false;
};

std::vector<double> decodeField(const Json& field, const Walk& walk, const std::vector<Stream>& streams) {
  const Stream& stream = streams.at(field["stream"]);
  const size_t count = walk.faces.size();
  std::vector<double> values(count);
  if (field["kind"] == "flag") {
    for (size_t i = 0; i < count; ++i) values[i] = bitOf(stream, i) ? 1 : 0;
    return values;
  }
  const std::vector<int64_t> differences = differencesOf(stream, count);
  std::vector<int64_t> codes(count);
  for (size_t i = 0; i < count; ++i) {
    const auto [first, second] = walk.inFront[i];
    if (field["kind"] == "label") {
      codes[i] = static_cast<uint32_t>((i == 0 ? 0 : codes[first]) + differences[i]);
      values[i] = static_cast<double>(codes[i]);
      continue;
    }
    const double mean = i == 0 ? 0 : static_cast<double>(codes[first] + codes[second]) / 2;
    codes[i] = static_cast<int64_t>(std::floor(mean)) + differences[i];
    const int64_t c = std::abs(codes[i]) - 1;
    if (c < 0) continue;
    const int64_t decade = c / 9000, digits = 1000 + c - 9000 * decade;
    const int exponent = field["lowestExponent"].get<int>() + static_cast<int>(decade);
    const double value = std::strtod((std::to_string(digits) + "e" + std::to_string(exponent)).c_str(), nullptr);
    values[i] = codes[i] < 0 ? -value : value;
  }
  for (size_t i = 0; i < count; ++i) {
    if (field.contains("zero") && bitOf(streams.at(field["zero"]), i)) values[i] = 0;
    if (field.contains("missing") && bitOf(streams.at(field["missing"]), i))
      values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

DecodedMesh decodeMesh(const Json& description, const std::vector<Stream>& streams) {
  const auto streamOf = [&](const char* key) -> const Stream& { return streams.at(description["streams"][key]); };
  const Walk walk(streamOf("symbols"), streamOf("references"), description["faceCount"]);
  if (!walk.areReferencesUsed()) fail("references are left");
  if (walk.gateCount() != description["gateCount"]) fail("gateCount");
  if (walk.parallelograms.size() != description["vertexCount"]) fail("vertexCount");
  DecodedMesh mesh{.description = description, .faces = walk.faces};
  const size_t vertexCount = walk.parallelograms.size(), faceCount = walk.faces.size();
  mesh.positions.resize(vertexCount);
  for (size_t axis = 0; axis < 3; ++axis) {
    constexpr const char* kAxes[]{"x", "y", "z"};
    const std::vector<int64_t> differences = differencesOf(streamOf(kAxes[axis]), vertexCount);
    std::vector<int64_t> steps(vertexCount);
    for (size_t i = 0; i < vertexCount; ++i) {
      const auto [s, e, o] = walk.parallelograms[i];
      const int64_t predicted = s != e ? steps[s] + steps[e] - steps[o] : i == 0 ? 0 : steps[i - 1];
      steps[i] = (predicted + differences[i]) & 0xffff;
      mesh.positions[i][axis] =
          description["boxMin"][axis].get<double>() + static_cast<double>(steps[i]) * description["step"].get<double>();
    }
  }
  const std::vector<int64_t> differences = differencesOf(streamOf("faces"), faceCount);
  for (size_t i = 0; i < faceCount; ++i)
    mesh.faceIds.push_back(static_cast<uint32_t>((i == 0 ? 0 : mesh.faceIds[walk.inFront[i][0]]) + differences[i]));
  for (const Json& field : description["fields"]) mesh.fields[field["name"]] = decodeField(field, walk, streams);
  if (description.contains("thin") && description["thin"].contains("surface"))
    mesh.thinSurface.push_back(decodeMesh(description["thin"]["surface"], streams));
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
    const std::string tag = "<script type=\"application/octet-stream\" id=\"stream-" + std::to_string(i) + "\">";
    if (html.find(tag) == std::string::npos) break;
    page.streams.push_back(inflated(fromBase64(elementText(html, tag))));
  }
  for (const Json& mesh : page.json["meshes"]) page.meshes.push_back(decodeMesh(mesh, page.streams));
  return page;
}

}  // namespace asdfvk::test

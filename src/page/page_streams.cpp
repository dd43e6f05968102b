#include "page/page_streams.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <new>
#include <string_view>

#include "core/base64_stream.h"
#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Level 6 takes 40 % more time for 1 % fewer bytes of a mesh of 1,000,000 faces.
constexpr int kLevel = 5;

}  // namespace

Bytes deflated(const Bytes& bytes) {
  z_stream stream{};
  constexpr int kWindowBits = 15, kMemoryLevel = 9;
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kWindowBits, kMemoryLevel, Z_FILTERED) != Z_OK) throw std::bad_alloc();
  Bytes result(deflateBound(&stream, static_cast<uLong>(bytes.size())));
  size_t read = 0, written = 0;
  int status = Z_OK;
  while (status == Z_OK) {  // zlib counts in 32 bits.
    constexpr size_t kMaxStep = size_t{1} << 30;
    const size_t in = std::min(bytes.size() - read, kMaxStep), out = std::min(result.size() - written, kMaxStep);
    stream.next_in = const_cast<Bytef*>(bytes.data() + read);
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = result.data() + written;
    stream.avail_out = static_cast<uInt>(out);
    status = deflate(&stream, read + in == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    read += in - stream.avail_in;
    written += out - stream.avail_out;
  }
  deflateEnd(&stream);
  ASDFVK_CHECK_OP(status, ==, Z_STREAM_END);
  result.resize(written);
  result.shrink_to_fit();
  return result;
}

Bytes bytePlanesOf(std::span<const uint32_t> numbers) {
  uint32_t all = 0;
  for (const uint32_t number : numbers) all |= number;
  Bytes planes;
  for (int shift = 0; shift < 32 && (shift == 0 || all >> shift != 0); shift += 8) {
    const size_t begin = planes.size();
    planes.resize(begin + numbers.size());
    for (size_t i = 0; i < numbers.size(); ++i) planes[begin + i] = static_cast<uint8_t>(numbers[i] >> shift);
  }
  return planes;
}

Bytes bitsOf(std::span<const uint8_t> entries) {
  Bytes bits((entries.size() + 7) / 8, 0);
  for (size_t i = 0; i < entries.size(); ++i)
    if (entries[i] != 0) bits[i / 8] = static_cast<uint8_t>(bits[i / 8] | 1u << i % 8);
  return bits;
}

std::vector<uint32_t> PageStreams::add(std::span<const std::function<Bytes()>> sources) {
  std::vector<Bytes> compressed(sources.size());
  forEachTask(sources.size(), [&](size_t i) { compressed[i] = deflated(sources[i]()); });
  std::vector<uint32_t> numbers;
  for (Bytes& stream : compressed) {
    const uint64_t hash = std::hash<std::string_view>{}({reinterpret_cast<const char*>(stream.data()), stream.size()});
    const auto [first, last] = numbersByHash_.equal_range(hash);
    const auto same = std::find_if(first, last, [&](const auto& entry) { return streams_[entry.second] == stream; });
    if (same != last) {
      numbers.push_back(same->second);
      continue;
    }
    numbers.push_back(static_cast<uint32_t>(streams_.size()));
    numbersByHash_.emplace(hash, numbers.back());
    streams_.push_back(std::move(stream));
  }
  return numbers;
}

std::vector<size_t> PageStreams::sizes() const {
  std::vector<size_t> sizes;
  for (const Bytes& stream : streams_) sizes.push_back(stream.size());
  return sizes;
}

void PageStreams::write(AtomicFile& file) const {
  for (size_t i = 0; i < streams_.size(); ++i) {
    file.write(fmt::format("<script type=\"application/octet-stream\" id=\"stream-{}\">", i));
    Base64Stream base64(file);
    base64.write(streams_[i]);
    base64.finish();
    file.write("</script>\n");
  }
}

}  // namespace asdfvk

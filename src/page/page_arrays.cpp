#include "page/page_arrays.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <new>

#include "core/base64_stream.h"
#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Compression level. For a mesh of 1,000,000 faces, level 6 takes 40 % more time for 1 % fewer bytes.
constexpr int kLevel = 5;

/// Maps 0, -1, 1, -2, ... to 0, 1, 2, 3, ..., so that small numbers of both signs have zeros in their upper bytes.
constexpr uint32_t zigzag(int32_t number) {
  return static_cast<uint32_t>(number) << 1 ^ static_cast<uint32_t>(number >> 31);
}

/// Byte planes: the lowest bytes of all numbers, then the next bytes, up to the highest byte that is not 0 everywhere.
Bytes planesOf(std::span<const int32_t> numbers) {
  uint32_t all = 0;
  for (const int32_t number : numbers) all |= zigzag(number);
  Bytes planes;
  for (int shift = 0; shift < 32 && (shift == 0 || all >> shift != 0); shift += 8)
    for (const int32_t number : numbers) planes.push_back(static_cast<uint8_t>(zigzag(number) >> shift));
  return planes;
}

}  // namespace

Bytes deflated(const Bytes& bytes) {
  z_stream stream{};
  constexpr int kWindowBits = 15, kMemoryLevel = 9;
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kWindowBits, kMemoryLevel, Z_FILTERED) != Z_OK) throw std::bad_alloc();
  Bytes result(deflateBound(&stream, static_cast<uLong>(bytes.size())));
  size_t read = 0, written = 0;
  int status = Z_OK;
  while (status == Z_OK) {  // Compresses in steps, because zlib counts bytes in 32 bits.
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

std::vector<uint32_t> PageArrays::add(std::span<const Source> sources) {
  std::vector<Bytes> compressed(sources.size());
  forEachTask(sources.size(), [&](size_t i) { compressed[i] = deflated(planesOf(sources[i]())); });
  std::vector<uint32_t> numbers;
  for (Bytes& array : compressed) {
    const auto same = std::find(arrays_.begin(), arrays_.end(), array);
    numbers.push_back(static_cast<uint32_t>(same - arrays_.begin()));
    if (same == arrays_.end()) arrays_.push_back(std::move(array));
  }
  return numbers;
}

void PageArrays::write(AtomicFile& file) const {
  for (size_t i = 0; i < arrays_.size(); ++i) {
    file.write(fmt::format("<script type=\"application/octet-stream\" id=\"array-{}\">", i));
    Base64Stream base64(file);
    base64.write(arrays_[i]);
    base64.finish();
    file.write("</script>\n");
  }
}

}  // namespace asdfvk

#include "io/inflater.h"

#include <algorithm>
#include <new>

namespace asdfvk {

Inflater::Inflater(int windowBits) {
  if (inflateInit2(&stream_, windowBits) != Z_OK) throw std::bad_alloc();
}

Inflater::~Inflater() { inflateEnd(&stream_); }

size_t Inflater::inflatePiece(std::span<const char>& from, char* to, size_t size) {
  constexpr size_t kMaxStep = size_t{1} << 30;  // zlib counts in 32 bits.
  const size_t given = std::min(from.size(), kMaxStep), wanted = std::min(size, kMaxStep);
  stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(from.data()));
  stream_.avail_in = static_cast<uInt>(given);
  stream_.next_out = reinterpret_cast<Bytef*>(to);
  stream_.avail_out = static_cast<uInt>(wanted);
  result_ = inflate(&stream_, Z_NO_FLUSH);
  if (result_ == Z_MEM_ERROR) throw std::bad_alloc();
  from = from.subspan(given - stream_.avail_in);
  return wanted - stream_.avail_out;
}

}  // namespace asdfvk

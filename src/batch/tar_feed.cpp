#include "batch/tar_feed.h"

#include <fmt/core.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "asdf_vk/error.h"
#include "batch/tar_names.h"

namespace asdfvk {
namespace {

constexpr uint64_t kPieceBytes = uint64_t{1} << 20;

std::exception_ptr memberFailure(ErrorCode code, const std::string& reason) {
  return std::make_exception_ptr(Error(code, reason));
}

/// Why a member with the name of a mesh is not computed; null if it is.
std::exception_ptr flawOfMesh(const TarMember& member, uint64_t maxBytes) {
  if (member.kind != TarMember::Kind::File)
    return memberFailure(
        ErrorCode::UnreadableInput,
        member.target.empty()
            ? std::string("is not a file")
            : fmt::format("is a link to {}; tar --dereference --hard-dereference packs the file", member.target));
  if (member.byteCount <= maxBytes) return nullptr;
  return memberFailure(ErrorCode::InputTooLarge,
                       fmt::format("has {} bytes; a mesh in a tar may have {}; compute it as a file of its own",
                                   member.byteCount, maxBytes));
}

}  // namespace

TarFeed::TarFeed(TarFeedOptions options, std::stop_token stop)
    : options_(std::move(options)), outer_(std::move(stop)), arrival_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (arrival_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  reader_ = std::jthread([this](const std::stop_token& ending) {
    const auto forward = [this] { stop_.request_stop(); };
    const std::stop_callback fromOuter(outer_, forward);
    const std::stop_callback fromOwner(ending, forward);
    readAll();
  });
}

TarFeed::~TarFeed() {
  reader_ = {};
  ::close(arrival_);
}

std::optional<TarItem> TarFeed::take() {
  const std::lock_guard lock(mutex_);
  if (arrived_.empty()) {
    uint64_t count = 0;
    [[maybe_unused]] const ssize_t ignored = ::read(arrival_, &count, sizeof(count));  // Fails without a signal.
    return std::nullopt;
  }
  TarItem item = std::move(arrived_.front());
  arrived_.pop_front();
  return item;
}

bool TarFeed::isEnded() const {
  const std::lock_guard lock(mutex_);
  return isRead_ && arrived_.empty();
}

void TarFeed::replaceBytes(uint64_t ofItem, uint64_t ofAnswer) {
  const std::lock_guard lock(mutex_);
  byteCount_ += ofAnswer - ofItem;
  greatestByteCount_ = std::max(greatestByteCount_, byteCount_);
  hasRoom_.notify_one();
}

void TarFeed::release(uint64_t byteCount) {
  const std::lock_guard lock(mutex_);
  --itemCount_;
  byteCount_ -= byteCount;
  hasRoom_.notify_one();
}

size_t TarFeed::greatestItemCount() const {
  const std::lock_guard lock(mutex_);
  return greatestItemCount_;
}

uint64_t TarFeed::greatestByteCount() const {
  const std::lock_guard lock(mutex_);
  return greatestByteCount_;
}

void TarFeed::waitForRoom(uint64_t byteCount) {
  std::unique_lock lock(mutex_);
  const bool hasRoom = hasRoom_.wait(lock, stop_.get_token(), [&] {
    return itemCount_ == 0 || (itemCount_ < options_.maxItems && byteCount_ + byteCount <= options_.maxBytes);
  });
  if (!hasRoom) throw Error(ErrorCode::Cancelled, "cancelled");
  greatestItemCount_ = std::max(greatestItemCount_, ++itemCount_);
  greatestByteCount_ = std::max(greatestByteCount_, byteCount_ += byteCount);
}

void TarFeed::add(TarItem item) {
  const std::lock_guard lock(mutex_);
  arrived_.push_back(std::move(item));
  signalArrival();
}

void TarFeed::signalArrival() const {
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t ignored = ::write(arrival_, &one, sizeof(one));
}

void TarFeed::readAll() {
  try {
    for (size_t i = 0; i < options_.paths.size(); ++i) readTar(i);
  } catch (...) {  // A stop request. The owner takes no further item.
  }
  const std::lock_guard lock(mutex_);
  isRead_ = true;
  signalArrival();
}

void TarFeed::readTar(size_t index) {
  const auto addPlain = [&](TarItem item) {
    waitForRoom(0);
    item.tar = index;
    add(std::move(item));
  };
  addPlain({.kind = TarItem::Kind::Begin});
  TarItem end{.kind = TarItem::Kind::End};
  try {
    TarReader reader(options_.paths[index], stop_.get_token());
    TakenNames taken;
    while (std::optional<TarMember> member = reader.next()) readMember(reader, index, std::move(*member), taken);
    end.hash = reader.hash();
  } catch (...) {
    if (stop_.stop_requested()) throw;
    end.failure = std::current_exception();
  }
  addPlain(std::move(end));
}

void TarFeed::readMember(TarReader& reader, size_t tar, TarMember member, TakenNames& taken) {
  const bool isSafe = isSafeMember(member.name);
  const bool isMesh = isMeshMember(member.name) && member.kind != TarMember::Kind::Folder;
  const auto addFailed = [&](std::string stem, std::exception_ptr failure) {
    waitForRoom(0);
    add({.kind = TarItem::Kind::Failed,
         .tar = tar,
         .member = member,
         .stem = std::move(stem),
         .failure = std::move(failure)});
  };
  if (!isSafe && (isMesh || options_.copiesMembers))
    return addFailed("", memberFailure(ErrorCode::UnreadableInput,
                                       "its name leads out of the folder of the tar; give it a relative name "
                                       "without .."));
  if (!isMesh) {
    if (options_.copiesMembers && member.kind != TarMember::Kind::Other) copyMember(reader, tar, member);
    return;
  }
  if (!taken.names.insert(member.name).second)
    return addFailed("", memberFailure(ErrorCode::UnreadableInput, "its name occurs twice in the tar; rename one"));
  const std::string key = sampleKeyOf(member.name);
  const bool isFirst = taken.keys.insert(key).second;
  const std::string stem = (isFirst ? key : member.name) + (options_.copiesMembers ? ".asdf" : "");
  if (const std::exception_ptr flaw = flawOfMesh(member, options_.maxMeshBytes)) {
    if (options_.copiesMembers && member.kind != TarMember::Kind::Other) copyMember(reader, tar, member);
    return addFailed(stem, flaw);
  }
  const uint64_t byteCount = member.byteCount;
  waitForRoom(byteCount);
  std::string bytes = bytesOf(reader, byteCount);
  if (options_.copiesMembers) {
    add({.kind = TarItem::Kind::Copy, .tar = tar, .member = member, .bytes = bytes});
    waitForRoom(byteCount);
  }
  add({.kind = TarItem::Kind::Mesh, .tar = tar, .member = std::move(member), .bytes = std::move(bytes), .stem = stem});
}

void TarFeed::copyMember(TarReader& reader, size_t tar, const TarMember& member) {
  waitForRoom(0);
  add({.kind = TarItem::Kind::Copy, .tar = tar, .member = member});
  for (uint64_t left = member.byteCount; left > 0;) {
    const uint64_t count = std::min(left, kPieceBytes);
    waitForRoom(count);
    add({.kind = TarItem::Kind::Piece, .tar = tar, .bytes = bytesOf(reader, count)});
    left -= count;
  }
}

std::string TarFeed::bytesOf(TarReader& reader, uint64_t byteCount) {
  std::string bytes;
  while (bytes.size() < byteCount) {  // The stated size may be wrong.
    const size_t begin = bytes.size();
    bytes.resize(std::min(byteCount, begin + kPieceBytes));
    const size_t count = reader.read(bytes.data() + begin, bytes.size() - begin);
    if (begin + count < bytes.size()) throw Error(ErrorCode::UnreadableInput, "a member is shorter than it states");
  }
  return bytes;
}

}  // namespace asdfvk

#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <unordered_set>
#include <vector>

#include "batch/tar_file.h"

namespace asdfvk {

/// A step of the output, in the order of the input.
struct TarItem {
  enum class Kind {
    Begin,   ///< A tar begins.
    Mesh,    ///< A mesh, with its bytes.
    Failed,  ///< A member that is not computed, because of `failure`.
    Copy,    ///< A member that is copied, with its first bytes.
    Piece,   ///< The next bytes of the copied member.
    End,     ///< A tar ends. failure: null if all of it was read.
  };

  Kind kind = Kind::Begin;
  size_t tar = 0;  ///< Index in TarFeedOptions::paths.
  TarMember member = {};
  std::string bytes = {};
  /// Common beginning of the names of the answers: the key of the sample. For a further mesh with the key: the name of
  /// the member. ".asdf" is appended if members are copied, because their names are taken. Empty: no answer.
  std::string stem = {};
  std::exception_ptr failure = nullptr;
  std::string hash = {};  ///< contentHash() of a tar that ended without a failure.
};

struct TarFeedOptions {
  std::vector<std::string> paths;  ///< "-" is standard input.
  bool copiesMembers = false;      ///< Copies all members; otherwise only meshes become items.
  uint64_t maxMeshBytes = uint64_t{1} << 30;
  /// The window: items that were taken or can be taken, and are not released. An item with more bytes waits until it is
  /// the only one.
  size_t maxItems = 256;
  uint64_t maxBytes = uint64_t{256} << 20;
};

/// Reads tars one after another, in a thread of its own, while the window has room.
class TarFeed {
 public:
  TarFeed(TarFeedOptions options, std::stop_token stop);
  ~TarFeed();
  TarFeed(const TarFeed&) = delete;
  TarFeed& operator=(const TarFeed&) = delete;

  /// A descriptor for poll() that is readable if take() may return an item, or the last tar has ended.
  [[nodiscard]] int descriptor() const { return arrival_; }
  /// Returns the next item if it has arrived.
  [[nodiscard]] std::optional<TarItem> take();
  /// Whether all items were taken.
  [[nodiscard]] bool isEnded() const;
  /// An answer with this number of bytes takes the place of the bytes of an item.
  void replaceBytes(uint64_t ofItem, uint64_t ofAnswer);
  /// An item leaves the window. byteCount: of the item or its answer.
  void release(uint64_t byteCount);

  /// The greatest window so far.
  [[nodiscard]] size_t greatestItemCount() const;
  [[nodiscard]] uint64_t greatestByteCount() const;

 private:
  /// The names and keys of the meshes of a tar.
  struct TakenNames {
    std::unordered_set<std::string> names, keys;
  };

  void readAll();
  void readTar(size_t index);
  void readMember(TarReader& reader, size_t tar, TarMember member, TakenNames& taken);
  void copyMember(TarReader& reader, size_t tar, const TarMember& member);
  [[nodiscard]] static std::string bytesOf(TarReader& reader, uint64_t byteCount);
  /// Waits until the window has room for an item. Throws Error{Cancelled} after a stop request.
  void waitForRoom(uint64_t byteCount);
  void add(TarItem item);
  void signalArrival() const;

  const TarFeedOptions options_;
  const std::stop_token outer_;
  int arrival_;
  mutable std::mutex mutex_;
  std::condition_variable_any hasRoom_;
  std::deque<TarItem> arrived_;
  size_t itemCount_ = 0, greatestItemCount_ = 0;
  uint64_t byteCount_ = 0, greatestByteCount_ = 0;
  bool isRead_ = false;
  std::stop_source stop_;
  /// Last member, because the thread uses the other members.
  std::jthread reader_;
};

}  // namespace asdfvk

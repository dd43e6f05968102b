#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "asdf_vk/asdf_vk_c.h"
#include "asdf_vk/scene.h"
#include "asdf_vk/session.h"
#include "core/json.h"
#include "describe/session_options.h"

// The types behind the handles of asdf_vk_c.h.

struct asdf_vk_options {
  static constexpr const char* kType = "set of options";
  std::map<std::string, std::string, std::less<>> texts;  ///< Values of options, by name.
};

struct asdf_vk_session {
  static constexpr const char* kType = "session";
  asdfvk::SessionSettings settings;
  std::unique_ptr<asdfvk::Session> session;
  std::string device;
  std::recursive_mutex mutex;  ///< Recursive, so that a progress function can destroy other scenes of the session.
  bool isBusy = false;         ///< True while a SessionUse exists.
  std::mutex releasedMutex;
  /// Scenes that were destroyed during a computation of another thread; released after the computation.
  std::list<asdfvk::Scene> released;
};

struct asdf_vk_scene {
  static constexpr const char* kType = "scene";
  std::shared_ptr<asdf_vk_session> session;
  std::shared_ptr<const asdfvk::Mesh> mesh;
  asdfvk::Orientation orientation = asdfvk::Orientation::Keep;
  /// Empty before the first computation. The type is a list, because list elements can be moved to
  /// asdf_vk_session::released without an allocation.
  std::list<asdfvk::Scene> prepared;

  asdf_vk_scene(std::shared_ptr<asdf_vk_session> s, asdfvk::Mesh m)
      : session(std::move(s)), mesh(std::make_shared<const asdfvk::Mesh>(std::move(m))) {}
  asdf_vk_scene(const asdf_vk_scene&) = delete;
  asdf_vk_scene& operator=(const asdf_vk_scene&) = delete;
  /// Does not wait for a computation, because a garbage collector may call the destructor.
  ~asdf_vk_scene() {
    const std::unique_lock lock(session->mutex, std::try_to_lock);
    if (lock.owns_lock()) {
      prepared.clear();
    } else {
      const std::scoped_lock listLock(session->releasedMutex);
      session->released.splice(session->released.end(), prepared);
    }
  }
};

struct asdf_vk_result {
  static constexpr const char* kType = "result";
  std::shared_ptr<const asdfvk::Mesh> mesh;
  asdfvk::ComputationSettings computation;
  asdfvk::SessionSettings session;
  asdfvk::Result result;
  std::mutex mutex;
  asdfvk::Json report;                       ///< JSON null before the first asdf_vk_result_json().
  std::map<std::string, std::string> texts;  ///< The texts that asdf_vk_result_json() returned, by JSON Pointer.
};

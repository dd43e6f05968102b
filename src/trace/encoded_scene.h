#pragma once

namespace asdfvk {

/// A scene in the layout of one kind of tracers. It is encoded before the device of the tracers is open.
struct EncodedScene {
  EncodedScene() = default;
  virtual ~EncodedScene() = default;
  EncodedScene(const EncodedScene&) = delete;
  EncodedScene& operator=(const EncodedScene&) = delete;
};

}  // namespace asdfvk

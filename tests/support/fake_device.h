#pragma once

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asdfvk::test {

/// An environment variable with another value, or without one, while this exists.
class ScopedVariable {
 public:
  ScopedVariable(std::string name, const std::optional<std::string>& value)
      : name_(std::move(name)), before_(valueOf(name_)) {
    set(value);
  }
  ~ScopedVariable() { set(before_); }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

  [[nodiscard]] static std::optional<std::string> valueOf(const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  }

 private:
  void set(const std::optional<std::string>& value) {
    if (value)
      ::setenv(name_.c_str(), value->c_str(), 1);
    else
      ::unsetenv(name_.c_str());
  }

  std::string name_;
  std::optional<std::string> before_;
};

/// While this exists, new instances have the layer of tests/fake_device, whose variables (settings.h there) have the
/// given values; variables that are not given keep theirs.
class FakeDevice {
 public:
  using Variables = std::vector<std::pair<std::string, std::string>>;

  explicit FakeDevice(const Variables& variables) {
    const std::string layers = ScopedVariable::valueOf("VK_INSTANCE_LAYERS").value_or("");
    if (layers.find(kFakeLayer) == std::string::npos) {
      // The validation layer sees the device that the program sees where it comes first: in the list for new loaders,
      // in the folders for that of Debian 12.
      set("VK_INSTANCE_LAYERS", std::string("VK_LAYER_KHRONOS_validation:") + kFakeLayer);
      const std::string folder = std::string(":") + ASDFVK_FAKE_DEVICE_DIR;
      if (const std::optional<std::string> folders = ScopedVariable::valueOf("VK_LAYER_PATH"))
        set("VK_LAYER_PATH", *folders + folder);
      else
        set("VK_ADD_LAYER_PATH", "/usr/share/vulkan/explicit_layer.d" + folder);
    }
    for (const auto& [name, value] : variables) set(name, value);
  }

 private:
  void set(const std::string& name, const std::string& value) {
    changes_.push_back(std::make_unique<ScopedVariable>(name, value));
  }

  static constexpr const char* kFakeLayer = "VK_LAYER_ASDFVK_fake_device";

  std::vector<std::unique_ptr<ScopedVariable>> changes_;
};

}  // namespace asdfvk::test

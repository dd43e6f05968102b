#pragma once

#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace asdfvk {

template <typename Signature>
class FunctionRef;

/// A reference to a callable object, which must outlive the reference. A function with a FunctionRef parameter needs no
/// template and can be defined in a .cpp file. Unlike std::function, a FunctionRef allocates no memory.
template <typename Result, typename... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <typename Callable>
  requires(!std::same_as<std::remove_cvref_t<Callable>, FunctionRef> &&
           std::is_invocable_r_v<Result, Callable&, Arguments...>) FunctionRef(Callable&& callable)
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_([](void* object, Arguments... arguments) -> Result {
          return (*static_cast<std::remove_reference_t<Callable>*>(object))(std::forward<Arguments>(arguments)...);
        }) {}

  Result operator()(Arguments... arguments) const { return call_(object_, std::forward<Arguments>(arguments)...); }

 private:
  void* object_;
  Result (*call_)(void*, Arguments...);
};

}  // namespace asdfvk

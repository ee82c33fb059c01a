// A large object's new value, made in its place: returned by value and assigned, it would lie on the stack as well.
#pragma once

#include <new>
#include <type_traits>

namespace lasso {

// `make` returns the value, and must not read `object`.
template <class T, class Make>
void renew(T& object, const Make& make) {
  static_assert(std::is_trivially_destructible_v<T>, "the value before needs no end");
  ::new (static_cast<void*>(&object)) T(make());
}

}  // namespace lasso

// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <memory>
#include <type_traits>

namespace ph::detail {

/// A value that a function makes when it is first needed. If several threads need it at once, each
/// of them makes one, and the first of these values stays.
///
/// A static variable of a function has a lock instead. If a process forks while another of its
/// threads holds such a lock, the child waits forever for a thread that it does not have.
template <class Make>
class OnFirstUse {
 public:
  using Value = std::invoke_result_t<const Make&>;

  constexpr explicit OnFirstUse(Make make) : make_(make) {}

  Value& operator*() {
    Value* value = value_.load(std::memory_order_acquire);
    if (value != nullptr) return *value;
    std::unique_ptr<Value> made(new Value(make_()));
    if (!value_.compare_exchange_strong(value, made.get(), std::memory_order_acq_rel,
                                        std::memory_order_acquire))
      return *value;
    return *made.release();
  }

 private:
  Make make_;
  // The value lives as long as the process, because other static objects may use it at the end.
  std::atomic<Value*> value_ = nullptr;
};

}  // namespace ph::detail

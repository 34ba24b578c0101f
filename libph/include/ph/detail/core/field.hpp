// SPDX-License-Identifier: MIT
#pragma once
#include <compare>
#include <cstdint>

namespace ph {

/// A field of coefficients, with seven operations. An `Element` is a small value; zero is never
/// stored in a chain. `from_int` maps an incidence number to the field; `to_int` maps an element to
/// the integer that the user sees.
template <class K>
concept Field = requires(const K& k, typename K::Element a, typename K::Element b) {
  { k.from_int(1) } -> std::same_as<typename K::Element>;
  { k.to_int(a) } -> std::same_as<std::int64_t>;
  { k.is_zero(a) } -> std::same_as<bool>;
  { k.add(a, b) } -> std::same_as<typename K::Element>;
  { k.negate(a) } -> std::same_as<typename K::Element>;
  { k.multiply(a, b) } -> std::same_as<typename K::Element>;
  { k.inverse(a) } -> std::same_as<typename K::Element>;
};

/// The field of two elements. Arithmetic is on the lowest bit.
struct Z2 {
  using Element = bool;
  static constexpr Element from_int(int value) { return (value & 1) != 0; }
  static constexpr std::int64_t to_int(Element a) { return a ? 1 : 0; }
  static constexpr bool is_zero(Element a) { return !a; }
  static constexpr Element add(Element a, Element b) { return a != b; }
  static constexpr Element negate(Element a) { return a; }
  static constexpr Element multiply(Element a, Element b) { return a && b; }
  static constexpr Element inverse(Element a) { return a; }
};

/// The prime field of `p` elements, `p` chosen at run time.
class Zp {
 public:
  using Element = std::uint32_t;

  /// @param p a prime below 2^31. @throws Error (usage) otherwise.
  explicit Zp(std::int64_t p);

  std::int64_t characteristic() const { return p_; }
  Element from_int(int value) const {
    const std::int64_t r = value % p_;
    return static_cast<Element>(r < 0 ? r + p_ : r);
  }
  /// The representative between -p/2 and p/2.
  std::int64_t to_int(Element a) const { return a > p_ / 2 ? a - p_ : std::int64_t{a}; }
  static bool is_zero(Element a) { return a == 0; }
  Element add(Element a, Element b) const {
    const std::int64_t s = std::int64_t{a} + b;
    return static_cast<Element>(s >= p_ ? s - p_ : s);
  }
  Element negate(Element a) const { return a == 0 ? 0 : static_cast<Element>(p_ - a); }
  Element multiply(Element a, Element b) const {
    return static_cast<Element>(std::uint64_t{a} * b % static_cast<std::uint64_t>(p_));
  }
  Element inverse(Element a) const;  ///< precondition: `a` is not zero

 private:
  std::int64_t p_;
};

/// True if `p` can be the characteristic of a field here: a prime below 2^31.
bool is_field_characteristic(std::int64_t p);
/// @throws Error (usage) if `p` is not the characteristic of a field here.
void require_field(std::int64_t p);

namespace detail {

/// Calls `use(field)` with the field of the given characteristic. @throws Error (usage) if there is
/// no such field.
template <class Use>
decltype(auto) with_field(std::int64_t characteristic, Use&& use) {
  if (characteristic == 2) return use(Z2{});
  return use(Zp(characteristic));
}

}  // namespace detail

}  // namespace ph

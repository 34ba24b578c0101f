// SPDX-License-Identifier: MIT
#include "ph/detail/core/field.hpp"

#include <string>
#include <utility>

#include "ph/error.hpp"

namespace ph {

bool is_field_characteristic(std::int64_t p) {
  if (p < 2 || p >= (std::int64_t{1} << 31)) return false;
  for (std::int64_t d = 2; d * d <= p; ++d)
    if (p % d == 0) return false;
  return true;
}

void require_field(std::int64_t p) {
  if (!is_field_characteristic(p))
    throw Error(ErrorKind::usage,
                "field: found " + std::to_string(p) + ", expected a prime below 2^31");
}

Zp::Zp(std::int64_t p) : p_(p) { require_field(p); }

Zp::Element Zp::inverse(Element a) const {
  // In each step of the extended Euclidean algorithm, r = s * a (mod p).
  std::int64_t r0 = p_, r1 = a, s0 = 0, s1 = 1;
  while (r1 != 0) {
    const std::int64_t q = r0 / r1;
    r0 = std::exchange(r1, r0 - q * r1);
    s0 = std::exchange(s1, s0 - q * s1);
  }
  return static_cast<Element>(s0 < 0 ? s0 + p_ : s0);  // mutant: inverse-sign
}

}  // namespace ph

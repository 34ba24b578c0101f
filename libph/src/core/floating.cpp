// SPDX-License-Identifier: MIT
#include "ph/detail/core/floating.hpp"

#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/core/on_first_use.hpp"

namespace ph {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

const char* end_of_digits(const char* at, const char* last) {
  return std::find_if_not(at, last, is_digit);
}

/// True if the text begins with `word`, in upper or lower case. Precondition: `word` is in lower
/// case.
bool begins_with(const char* at, const char* last, std::string_view word) {
  if (last - at < static_cast<std::ptrdiff_t>(word.size())) return false;
  return std::equal(word.begin(), word.end(), at,
                    [](char small, char c) { return to_lower(c) == small; });
}

/// The end of a payload after "nan", which consists of letters, digits and _ in parentheses. If
/// there is no payload, returns `at`.
const char* end_of_payload(const char* at, const char* last) {
  if (at == last || *at != '(') return at;
  const char* const end = std::find_if_not(
      at + 1, last, [](char c) { return is_digit(c) || is_letter(c) || c == '_'; });
  return end != last && *end == ')' ? end + 1 : at;
}

/// The end of the longest number that begins at `first`, or `first` if there is none. Blanks, a
/// plus sign and hexadecimal digits, which strtod accepts, are not part of a number.
const char* end_of_number(const char* first, const char* last) {
  const char* at = first;
  if (at != last && *at == '-') ++at;
  if (begins_with(at, last, "infinity")) return at + 8;
  if (begins_with(at, last, "inf")) return at + 3;
  if (begins_with(at, last, "nan")) return end_of_payload(at + 3, last);
  const char* const whole = end_of_digits(at, last);
  std::ptrdiff_t digits = whole - at;
  at = whole;
  if (at != last && *at == '.') {
    const char* const fraction = end_of_digits(at + 1, last);
    digits += fraction - (at + 1);
    at = fraction;
  }
  if (digits == 0) return first;
  if (at == last || (*at != 'e' && *at != 'E')) return at;
  const char* exponent = at + 1;
  if (exponent != last && (*exponent == '-' || *exponent == '+')) ++exponent;
  const char* const end = end_of_digits(exponent, last);
  return end == exponent ? at : end;
}

bool is_zero(std::string_view number) {
  const std::string_view digits = number.substr(0, number.find_first_of("eE"));
  return digits.find_first_of("123456789") == digits.npos;
}

// Returns the C locale, because the calling program may have set a locale with a decimal comma.
locale_t c_locale() {
  static constinit detail::OnFirstUse c([] { return newlocale(LC_ALL_MASK, "C", nullptr); });
  return *c;
}
double strtod_in_c(const char* text, double) { return strtod_l(text, nullptr, c_locale()); }
float strtod_in_c(const char* text, float) { return strtof_l(text, nullptr, c_locale()); }

template <class T>
std::from_chars_result read(const char* first, const char* last, T& value) {
  const char* const end = end_of_number(first, last);
  if (end == first) return {first, std::errc::invalid_argument};
  const auto size = static_cast<std::size_t>(end - first);
  // strtod needs a terminating zero. Most numbers are short enough for an array on the stack.
  std::array<char, 64> few{};
  std::string many;
  const char* text = few.data();
  if (size < few.size()) {
    std::copy(first, end, few.begin());
  } else {
    text = many.assign(first, end).c_str();
  }
  const T result = strtod_in_c(text, T{});
  const bool is_decimal = is_digit(end[-1]) || end[-1] == '.';
  if (is_decimal && (std::isinf(result) || (result == 0 && !is_zero({first, size}))))
    return {end, std::errc::result_out_of_range};
  value = result;
  return {end, std::errc{}};
}

}  // namespace

std::from_chars_result floating_by_strtod(const char* first, const char* last, float& value) {
  return read(first, last, value);
}
std::from_chars_result floating_by_strtod(const char* first, const char* last, double& value) {
  return read(first, last, value);
}

}  // namespace ph

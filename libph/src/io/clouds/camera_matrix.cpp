// SPDX-License-Identifier: MIT
// Reads camera matrices as plain numbers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "libph/src/io/clouds/camera_file.hpp"
#include "ph/detail/core/floating.hpp"
#include "ph/error.hpp"

namespace ph::detail {

std::string way_to_intrinsics() {
  return mark(Setting::intrinsics, "FX,FY,CX,CY") + " gives the numbers of a pinhole camera";
}

Intrinsics intrinsics_of(std::span<const double, 9> k,
                         const std::function<void(const Fault&)>& fail) {
  if (!(k[0] > 0 && k[4] > 0)) {
    fail({"focal lengths", fmt::format("{} and {}", k[0], k[4]), "numbers above 0",
          "a camera that is not calibrated has 0; " + way_to_intrinsics()});
  }
  if (k[1] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1) {
    fail({"camera matrix", fmt::format("{}", fmt::join(k, ", ")), "fx, 0, cx, 0, fy, cy, 0, 0, 1",
          way_to_intrinsics()});
  }
  return {k[0], k[4], k[2], k[5]};
}

Camera read_matrix_camera(const Input& input) {
  const std::string_view text = input.text();
  const auto fail = [&](std::size_t at, const Fault& fault) {
    const std::string_view before = text.substr(0, at);
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
    input.fail_at(static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1, at - start + 1,
                  fault);
  };
  constexpr std::string_view between = ",;[] \t\r\n";
  constexpr std::size_t small = 9, large = 16;
  std::vector<double> numbers;
  std::size_t first = 0;
  for (std::size_t at = 0; (at = text.find_first_not_of(between, at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(between, at), text.size());
    std::string_view word = text.substr(at, end - at);
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0;
    const auto [stop, error] = floating_from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || stop != word.data() + word.size() || !std::isfinite(number))
      fail(at, {"not a number", printable(word, 40), "a finite decimal number", {}});
    if (numbers.empty()) first = at;
    numbers.push_back(number);
    if (numbers.size() > large) break;
    at = end;
  }
  if (numbers.size() == large) {
    const auto& m = numbers;
    const bool is_padded = std::ranges::all_of(std::array{m[3], m[7], m[11], m[12], m[13], m[14]},
                                               [](double number) { return number == 0; }) &&
                           m[15] == 1;
    if (!is_padded)
      fail(first, {"camera matrix of 4 x 4", fmt::format("{}", fmt::join(m, ", ")),
                   "zeros and a one in the last row and the last column", way_to_intrinsics()});
    numbers = {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]};
  }
  if (numbers.size() != small)
    fail(first, {"camera matrix",
                 numbers.size() > large ? fmt::format("more than {} numbers", large)
                                        : fmt::format("{} numbers", numbers.size()),
                 "9 numbers, row by row: fx, 0, cx, 0, fy, cy, 0, 0, 1", way_to_intrinsics()});
  Camera camera;
  camera.intrinsics = intrinsics_of(std::span<const double, small>(numbers.data(), small),
                                    [&](const Fault& fault) { fail(first, fault); });
  return camera;
}

}  // namespace ph::detail

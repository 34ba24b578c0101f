// SPDX-License-Identifier: MIT
#include <optional>

#include "ph/error.hpp"
#include "tests/fuzz/chosen_numbers.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"
#include "tests/libph/alpha/exact_spheres.hpp"

namespace ph::fuzz {

void run_alpha_signs(std::string_view bytes) {
  ChosenNumbers choices(bytes);
  const Index coordinates = choices.choice(2) + 1, count = choices.choice(3) + 2;
  const bool weighted = choices.choice(1) == 1;
  const Points points = choices.points(count, coordinates);
  const std::vector<double> weights = weighted ? choices.numbers(count) : std::vector<double>();
  RunContext context;
  std::optional<alpha::Sites> sites;
  try {
    sites.emplace(alpha::sites_of(points, weights, context));
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::bad_data, "numbers are refused as bad data");
    return;
  }
  const std::string_view violation = test::Faces(*sites).violation();
  require(violation.empty(), violation.data());
}

}  // namespace ph::fuzz

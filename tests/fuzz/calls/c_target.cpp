// SPDX-License-Identifier: MIT
// Makes valid and invalid calls of the C interface, and compares them with the same calls of the
// C++ library.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "ph/error.hpp"
#include "ph/persistence.hpp"
#include "ph/ph.h"
#include "tests/fuzz/chosen_numbers.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

/// The outcome of the C++ library for the same input: a barcode or an error.
struct Expected {
  std::optional<Barcode> bars{};
  ph_status status = PH_OK;
};

ph_status status_of(const Error& error) {
  switch (error.kind()) {
    case ErrorKind::usage:
      return PH_USAGE;
    case ErrorKind::bad_data:
      return PH_BAD_DATA;
    case ErrorKind::resource:
      return PH_RESOURCE;
    default:
      throw Violation("the library says what no barcode has to do with");
  }
}

template <class Compute>
Expected expected_of(Compute&& compute) {
  try {
    return {compute()};
  } catch (const Error& error) {
    return {{}, status_of(error)};
  }
}

/// Usually one of the choices 0 to `last`, occasionally an invalid number.
std::int32_t choice_or_none(ChosenNumbers& chosen, int last) {
  if (chosen.choice(15) > 0) return chosen.choice(last);
  return chosen.coin() ? last + 1 : -1;
}

struct Call {
  ph_options options;
  std::array<std::uint8_t, 4> periodic{};
};

Call call_of(ChosenNumbers& chosen) {
  constexpr std::array<std::int64_t, 8> fields{2, 3, 5, 2147483647, 4, 1, 0, -3};
  constexpr std::array<std::int32_t, 8> dims{-1, 0, 1, 2, 3, 1, -2, 2147483647};
  Call call{};
  ph_options& o = call.options;
  ph_options_init(&o);
  o.field = fields[static_cast<std::size_t>(chosen.choice(chosen.choice(7)))];
  o.max_dim = dims[static_cast<std::size_t>(chosen.choice(chosen.choice(7)))];
  if (chosen.choice(7) == 0) o.min_dim = chosen.choice(4) - 1;
  if (chosen.coin()) o.threshold = chosen.number();
  if (chosen.choice(3) == 0) o.min_persistence = chosen.number();
  o.cells = chosen.choice(1);
  o.threads = chosen.choice(15) == 0 ? -1 : 1;
  o.distance = choice_or_none(chosen, PH_HAMMING);
  if (chosen.coin()) o.minkowski_p = chosen.number();
  o.construction = choice_or_none(chosen, PH_CELLS);
  o.superlevel = chosen.choice(1);
  o.masked = chosen.choice(1);
  for (std::uint8_t& p : call.periodic) p = chosen.choice(3) == 0 ? 1 : 0;
  return call;
}

Options task_of(const ph_options& o) {
  Options task;
  if (o.max_dim != -1) task.max_dim = o.max_dim;
  task.min_dim = o.min_dim;
  task.field = o.field;
  task.min_persistence = o.min_persistence;
  task.cells = o.cells != 0;
  return task;
}

std::optional<double> threshold_of(const ph_options& o) {
  if (std::isnan(o.threshold)) return std::nullopt;
  return o.threshold;
}

RipsOptions rips_of(const ph_options& o) {
  RipsOptions rips;
  rips.threshold = threshold_of(o);
  rips.distance = static_cast<PointDistance>(o.distance);
  rips.minkowski_p = o.minkowski_p;
  return rips;
}

/// True if the C interface refuses the options, either because C++ cannot express them or because
/// the result would silently have no bars.
bool names_nothing(const ph_options& o, bool of_points) {
  return o.max_dim < -1 || o.threads < 0 || (o.max_dim >= 0 && o.min_dim > o.max_dim) ||
         (of_points ? o.distance < 0 || o.distance > PH_HAMMING
                    : o.construction < 0 || o.construction > PH_CELLS);
}

void check_failure(ph_status status) {
  require(status == PH_USAGE || status == PH_BAD_DATA || status == PH_RESOURCE,
          "a call fails for a reason that it cannot have");
  const std::string_view words = ph_last_error();
  require(!words.empty() && words.find('\n') == std::string_view::npos, "an error has one line");
}

/// Compares the bars with the bars from C++. Also compares the cells if they were requested.
void check_bars(const ph_barcode* found, const Barcode& expected, bool cells) {
  require(ph_barcode_size(found) == expected.size(), "as many bars as from C++");
  const ph_bar* const bars = ph_barcode_bars(found);
  const auto is_cell = [](const std::int64_t* numbers, std::size_t count, const InputCell& cell) {
    return std::ranges::equal(std::span(numbers, count), cell.numbers);
  };
  for (std::size_t i = 0; i < expected.size(); ++i) {
    require(Bar{bars[i].dim, bars[i].birth, bars[i].death} == expected[i], "the bars of C++");
    const std::int64_t *birth = nullptr, *death = nullptr;
    const std::size_t of_birth = ph_barcode_birth_cell(found, i, &birth),
                      of_death = ph_barcode_death_cell(found, i, &death);
    if (!cells) {
      require(of_birth == 0 && of_death == 0, "cells that nobody asked for");
      continue;
    }
    require(is_cell(birth, of_birth, expected.birth_cell(i)), "births in the cells of C++");
    const auto killer = expected.death_cell(i);
    require(killer ? is_cell(death, of_death, *killer) : of_death == 0, "deaths in those of C++");
  }
  require(ph_barcode_birth_cell(found, expected.size(), nullptr) == 0, "no bar has no cell");
}

/// Compares a call of the C interface with the outcome of C++. @param call call(out) calls the C
/// function.
template <class CallC>
void check(const Expected& expected, const ph_options& options, CallC&& call) {
  ph_barcode* const untouched = reinterpret_cast<ph_barcode*>(sizeof(void*));
  ph_barcode* found = untouched;
  const ph_status status = call(&found);
  require(status == expected.status, "the status that C++ would have");
  if (status != PH_OK) {
    require(found == untouched, "a call that failed sets nothing");
    return check_failure(status);
  }
  check_bars(found, *expected.bars, options.cells != 0);
  ph_barcode_free(found);
}

/// An array in memory. Its axes are nested in any order, its strides have either sign, and there
/// may be gaps between its numbers.
template <class T>
struct Strided {
  std::vector<T> memory;
  std::vector<std::int64_t> strides;
  std::size_t first = 0;
  const T* data() const { return memory.empty() ? nullptr : memory.data() + first; }
};

/// @param numbers the numbers in C order.
template <class T>
Strided<T> strided(const std::vector<T>& numbers, const std::vector<std::int64_t>& extents,
                   ChosenNumbers& chosen) {
  std::vector<std::size_t> axes(extents.size());
  std::iota(axes.begin(), axes.end(), std::size_t{0});
  for (std::size_t k = axes.size(); k > 1; --k)
    std::swap(axes[k - 1], axes[static_cast<std::size_t>(chosen.choice(static_cast<int>(k) - 1))]);
  Strided<T> result;
  result.strides.resize(extents.size());
  std::int64_t step = 1 + chosen.choice(1), first = 0, last = 0;
  for (const std::size_t k : axes) {
    const bool backwards = chosen.choice(3) == 0;
    result.strides[k] = backwards ? -step : step;
    (backwards ? first : last) += step * std::max<std::int64_t>(extents[k] - 1, 0);
    step *= std::max<std::int64_t>(extents[k], 1);
  }
  result.first = static_cast<std::size_t>(first);
  if (!numbers.empty()) result.memory.resize(static_cast<std::size_t>(first + last + 1));
  std::vector<std::int64_t> at(extents.size());
  for (const T& number : numbers) {
    result.memory[static_cast<std::size_t>(
        std::inner_product(at.begin(), at.end(), result.strides.begin(), first))] = number;
    for (std::size_t k = extents.size(); k-- > 0;) {
      if (++at[k] < extents[k]) break;
      at[k] = 0;
    }
  }
  return result;
}

void check_points(ChosenNumbers& chosen, const ph_options& options) {
  const Index rows = chosen.choice(7), columns = chosen.choice(3);
  const Points points = chosen.points(rows, columns);
  const Expected expected =
      names_nothing(options, true) ? Expected{{}, PH_USAGE} : expected_of([&] {
        return persistence(Rips(points, rips_of(options)), task_of(options));
      });
  const auto numbers = points.coordinates();
  const Strided<double> data =
      strided(std::vector<double>(numbers.begin(), numbers.end()), {rows, columns}, chosen);
  check(expected, options, [&](ph_barcode** out) {
    return ph_rips_points(data.data(), rows, columns, data.strides[0], data.strides[1], &options,
                          out);
  });
  // Passes several inputs in one call. Each input gives the same result as in a call of its own. If
  // an input fails in a call of its own, the joint call fails in the same way.
  const std::vector<const double*> clouds(2, numbers.data());
  const std::vector<std::int64_t> sizes(2, rows);
  std::array<ph_barcode*, 2> all{};
  const ph_status status =
      ph_rips_points_batch(clouds.data(), sizes.data(), columns, 2, &options, all.data());
  require(status == expected.status, "many clouds have the status of each");
  for (ph_barcode* bars : all) {
    require((bars != nullptr) == (status == PH_OK), "all of many clouds, or none");
    if (bars != nullptr) check_bars(bars, *expected.bars, options.cells != 0);
    ph_barcode_free(bars);
  }
}

void check_distances(ChosenNumbers& chosen, const ph_options& options) {
  const Index size = chosen.choice(7);
  const std::vector<double> lower = chosen.numbers(size < 2 ? 0 : size * (size - 1) / 2);
  const Expected expected =
      names_nothing(options, true) ? Expected{{}, PH_USAGE} : expected_of([&] {
        return persistence(Rips(DistanceMatrix(size, lower), rips_of(options)), task_of(options));
      });
  check(expected, options,
        [&](ph_barcode** out) { return ph_rips_distances(lower.data(), size, &options, out); });
}

template <class T>
void check_image(ChosenNumbers& chosen, const Call& call, ph_number type) {
  std::vector<std::int64_t> extents(static_cast<std::size_t>(1 + chosen.choice(3)));
  Index voxels = 1;
  for (std::int64_t& n : extents) {
    n = 1 + chosen.choice(extents.size() > 2 ? 2 : 4);
    voxels *= n;
  }
  std::vector<T> numbers;
  for (Index i = 0; i < voxels; ++i) {
    if constexpr (std::is_floating_point_v<T>)
      numbers.push_back(static_cast<T>(chosen.number()));
    else
      numbers.push_back(static_cast<T>(chosen.byte() % 5 * 51));
  }
  const ph_options& options = call.options;
  const auto computed = [&] {
    Image image{std::vector<Index>(extents.begin(), extents.end()), Voxels(numbers)};
    image.masked = options.masked != 0;
    CubicalOptions cubes;
    cubes.construction = static_cast<CubicalOptions::Construction>(options.construction);
    cubes.superlevel = options.superlevel != 0;
    cubes.threshold = threshold_of(options);
    if (options.periodic != nullptr)
      for (std::size_t k = 0; k < extents.size(); ++k)
        cubes.periodic.push_back(call.periodic[k] != 0);
    return persistence(Cubical(image, cubes), task_of(options));
  };
  const Expected expected =
      names_nothing(options, false) ? Expected{{}, PH_USAGE} : expected_of(computed);
  const Strided<T> data = strided(numbers, extents, chosen);
  const auto axes = static_cast<std::int32_t>(extents.size());
  check(expected, options, [&](ph_barcode** out) {
    return ph_cubical_image(data.data(), type, axes, extents.data(), data.strides.data(), &options,
                            out);
  });
  check(expected, options, [&](ph_barcode** out) {
    return ph_cubical_image(numbers.data(), type, axes, extents.data(), nullptr, &options, out);
  });
}

/// Impossible sizes and pointers must be refused before anything is read.
void check_nonsense(ChosenNumbers& chosen, const ph_options& options) {
  constexpr std::int64_t huge = std::numeric_limits<std::int64_t>::max();
  const std::array<std::int64_t, 4> sizes{-1, huge, std::numeric_limits<std::int64_t>::min(), 3};
  const auto size = [&] { return sizes[static_cast<std::size_t>(chosen.choice(3))]; };
  const auto is_refused = [&](auto&& call) {
    ph_barcode* out = nullptr;
    const ph_status status = call(&out);
    require(status != PH_OK && out == nullptr, "nonsense is taken for an input");
    check_failure(status);
  };
  const double one = 1;
  is_refused([&](auto out) {
    return ph_rips_points(nullptr, size(), 1 + chosen.choice(2), 1, 1, &options, out);
  });
  is_refused([&](auto out) { return ph_rips_distances(nullptr, size(), &options, out); });
  is_refused([&](auto) { return ph_rips_points(&one, 1, 1, 1, 1, &options, nullptr); });
  const std::array<std::int64_t, 2> extents{size(),
                                            sizes[static_cast<std::size_t>(chosen.choice(2))]};
  is_refused([&](auto out) {
    return ph_cubical_image(&one, PH_FLOAT64, 2, extents.data(), nullptr, &options, out);
  });
  const std::int64_t single = 1;
  is_refused([&](auto out) {
    return ph_cubical_image(&one, static_cast<ph_number>(chosen.coin() ? 5 : 1000), 1, &single,
                            nullptr, &options, out);
  });
  is_refused([&](auto out) {
    return ph_cubical_image(&one, PH_FLOAT64, chosen.coin() ? 0 : 9, &single, nullptr, &options,
                            out);
  });
  ph_options of_later = options;
  of_later.size = sizeof(ph_options) + 1 + chosen.byte();
  is_refused([&](auto out) { return ph_rips_points(&one, 1, 1, 1, 1, &of_later, out); });
}

}  // namespace

void run_c(std::string_view bytes) {
  ChosenNumbers chosen(bytes);
  const int kind = chosen.choice(7);
  Call call = call_of(chosen);
  if (chosen.coin()) call.options.periodic = call.periodic.data();
  switch (kind) {
    case 0:
      return check_nonsense(chosen, call.options);
    case 1:
      return check_distances(chosen, call.options);
    case 2:
      return check_image<std::uint8_t>(chosen, call, PH_UINT8);
    case 3:
      return check_image<std::int16_t>(chosen, call, PH_INT16);
    case 4:
      return check_image<float>(chosen, call, PH_FLOAT32);
    case 5:
      return check_image<double>(chosen, call, PH_FLOAT64);
    default:
      return check_points(chosen, call.options);
  }
}

}  // namespace ph::fuzz

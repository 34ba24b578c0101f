// SPDX-License-Identifier: MIT
#include "ph/euler_curve.hpp"

#include <algorithm>
#include <type_traits>

#include "libph/src/vectors/euler/change_counts.hpp"
#include "libph/src/vectors/euler/decided_cells.hpp"
#include "libph/src/vectors/euler/layers.hpp"
#include "ph/detail/core/file_pages.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/vectors/checked_bars.hpp"

namespace ph {
namespace vectors {
namespace {

/// Finds, for each row of a layer, the rows around it. There is one row for each direction along
/// all axes except the last.
class RowNeighbours {
 public:
  explicit RowNeighbours(const Layered& image) : image_(image), place_(image.axes() - 2) {
    std::size_t count = 1;
    for (std::size_t k = 1; k < image.axes(); ++k) count *= 3;
    steps_.resize(count);
  }

  /// Calls use(row, rows) for all rows of the middle layer, where rows[direction] is a pointer to
  /// keys.
  template <class T, class Use>
  void for_each_row(const ThreeLayers<T>& layers, Use&& use) {
    std::vector<const T*> rows(steps_.size());
    const T* const of_layer[] = {layers.layer(0), layers.layer(-1), layers.layer(1)};
    std::ranges::fill(place_, 0);
    for (std::size_t row = 0; row < image_.rows_each(); ++row) {
      find_steps();
      const std::size_t in_layer = rows.size() / 3;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const T* layer = of_layer[i / in_layer];
        const std::size_t other = steps_[i % in_layer];
        rows[i] =
            layer == nullptr || other == kNone ? nullptr : layer + other * layers.padded_row();
      }
      use(row, rows.data());
      for (std::size_t k = place_.size(); k-- > 0;) {
        if (++place_[k] < image_.extents[k + 1]) break;
        place_[k] = 0;
      }
    }
  }

 private:
  static constexpr std::size_t kNone = SIZE_MAX;

  /// Finds the rows in all directions along the axes between the first and the last one.
  void find_steps() {
    std::size_t count = 1;
    steps_[0] = 0;
    for (std::size_t k = 0; k < place_.size(); ++k) {
      const std::size_t extent = image_.extents[k + 1], at = place_[k];
      const bool is_circle = image_.periodic[k + 1];
      const std::size_t by_digit[] = {
          at,
          at > 0      ? at - 1
          : is_circle ? extent - 1
                      : kNone,
          at + 1 < extent ? at + 1
          : is_circle     ? 0
                          : kNone,
      };
      // The loop runs downwards, so that entries are read before they are overwritten.
      for (std::size_t i = 3 * count; i-- > 0;) {
        const std::size_t before = steps_[i / 3], here = by_digit[i % 3];
        steps_[i] = before == kNone || here == kNone ? kNone : before * extent + here;
      }
      count *= 3;
    }
  }

  const Layered& image_;
  std::vector<std::size_t> place_;  // along the axes between the first and the last one
  std::vector<std::size_t> steps_;
};

/// The number of layers that a thread takes at a time. It is large enough to outweigh the cost of
/// reading the two adjacent layers and of adding up the counts.
std::size_t layers_at_a_time(const Layered& image, const RunContext& context) {
  constexpr std::size_t voxels = 1 << 20, at_least = 16;
  const std::size_t layers = image.layers(), threads = thread_count(context);
  return std::max(
      {(voxels - 1) / image.voxels_each() + 1, std::min(at_least, (layers - 1) / threads + 1)});
}

template <class T, class Sum, class Counts>
void count_layers(const Layered& image, std::size_t begin, std::size_t end, Counts& counts,
                  const RunContext& context) {
  ThreeLayers<T> layers(image, begin, &context.memory);
  DecidedCells cells(image, &context.memory);
  RowNeighbours neighbours(image);
  typename Counts::Part part(counts);
  Sum changes[DecidedCells::kBlock];
  Ticker ticker(context, "");
  for (std::size_t layer = begin; layer < end; ++layer) {
    layers.go_up();
    neighbours.for_each_row(layers, [&](std::size_t, const T* const* rows) {
      for (std::size_t x = 0; x < image.row_length(); x += DecidedCells::kBlock) {
        const std::size_t behind = std::min(x + DecidedCells::kBlock, image.row_length());
        cells.count(rows, x, behind, changes);
        part.take(rows[0] + x, changes, behind - x);
        ticker.work();
      }
    });
  }
  part.add_to_all();
  if (image.image.is_in_file) {
    const T* voxels = static_cast<const T*>(image.image.voxels);
    forget_file_pages(voxels + begin * image.voxels_each(),
                      (end - begin) * image.voxels_each() * sizeof(T));
  }
}

template <class T, class Counts>
void count_all(const Layered& image, Counts& counts, const RunContext& context) {
  constexpr std::size_t most_axes_in_bytes = 5;  // at most 122 of the 3^5 cells have the same sign
  for_each_piece("Euler curve", image.layers(), layers_at_a_time(image, context), context,
                 [&](std::size_t begin, std::size_t end) {
                   if (image.axes() <= most_axes_in_bytes)
                     count_layers<T, std::int8_t>(image, begin, end, counts, context);
                   else
                     count_layers<T, std::int16_t>(image, begin, end, counts, context);
                 });
}

/// True if there are enough voxels to have one sum for each value.
template <class T>
bool suits_histogram(const CubicalImage& image) {
  if constexpr (std::is_integral_v<T>)
    return sizeof(T) == 1 || image.size() >= std::size_t{1} << 15;
  else
    return false;
}

}  // namespace
}  // namespace vectors

StepFunction euler_curve(const Cubical& cubical, const RunContext& context) {
  const CubicalImage image = cubical.cubical_image();
  if (image.size() == 0) return {};
  const vectors::Layered layered(image);
  return with_voxels(image.type, image.voxels, [&]<class T>(const T*) {
    if constexpr (std::is_integral_v<T>) {
      if (vectors::suits_histogram<T>(image)) {
        vectors::Histogram<T> sums(layered, context);
        vectors::count_all<T>(layered, sums, context);
        return sums.curve(context);
      }
    }
    vectors::ChangeList<T> changes(layered, context);
    vectors::count_all<T>(layered, changes, context);
    return changes.curve(context);
  });
}

void euler_curve(const Cubical& cubical, const Grid& grid, std::span<double> out,
                 const RunContext& context) {
  const vectors::GridCells cells(grid, "euler_curve");
  vectors::check_size(out, grid.points, "euler_curve");
  const CubicalImage image = cubical.cubical_image();
  if (image.size() == 0) {
    std::ranges::fill(out, 0);
    return;
  }
  const vectors::Layered layered(image);
  with_voxels(image.type, image.voxels, [&]<class T>(const T*) {
    if constexpr (std::is_integral_v<T>) {
      euler_curve(cubical, context).sample(grid, out);
    } else {
      vectors::GridCounts<T> sums(layered, cells, context);
      vectors::count_all<T>(layered, sums, context);
      sums.write(out);
    }
  });
}

}  // namespace ph

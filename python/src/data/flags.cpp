// SPDX-License-Identifier: MIT
// This file looks at a matrix of distances of which only the entries above the diagonal count, as
// in Ripser and its descendants. The diagonal holds the births of the vertices.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/error.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"

namespace ph::python {
namespace {

constexpr double kRounding = 1e-6;  // the entries of a pair may differ by this share of the largest
constexpr Index kTile = 64;         // rows, and columns, that are read together
constexpr Index kFew = 200;         // a matrix of so many points takes a moment

/// The largest double that, rounded to single precision, is at most the limit in single precision.
double last_rounded_to(double limit) {
  if (!std::isfinite(limit)) return limit;
  const auto low = static_cast<float>(limit);
  const float high = std::nextafter(low, std::numeric_limits<float>::infinity());
  const double middle = std::isfinite(high) ? (double{low} + double{high}) / 2 : double{low};
  return static_cast<float>(middle) <= low ? middle : std::nextafter(middle, -kInfinity);
}

struct FlagFacts {
  /// "nan" or "unequal" if an entry is wrong, "birth" if an entry of the diagonal is; otherwise
  /// empty.
  std::string wrong;
  Index row = 0, column = 0;  ///< the place of the wrong entry
  bool has_births = false;    ///< true if a vertex enters at a value other than 0
  bool is_plain = false;      ///< true if `rips` accepts the matrix with these births
  double limit = 0;           ///< the value up to which pairs matter
  std::size_t edges = 0;      ///< the number of pairs up to the limit
};

template <class Number>
class Flag {
 public:
  Flag(const py::buffer_info& array, std::optional<std::vector<double>> births, bool is_symmetric)
      : first_(static_cast<const char*>(array.ptr)),
        row_stride_(array.strides[0]),
        column_stride_(array.strides[1]),
        size_(array.shape[0]),
        is_symmetric_(is_symmetric) {
    if (births) {
      births_ = *std::move(births);
    } else {
      for (Index i = 0; i < size_; ++i) births_.push_back(double{entry(i, i)});
    }
  }

  FlagFacts facts(double limit, bool is_single, const RunContext& context) {
    FlagFacts found;
    const auto nan = std::ranges::find_if(births_, [](double birth) { return std::isnan(birth); });
    if (nan != births_.end()) {
      found.wrong = "birth";
      found.row = nan - births_.begin();
      return found;
    }
    scan(context);
    if (find_wrong(found)) return found;

    double least = 0, latest = 0;
    for (const double birth : births_) {
      found.has_births = found.has_births || birth != 0;
      least = std::min(least, birth);
      latest = std::max(latest, birth);
    }
    found.limit = limit;
    if (limit == kInfinity && latest < kInfinity) {
      // Beyond this radius, all points are joined to one point, and there is a single component.
      const double radius = size_ == 0 ? 0 : *std::ranges::min_element(farthest_);
      found.limit = std::max(radius, latest);
      if (is_single) found.limit = last_rounded_to(found.limit);
    }
    found.edges = count(found.has_births ? limit : found.limit, context);
    found.is_plain = least_ >= 0 && least >= 0 && latest <= found.limit && latest < kInfinity;
    return found;
  }

 private:
  Number entry(Index i, Index j) const {
    return *reinterpret_cast<const Number*>(first_ + i * row_stride_ + j * column_stride_);
  }

  /// Reads all pairs once.
  void scan(const RunContext& context) {
    farthest_.assign(static_cast<std::size_t>(size_), 0);
    for (Index rows = 0; rows < size_; rows += kTile)
      for (Index columns = rows; columns < size_; columns += kTile) {
        context.poll();
        const Index end = std::min(columns + kTile, size_);
        for (Index i = rows; i < std::min(rows + kTile, size_); ++i)
          for (Index j = std::max(columns, i + 1); j < end; ++j) look_at(i, j);
      }
    if (is_symmetric_) return;
    for (Index i = 0; i < size_; ++i) least_ = lesser(least_, double{entry(i, i)});
  }
  void look_at(Index i, Index j) {
    const Number upper = entry(i, j), lower = entry(j, i);
    if (std::isnan(upper)) nan_ = std::min(nan_, std::tuple(i, j));
    least_ = lesser(least_, double{upper});
    for (const Index end : {i, j}) {
      double& farthest = farthest_[static_cast<std::size_t>(end)];
      farthest = std::max(farthest, double{upper});
    }
    if (!is_symmetric_) {
      least_ = lesser(least_, double{lower});
    } else if (upper != lower) {
      Number size = std::abs(upper - lower);
      if (std::isnan(size)) size = std::numeric_limits<Number>::infinity();
      unequal_ = std::min(unequal_, std::tuple(-double{size}, j, i));
    }
  }
  /// The lesser number; NaN if one of them is NaN.
  static double lesser(double a, double b) { return a <= b || std::isnan(a) ? a : b; }

  bool find_wrong(FlagFacts& found) const {
    if (nan_ != kNoPair) {
      found.wrong = "nan";
      std::tie(found.row, found.column) = nan_;
      return true;
    }
    double largest = 0;
    for (const double distance : farthest_)
      if (std::isfinite(distance)) largest = std::max(largest, distance);
    if (std::isfinite(least_)) largest = std::max(largest, -least_);
    const auto [size, j, i] = unequal_;
    if (-size <= kRounding * largest) return false;
    found.wrong = "unequal";
    found.row = i;
    found.column = j;
    return true;
  }

  /// The number of pairs with at most this value.
  std::size_t count(double limit, const RunContext& context) const {
    std::size_t pairs = 0;
    for (Index i = 0; i < size_; ++i) {
      context.poll();
      for (Index j = i + 1; j < size_; ++j) pairs += double{entry(i, j)} <= limit;
    }
    return pairs;
  }

  static constexpr std::tuple kNoPair{std::numeric_limits<Index>::max(), Index{0}};

  const char* first_;
  std::ptrdiff_t row_stride_, column_stride_;
  Index size_;
  bool is_symmetric_;  ///< true if the entries below the diagonal must be the same
  std::vector<double> births_;
  std::vector<double> farthest_;  ///< the largest distance of each point
  /// The least number that matters, at most 0. NaN if an ignored entry is NaN.
  double least_ = 0;
  std::tuple<Index, Index> nan_ = kNoPair;  ///< the first pair with NaN
  /// The pair whose entries differ most: minus their difference, the larger point, the smaller one.
  std::tuple<double, Index, Index> unequal_{0, 0, 0};
};

py::tuple flag_facts(const py::buffer& distances, const std::optional<py::buffer>& births,
                     double limit, bool is_single, bool is_symmetric, const RunOptions& options) {
  const py::buffer_info array = distances.request();
  std::optional<std::vector<double>> given;
  if (births) given = vector_of<double>(*births);
  const bool is_short = array.shape[0] <= kFew;
  const FlagFacts found = run(options, is_short, [&](const RunContext& context) {
    return holds<float>(array)
               ? Flag<float>(array, std::move(given), is_symmetric).facts(limit, is_single, context)
               : Flag<double>(array, std::move(given), is_symmetric)
                     .facts(limit, is_single, context);
  });
  return py::make_tuple(found.wrong, found.row, found.column, found.has_births, found.is_plain,
                        found.limit, found.edges);
}

}  // namespace

void bind_flags(py::module_& m) {
  m.def("last_rounded_to", &last_rounded_to, py::arg("limit"));
  m.def("flag_facts", &flag_facts, py::arg("distances"), py::arg("births"), py::arg("limit"),
        py::arg("is_single"), py::arg("is_symmetric"), py::arg("run"));
}

}  // namespace ph::python

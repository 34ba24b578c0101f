// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libph/src/core/random.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/vectors/checked_bars.hpp"
#include "ph/error.hpp"
#include "ph/vectorise.hpp"

namespace ph {
namespace vectors {
namespace {

using Place = std::array<double, 2>;

double square_between(const Place& a, const Place& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}
double between(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// A point (birth, death) of the plane, and the number of bars there.
struct Heap {
  Place place;
  double count = 0;
};

/// The bars of all diagrams as a sorted list of places, without repetitions.
std::vector<Heap> heaps_of(std::span<const std::span<const Bar>> diagrams) {
  std::vector<Place> places;
  for (const auto& bars : diagrams)
    for (const Bar& bar : checked_bars(bars, Ends::finite, "fit_atol"))
      places.push_back({bar.birth + 0.0, bar.death + 0.0});
  std::ranges::sort(places);  // mutant: atol-order
  std::vector<Heap> heaps;
  for (const Place& place : places) {
    if (heaps.empty() || heaps.back().place != place) heaps.push_back({place});
    ++heaps.back().count;  // mutant: atol-copies
  }
  return heaps;
}

class KMeans {
 public:
  KMeans(const std::vector<Heap>& heaps, std::size_t count, std::uint64_t seed,
         const RunContext& context)
      : heaps_(heaps), context_(context), nearest_(heaps.size()), squares_(heaps.size()) {
    seed_centres(count, seed);
  }

  void run(int most_rounds) {
    for (int round = 0; round < most_rounds && assign(); ++round) move();  // mutant: atol-rounds
    std::ranges::sort(centres_);
  }
  const std::vector<Place>& centres() const { return centres_; }

 private:
  static constexpr std::size_t kPiece = 4096;
  struct Sum {
    double x = 0, y = 0, count = 0;
    Place low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};

    void add(const Sum& other) {
      x += other.x;
      y += other.y;
      count += other.count;
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], other.low[k]);
        high[k] = std::max(high[k], other.high[k]);
      }
    }
    /// The mean. Clamping makes the mean of equal places exactly that place, despite rounding.
    Place mean() const {
      // mutant: atol-clamp
      return {std::clamp(x / count, low[0], high[0]), std::clamp(y / count, low[1], high[1])};
    }
  };

  /// Chooses the initial centres by k-means++. The first centre is the place of a random bar. Each
  /// further centre is a random place. Its probability is proportional to the number of bars at the
  /// place times the squared distance of the place from the nearest earlier centre.
  void seed_centres(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::ranges::fill(squares_, 1);
    while (centres_.size() < count) {
      double total = 0;
      for (std::size_t i = 0; i < heaps_.size(); ++i) total += heaps_[i].count * squares_[i];
      double rest = random.uniform() * total;
      std::size_t chosen = heaps_.size();
      for (std::size_t i = 0; i < heaps_.size(); ++i) {
        if (squares_[i] == 0) continue;
        chosen = i;
        if ((rest -= heaps_[i].count * squares_[i]) < 0) break;
      }
      if (chosen == heaps_.size()) chosen = first_free();  // this happens if squares underflowed
      const bool is_first = centres_.empty();
      centres_.push_back(heaps_[chosen].place);
      for (std::size_t i = 0; i < heaps_.size(); ++i) {
        const double square = square_between(heaps_[i].place, centres_.back());
        squares_[i] = is_first ? square : std::min(squares_[i], square);
      }
      context_.poll();
    }
  }
  std::size_t first_free() const {
    for (std::size_t i = 0; i < heaps_.size(); ++i)
      if (std::ranges::find(centres_, heaps_[i].place) == centres_.end()) return i;
    return 0;
  }

  /// Assigns each place to its nearest centre, and sums up the places of each centre. If several
  /// centres are equally near, the first of them is used.
  /// @return true if any assignment has changed.
  bool assign() {
    const std::size_t pieces = (heaps_.size() - 1) / kPiece + 1, count = centres_.size();
    std::vector<Sum> sums(pieces * count);
    std::vector<char> changed(pieces);
    for_each_piece("k-means", heaps_.size(), kPiece, context_,
                   [&](std::size_t begin, std::size_t end) {
                     const std::size_t piece = begin / kPiece;
                     for (std::size_t i = begin; i < end; ++i) {
                       const std::size_t centre = find_nearest(i);
                       if (is_new_ || nearest_[i] != centre) changed[piece] = 1;
                       nearest_[i] = static_cast<std::uint32_t>(centre);
                       const auto& [place, times] = heaps_[i];
                       sums[piece * count + centre].add(
                           {times * place[0], times * place[1], times, place, place});
                     }
                   });
    is_new_ = false;
    // The sums are added up in the order of the pieces, so they do not depend on the threads.
    sums_.assign(count, {});
    for (std::size_t i = 0; i < sums.size(); ++i) sums_[i % count].add(sums[i]);
    return std::ranges::find(changed, 1) != changed.end();
  }
  std::size_t find_nearest(std::size_t i) {
    std::size_t nearest = 0;
    double least = kInfinity;
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      const double square = square_between(heaps_[i].place, centres_[k]);
      if (square < least) {
        least = square;
        nearest = k;
      }
    }
    squares_[i] = least;
    return nearest;
  }
  /// Moves each centre to the mean of its places. A centre without places moves to the place that
  /// is farthest from its nearest centre.
  void move() {
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      if (sums_[k].count > 0) {
        centres_[k] = sums_[k].mean();
      } else {
        const auto farthest = std::ranges::max_element(squares_);
        centres_[k] = heaps_[static_cast<std::size_t>(farthest - squares_.begin())].place;
        *farthest = 0;
      }
    }
  }

  const std::vector<Heap>& heaps_;
  const RunContext& context_;
  std::vector<Place> centres_;
  std::vector<std::uint32_t> nearest_;
  // The squared distance of each place to its nearest centre.
  std::vector<double> squares_;
  std::vector<Sum> sums_;
  bool is_new_ = true;
};

/// The width of each centre. It is half the distance from the centre to the nearest other centre.
/// For a single centre, it is the mean distance from the bars to the centre.
std::vector<double> widths_of(const std::vector<Place>& centres, const std::vector<Heap>& heaps) {
  std::vector<double> widths;
  for (std::size_t k = 0; k < centres.size(); ++k) {
    double least = kInfinity;
    for (std::size_t other = 0; other < centres.size(); ++other)
      if (other != k) least = std::min(least, between(centres[k], centres[other]) / 2);
    widths.push_back(std::max(least, std::numeric_limits<double>::min()));
  }
  if (centres.size() > 1) return widths;
  double sum = 0, count = 0;
  for (const Heap& heap : heaps) {
    sum += heap.count * between(heap.place, centres[0]);
    count += heap.count;
  }
  return {sum > 0 ? sum / count : 1};
}

void check(const Atol& fitted) {
  if (fitted.centres.empty() || fitted.centres.size() != fitted.widths.size())
    throw Error(ErrorKind::usage,
                fmt::format("atol_vector: found {} centres and {} widths, expected at least one "
                            "centre and one width for each",
                            fitted.centres.size(), fitted.widths.size()));
  bool is_right = true;
  for (const Place& centre : fitted.centres)
    for (const double x : centre) is_right = is_right && std::abs(x) <= kLargest;
  for (const double width : fitted.widths) is_right = is_right && width > 0 && width < kInfinity;
  if (!is_right)
    throw Error(ErrorKind::usage,
                fmt::format("atol_vector: found a centre or a width out of range, expected centres "
                            "of at most {} in absolute value and finite widths above 0",
                            kLargest));
}

}  // namespace
}  // namespace vectors

Atol fit_atol(std::span<const std::span<const Bar>> diagrams, const AtolOptions& options,
              const RunContext& context) {
  if (options.centres < 1 || options.most_rounds < 0)
    throw Error(
        ErrorKind::usage,
        fmt::format(
            "{}: found {} centres and {} rounds, expected 1 centre or more and 0 rounds or more",
            mark_place("fit_atol"), options.centres, options.most_rounds));
  std::vector<vectors::Heap> heaps = vectors::heaps_of(diagrams);
  if (heaps.size() < options.centres)
    throw Error(
        ErrorKind::bad_data,
        fmt::format("{}: distinct bars: found {}, expected at least {}, the number of centres",
                    mark_place("fit_atol"), heaps.size(), options.centres));
  // The unit is chosen so that the largest number is between 1/2 and 1. In a larger unit, the
  // squares of small numbers could be 0.
  double largest = 0;
  for (const auto& heap : heaps)
    largest = std::max({largest, std::abs(heap.place[0]), std::abs(heap.place[1])});
  const int exponent = std::ilogb(largest) + 1;
  for (auto& heap : heaps)
    for (double& x : heap.place) x = std::ldexp(x, -exponent);
  const MemoryClaim claim(context.memory,
                          heaps.size() * (sizeof(vectors::Heap) + 2 * sizeof(double)));
  vectors::KMeans k_means(heaps, options.centres, options.seed, context);
  k_means.run(options.most_rounds);
  Atol fitted{k_means.centres(), vectors::widths_of(k_means.centres(), heaps), options.contrast};
  for (auto& centre : fitted.centres)
    for (double& x : centre) x = std::ldexp(x, exponent);
  const bool has_no_unit = heaps.size() == 1;
  for (double& width : fitted.widths)
    if (!has_no_unit)  // mutant: atol-unit
      width = std::max(std::ldexp(width, exponent), std::numeric_limits<double>::min());
  return fitted;
}

void atol_vector(std::span<const Bar> given, const Atol& fitted, std::span<double> out) {
  vectors::check(fitted);
  vectors::check_size(out, fitted.centres.size(), "atol_vector");
  const std::vector<Bar> bars = vectors::checked_bars(given, vectors::Ends::finite, "atol_vector");
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = 0;
    for (const Bar& bar : bars) {
      const double steps =
          vectors::between({bar.birth, bar.death}, fitted.centres[k]) / fitted.widths[k];
      out[k] += std::exp(fitted.contrast == Atol::Contrast::laplace ? -steps : -steps * steps);
    }
  }
}

}  // namespace ph

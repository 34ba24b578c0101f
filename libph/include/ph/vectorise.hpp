// SPDX-License-Identifier: MIT
/// Turns persistence diagrams into vectors, for statistics and machine learning.
///
/// Conventions of all functions here: They take the bars of one dimension, in any order; the
/// dimension of a bar is ignored. Bars of length 0 do not count. Bars must be finite unless a
/// function says otherwise; `finite_bars` leaves out, caps or refuses infinite bars. Births and
/// deaths are at most 1e100 in absolute value. Results have the unit of the values unless another
/// unit is named, are written to `out`, a block of doubles in C order, and depend only on the bars
/// and the parameters. Errors: (usage) on a parameter out of its range or on an `out` of the wrong
/// size; (bad_data) on a NaN, a death before its birth, a bar that is not finite, or a number that
/// is too large.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/detail/core/names.hpp"
#include "ph/run_context.hpp"

namespace ph {

// ---- input

/// The treatment of infinite bars: bars that never die, and bars that are born at -infinity.
struct InfiniteBars {
  enum class Rule {
    drop,    ///< these bars are left out
    cap,     ///< bars that never die get the death `cap`; bars born at -infinity are an error
    refuse,  ///< these bars are an error
  };
  Rule rule = Rule::drop;
  double cap = 0;  ///< at most 1e100 in absolute value; not before the birth of a bar it caps
};

struct FiniteBars {
  std::vector<Bar> bars;    ///< in their original order
  std::size_t dropped = 0;  ///< number of bars left out
};

/// Bars with both ends finite, including bars of length 0.
FiniteBars finite_bars(std::span<const Bar> bars, const InfiniteBars& rule = {});

/// The values at which a function is evaluated: `points` values, equally spaced, with both ends
/// included.
struct Grid {
  /// Finite, lo < hi. If there is only one point, it is lo, and lo may equal hi.
  double lo = 0, hi = 1;
  std::size_t points = 100;  ///< at least 1

  /// lo + i · (hi - lo) / (points - 1), with hi as the last value: the same as numpy.linspace, to
  /// the last bit.
  std::vector<double> values() const;
  friend bool operator==(const Grid&, const Grid&) = default;
};

/// The grid from the smallest finite birth or death in a batch of diagrams to the largest. If all
/// these numbers equal x, the grid is an interval around x of length 1 or 2^-39 |x|, whichever is
/// more; if there are none, it is [0, 1]. Infinite ends are ignored.
Grid fit_grid(std::span<const std::span<const Bar>> diagrams, std::size_t points = 100);

/// An interval that is divided into pixels of equal width.
struct PixelRange {
  double lo = 0, hi = 1;    ///< finite, lo < hi
  std::size_t pixels = 20;  ///< at least 1
  friend bool operator==(const PixelRange&, const PixelRange&) = default;
};

/// The part of the plane that a persistence image shows.
struct ImageFrame {
  PixelRange births, lengths;
  friend bool operator==(const ImageFrame&, const ImageFrame&) = default;
};

/// The frame from the smallest to the largest birth in a batch, and from 0 to the largest length.
/// If all births equal x, the frame around x is as wide as it is high, but at least 2^-39 |x| wide.
/// If there are no bars, both ranges are [0, 1].
ImageFrame fit_image_frame(std::span<const std::span<const Bar>> diagrams, std::size_t births = 20,
                           std::size_t lengths = 20);

// ---- numbers

inline constexpr std::size_t kStatistics = 38;

/// Nine numbers each for births, deaths, midpoints and lengths: mean, standard deviation (of the
/// population), median, interquartile range, range, and the 10th, 25th, 75th and 90th percentiles
/// (linear between neighbours); then the number of bars and their entropy. All are 0 if there are
/// no bars.
///
/// Source: Ali et al., A survey of vectorization methods in topological data analysis, 2023, whose
/// comparison these numbers won. O(n log n).
void statistics(std::span<const Bar> bars, std::span<double> out);

/// Names of the columns of `statistics`: birth_mean, birth_sd, …, count, entropy.
const std::array<std::string_view, kStatistics>& statistics_names();

/// The persistent entropy: -Σ p ln p, where p is a bar's share of the sum of all lengths. The unit
/// is nats. 0 if there are no bars. If `normalised`, the entropy is divided by ln n, its largest
/// value for n bars, and has no unit; it is then 0 for one bar.
///
/// Source: Chintakunta et al., An entropy-based persistence barcode, 2015. O(n).
double entropy(std::span<const Bar> bars, bool normalised = false);

/// The largest lengths, descending, one per number of `out`; 0 beyond the last bar. O(n log n).
void longest_lengths(std::span<const Bar> bars, std::span<double> out);

// ---- curves: out has grid.points numbers

/// The Betti curve: the number of bars alive at t, birth <= t < death. Infinite bars are allowed.
/// O(n + m) for n bars and m points.
void betti_curve(std::span<const Bar> bars, const Grid& grid, std::span<double> out);

/// The entropy of the bars alive at t: -Σ p ln p over birth <= t < death, where p is the bar's
/// share of the lengths of all bars. The unit is nats. Source: Atienza, González-Díaz,
/// Soriano-Trigueros, On the stability of persistent entropy and new summary functions for
/// topological data analysis, 2020. O(n + m).
void life_entropy_curve(std::span<const Bar> bars, const Grid& grid, std::span<double> out);

/// The silhouette: Σ w max(0, min(t - birth, death - t)) / Σ w, with w = length^power; 0 if there
/// are no bars. Definitions that measure heights as distances from the diagonal have a factor √2;
/// this one has none.
///
/// Source: Chazal et al., Stochastic convergence of persistence landscapes and silhouettes, 2014.
/// O(n + m), with sums in double-double precision.
/// @param power finite, at least 0.
void silhouette(std::span<const Bar> bars, const Grid& grid, double power, std::span<double> out);

/// The first persistence landscapes: layer k at t is the k-th largest of max(0, min(t - birth,
/// death - t)), to the last bit. There is no factor √2. Bars that never die are allowed and grow
/// forever; bars born at -infinity are refused.
///
/// Source: Bubenik, Statistical topological data analysis using persistence landscapes, 2015. At t,
/// the function of a bar rises or falls. The bars of either kind are sorted into grid cells by
/// their turning points, and the best bars of either kind are kept while the grid is traversed once
/// downwards and once upwards. O((n + m) layers) at most.
/// @param layers at least 1. @param out layers × grid.points, one row per layer.
void landscape(std::span<const Bar> bars, const Grid& grid, std::size_t layers,
               std::span<double> out, const RunContext& context = default_context());

/// A continuous function, linear between its critical points; 0 before the first and after the last
/// of these points.
struct PiecewiseLinear {
  std::vector<double> at;     ///< ascending
  std::vector<double> value;  ///< one per place
  /// @throws Error (usage) if the numbers of values and places differ.
  double operator()(double t) const;
};

/// The first persistence landscapes, exact: all their critical points. The result has fewer than
/// `layers` layers if all further layers are 0 everywhere.
///
/// Source: Bubenik, Dłotko, A persistence landscapes toolbox for topological statistics, 2017: the
/// upper hull of the tents is peeled off. O(n log n + n · layers), with at most n layers.
std::vector<PiecewiseLinear> exact_landscape(std::span<const Bar> bars, std::size_t layers,
                                             const RunContext& context = default_context());

// ---- pictures

/// The persistence image: each bar is a normal distribution around (birth, length) with standard
/// deviation `sigma` along both axes, times length^power; a pixel holds the integral over its area.
/// Pixels more than 8 sigma from the centre along an axis are left out; together they hold less
/// than 3e-15 of a distribution.
///
/// Source: Adams et al., 2017, Persistence images: a stable vector representation of persistent
/// homology. O(n · pixels within 8 sigma). Unit: the unit of the values to the power of `power`; no
/// unit if `power` is 0.
/// @param sigma finite, > 0. @param power finite, at least 0.
/// @param out lengths × births: one row per interval of lengths, ascending.
void persistence_image(std::span<const Bar> bars, const ImageFrame& frame, double sigma,
                       double power, std::span<double> out,
                       const RunContext& context = default_context());

// ---- learned from a batch

/// The result of fitting ATOL to a batch: centres in the plane (birth, death), each with a width.
struct Atol {
  enum class Contrast {
    laplace,  ///< exp(-distance / width)
    gauss,    ///< exp(-distance² / width²)
  };
  std::vector<std::array<double, 2>> centres;  ///< ascending
  std::vector<double> widths;                  ///< one per centre, > 0
  Contrast contrast = Contrast::laplace;
  friend bool operator==(const Atol&, const Atol&) = default;
};

template <>
inline constexpr std::array names_of<Atol::Contrast>{
    Named{Atol::Contrast::laplace, "laplace"},
    Named{Atol::Contrast::gauss, "gauss"},
};

struct AtolOptions {
  std::size_t centres = 10;  ///< at least 1
  Atol::Contrast contrast = Atol::Contrast::laplace;
  std::uint64_t seed = 0;  ///< seed for the choice of the first centres
  int most_rounds = 300;   ///< limit for the rounds of k-means, at least 0
};

/// Automatic topologically-oriented learning: the bars of all diagrams are points (birth, death),
/// k-means finds their centres, and the width of a centre is half its distance to the nearest other
/// centre (for a single centre, the mean distance of the points, or 1 if that is 0).
///
/// Source: Royer et al., 2021, ATOL: measure vectorization for automatic topologically-oriented
/// learning. k-means++ chooses the first centres (Arthur, Vassilvitskii, 2007); rounds of k-means
/// follow until no point changes its centre, or until most_rounds is reached. The result is the
/// same on any machine, for bars and diagrams in any order and for any number of threads. O(n ·
/// centres) per round, shared by threads.
/// @throws Error (usage) on options out of range; Error (bad_data) on fewer distinct points than
///         centres; Error (resource, cancelled).
Atol fit_atol(std::span<const std::span<const Bar>> diagrams, const AtolOptions& options = {},
              const RunContext& context = default_context());

/// For each centre, the sum of `contrast` over the bars. It has no unit. O(n · centres).
/// @param out one number per centre. @throws Error (usage) on an invalid `Atol`.
void atol_vector(std::span<const Bar> bars, const Atol& fitted, std::span<double> out);

// ---- kernels

/// The persistence scale-space kernel for two diagrams: 1 / (8 π sigma) · Σ (exp(-|p - q|² / (8
/// sigma)) - exp(-|p - q'|² / (8 sigma))) over bars p of one diagram and q of the other, where q'
/// is q with birth and death exchanged. It is positive definite. sigma has the squared unit of the
/// values.
///
/// Source: Reininghaus et al., A stable multi-scale kernel for topological machine learning, 2015.
/// Pairs with |p - q|² > 320 sigma are left out: both exponentials of such a pair are below 5e-18.
/// O(n m) at most.
/// @param sigma finite, > 0.
double scale_space_kernel(std::span<const Bar> a, std::span<const Bar> b, double sigma,
                          const RunContext& context = default_context());

struct WeightedGaussian {
  double sigma = 1;  ///< finite, > 0; has the unit of the values
  double slope = 1;  ///< finite, > 0; a bar has the weight arctan(slope · length^power)
  double power = 1;  ///< finite, at least 0
};

/// The persistence weighted Gaussian kernel (linear version): Σ w(p) w(q) exp(-|p - q|² / (2
/// sigma²)). It is positive definite.
///
/// Source: Kusano, Fukumizu, Hiraoka, Persistence weighted Gaussian kernel for topological data
/// analysis, 2016. Pairs with |p - q|² > 80 sigma² are left out, as in scale_space_kernel.
double weighted_gaussian_kernel(std::span<const Bar> a, std::span<const Bar> b,
                                const WeightedGaussian& options = {},
                                const RunContext& context = default_context());

/// A kernel for two diagrams. Several threads may call it at once.
using DiagramKernel =
    std::function<double(std::span<const Bar>, std::span<const Bar>, const RunContext&)>;

/// The Gram matrix of N diagrams: N × N in C order, symmetric. Threads share the pairs; the result
/// does not depend on the number of threads.
/// @param kernel symmetric; called once per pair, including each diagram with itself, with a
/// context for one thread.
/// @throws what `kernel` throws; Error (cancelled).
std::vector<double> gram_matrix(std::span<const std::span<const Bar>> diagrams,
                                const DiagramKernel& kernel,
                                const RunContext& context = default_context());

}  // namespace ph

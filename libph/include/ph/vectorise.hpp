// SPDX-License-Identifier: MIT
/// Vectors of persistence diagrams, for statistics and machine learning.
///
/// Conventions of all functions here. They take the bars of one dimension, in any order; a bar's
/// own dimension is not looked at. Bars of length 0 do not count. Bars are finite, unless a
/// function says otherwise: `finite_bars` leaves out, caps or refuses those that are not. Births
/// and deaths are at most 1e100 in absolute value. Results have the unit of the values unless a
/// unit is named, go to `out`, a block of doubles in C order, and depend on nothing but the bars
/// and the parameters. Errors: (usage) on a parameter out of its range or on an `out` of another
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
#include "ph/run_context.hpp"

namespace ph {

// ---- what goes in

/// What becomes of bars without an end.
struct InfiniteBars {
  enum class Rule {
    drop,    ///< they are left out
    cap,     ///< they die at `cap`
    refuse,  ///< they are an error
  };
  Rule rule = Rule::drop;
  double cap = 0;  ///< finite; not before the birth of a bar that never dies
};

struct FiniteBars {
  std::vector<Bar> bars;    ///< in the order in which they were given
  std::size_t dropped = 0;  ///< how many were left out
};

/// Bars with both ends finite. Those that were always there (born at -infinity) have no cap: they
/// are refused by both `cap` and `refuse`.
FiniteBars finite_bars(std::span<const Bar> bars, const InfiniteBars& rule = {});

/// Values at which a function is looked at: `points` of them, equally spaced, both ends included.
struct Grid {
  double lo = 0, hi = 1;     ///< finite, lo < hi; equal ends only with one point, which is lo
  std::size_t points = 100;  ///< at least 1

  /// lo + i · (hi - lo) / (points - 1), the last one hi: what numpy.linspace gives, to the last
  /// bit.
  std::vector<double> values() const;
  friend bool operator==(const Grid&, const Grid&) = default;
};

/// The grid from the least finite birth or death in a batch of diagrams to the largest one. Of a
/// single number an interval of length 1 around it; of none [0, 1]. Infinite ends are ignored.
Grid fit_grid(std::span<const std::span<const Bar>> diagrams, std::size_t points = 100);

/// An interval that is divided into pixels of equal width.
struct PixelRange {
  double lo = 0, hi = 1;    ///< finite, lo < hi
  std::size_t pixels = 20;  ///< at least 1
  friend bool operator==(const PixelRange&, const PixelRange&) = default;
};

/// What a persistence image shows.
struct ImageFrame {
  PixelRange births, lengths;
  friend bool operator==(const ImageFrame&, const ImageFrame&) = default;
};

/// The frame from the least birth in a batch to the largest, and from 0 to the largest length.
/// Where all births are equal, as wide around them as it is high; 1 high if there is no bar.
ImageFrame fit_image_frame(std::span<const std::span<const Bar>> diagrams, std::size_t births = 20,
                           std::size_t lengths = 20);

// ---- numbers

inline constexpr std::size_t kStatistics = 38;

/// Of births, deaths, midpoints and lengths, nine numbers each: mean, standard deviation (of the
/// population), median, interquartile range, range, the 10th, 25th, 75th and 90th percentile
/// (linear between neighbours); then how many bars there are, and their entropy. 0 of no bars.
///
/// Source: Ali et al., A survey of vectorization methods in topological data analysis, 2023, where
/// these did best. O(n log n).
void statistics(std::span<const Bar> bars, std::span<double> out);

/// Names of the columns of `statistics`: birth_mean, birth_sd, …, count, entropy.
const std::array<std::string_view, kStatistics>& statistics_names();

/// The persistent entropy: -Σ p ln p, of the shares p of bars in the sum of their lengths; in nats.
/// 0 of no bars. `normalised`: divided by ln n, its largest value for n bars, without unit; 0 of
/// one bar.
///
/// Source: Chintakunta et al., An entropy-based persistence barcode, 2015. O(n).
double entropy(std::span<const Bar> bars, bool normalised = false);

/// The largest lengths, descending, as many as `out` has; 0 where there are no more bars. O(n log
/// n).
void longest_lengths(std::span<const Bar> bars, std::span<double> out);

// ---- curves: out has grid.points numbers

/// The Betti curve: how many bars live at t, birth <= t < death. Infinite bars are welcome.
/// O(n + m) of n bars and m points.
void betti_curve(std::span<const Bar> bars, const Grid& grid, std::span<double> out);

/// The entropy of bars alive: -Σ p ln p over birth <= t < death; p is the share in the lengths of
/// all bars. In nats. Source: Atienza, González-Díaz, Soriano-Trigueros, On the stability of
/// persistent entropy and new summary functions for topological data analysis, 2020. O(n + m).
void life_entropy_curve(std::span<const Bar> bars, const Grid& grid, std::span<double> out);

/// The silhouette: Σ w max(0, min(t - birth, death - t)) / Σ w, with w = length^power; 0 of no
/// bars. There is no factor √2, as where heights are distances from the diagonal.
///
/// Source: Chazal et al., Stochastic convergence of persistence landscapes and silhouettes, 2014.
/// O(n + m), sums in twice as many digits.
/// @param power finite, at least 0.
void silhouette(std::span<const Bar> bars, const Grid& grid, double power, std::span<double> out);

/// The first persistence landscapes: layer k at t is the k-th largest of max(0, min(t - birth,
/// death - t)), to the last bit. There is no factor √2. A bar that never dies is welcome: it grows
/// for ever; but none that was always there.
///
/// Source: Bubenik, Statistical topological data analysis using persistence landscapes, 2015. Bars
/// that grow at t and those that shrink are sorted into grid cells by the change; the best of each
/// are kept while the grid is walked once down, once up. O((n + m) layers) at most.
/// @param layers at least 1. @param out layers × grid.points, a row each layer.
void landscape(std::span<const Bar> bars, const Grid& grid, std::size_t layers,
               std::span<double> out, const RunContext& context = default_context());

/// A continuous function, linear between its critical points; 0 before the first and behind the
/// last.
struct PiecewiseLinear {
  std::vector<double> at;     ///< ascending
  std::vector<double> value;  ///< as many
  /// @throws Error (usage) if there are not as many values as places.
  double operator()(double t) const;
};

/// The first persistence landscapes, exact: all their critical points. Fewer where the others are 0
/// everywhere.
///
/// Source: Bubenik, Dłotko, A persistence landscapes toolbox for topological statistics, 2017: the
/// upper hull of the tents is peeled off. O(n log n + n · layers); n layers at most.
std::vector<PiecewiseLinear> exact_landscape(std::span<const Bar> bars, std::size_t layers,
                                             const RunContext& context = default_context());

// ---- pictures

/// The persistence image: each bar is a normal distribution around (birth, length), of standard
/// deviation `sigma` along both axes, times length^power; a pixel has the integral over it. What a
/// bar has farther than 8 sigma away, less than 2e-15 of it, is left out.
///
/// Source: Adams et al., 2017, Persistence images: a stable vector representation of persistent
/// homology. O(n · pixels within 8 sigma). Unit: that of the values to `power`; without one if it
/// is 0.
/// @param sigma finite, > 0. @param power finite, at least 0.
/// @param out lengths × births: a row for each interval of lengths, ascending.
void persistence_image(std::span<const Bar> bars, const ImageFrame& frame, double sigma,
                       double power, std::span<double> out,
                       const RunContext& context = default_context());

// ---- by a batch

/// What ATOL has learned of a batch: places of the plane (birth, death), and how far each reaches.
struct Atol {
  enum class Contrast {
    laplace,  ///< exp(-distance / width)
    gauss,    ///< exp(-distance² / width²)
  };
  std::vector<std::array<double, 2>> centres;  ///< ascending
  std::vector<double> widths;                  ///< as many, > 0
  Contrast contrast = Contrast::laplace;
  friend bool operator==(const Atol&, const Atol&) = default;
};

struct AtolOptions {
  std::size_t centres = 10;  ///< at least 1
  Atol::Contrast contrast = Atol::Contrast::laplace;
  std::uint64_t seed = 0;  ///< of the first centres
  int most_rounds = 300;   ///< of k-means, at least 0
};

/// Automatic topologically-oriented learning: the bars of all diagrams are points (birth, death),
/// k-means finds their centres, and half the distance to the nearest other centre is a width (of a
/// single one the mean distance of the points, 1 if that is 0).
///
/// Source: Royer et al., 2021, ATOL: measure vectorization for automatic topologically-oriented
/// learning. First centres by k-means++ (Arthur, Vassilvitskii, 2007), then rounds until no point
/// changes its centre. The result is the same on any machine, for bars and diagrams in any order
/// and for any number of threads. O(n · centres) a round, shared by threads.
/// @throws Error (usage) on options out of range; Error (bad_data) on fewer points that differ than
///         centres; Error (resource, cancelled).
Atol fit_atol(std::span<const std::span<const Bar>> diagrams, const AtolOptions& options = {},
              const RunContext& context = default_context());

/// For each centre the sum over the bars of what `contrast` says. Without unit. O(n · centres).
/// @param out as many as there are centres. @throws Error (usage) on an `Atol` that is none.
void atol_vector(std::span<const Bar> bars, const Atol& fitted, std::span<double> out);

// ---- kernels

/// The persistence scale-space kernel of two diagrams: 1 / (8 π sigma) · Σ exp(-|p - q|² / (8
/// sigma)) - exp(-|p - q'|² / (8 sigma)) over bars p of one, q of the other; q' is q with birth and
/// death exchanged. Positive definite. sigma has the unit of the values, squared.
///
/// Source: Reininghaus et al., A stable multi-scale kernel for topological machine learning, 2015.
/// Pairs with |p - q|² > 320 sigma, less than 5e-18 of one that agrees, are left out. O(n m) at
/// most.
/// @param sigma finite, > 0.
double scale_space_kernel(std::span<const Bar> a, std::span<const Bar> b, double sigma,
                          const RunContext& context = default_context());

struct WeightedGaussian {
  double sigma = 1;  ///< finite, > 0; in the unit of the values
  double slope = 1;  ///< finite, > 0; a bar weighs arctan(slope · length^power)
  double power = 1;  ///< finite, at least 0
};

/// The persistence weighted Gaussian kernel (the linear one): Σ w(p) w(q) exp(-|p - q|² / (2
/// sigma²)). Positive definite.
///
/// Source: Kusano, Fukumizu, Hiraoka, Persistence weighted Gaussian kernel for topological data
/// analysis, 2016. Pairs with |p - q|² > 80 sigma² are left out, as above.
double weighted_gaussian_kernel(std::span<const Bar> a, std::span<const Bar> b,
                                const WeightedGaussian& options = {},
                                const RunContext& context = default_context());

/// A kernel of two diagrams. Called by several threads.
using DiagramKernel =
    std::function<double(std::span<const Bar>, std::span<const Bar>, const RunContext&)>;

/// The Gram matrix of N diagrams: N × N in C order, symmetric. Threads share the pairs; the result
/// does not depend on them.
/// @param kernel symmetric; called once for each pair, also of a diagram with itself, with a
/// context
///        of one thread.
/// @throws what `kernel` throws; Error (cancelled).
std::vector<double> gram_matrix(std::span<const std::span<const Bar>> diagrams,
                                const DiagramKernel& kernel,
                                const RunContext& context = default_context());

}  // namespace ph

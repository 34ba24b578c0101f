// SPDX-License-Identifier: MIT
// This header defines the vectors, that is, everything that a test set shares with the training
// set.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ph/cubical.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/vectorise.hpp"

namespace ph::vectorise {

enum class Kind {
  statistics,
  betti,
  landscape,
  silhouette,
  image,
  entropy,
  life_entropy,
  lengths,
  atol,
  euler,
};

/// The treatment of bars that are not finite.
struct InfiniteRule {
  enum class Rule { drop, keep, error, cap };
  Rule rule = Rule::drop;
  double cap = 0;
};

/// The parameters for the bars of one dimension or, for an Euler curve, for the bars of all
/// dimensions.
struct Block {
  int dim = 0;       ///< unused for an Euler curve
  Grid grid;         ///< for curves and landscapes
  ImageFrame frame;  ///< for persistence images
  double sigma = 0;  ///< the bandwidth of persistence images
  Atol atol;
};

struct Fit {
  Kind kind = Kind::statistics;
  InfiniteRule infinite;
  std::size_t layers = 5;   ///< the number of layers of landscapes
  std::size_t count = 5;    ///< the number of lengths
  double power = 1;         ///< for silhouettes and images
  bool normalised = false;  ///< for the entropy
  CubicalOptions cubical;   ///< for images whose Euler curves are requested
  std::vector<Block> blocks;
};

/// The size of a block along each axis, such as {layers, points}.
std::vector<std::size_t> shape_of(const Fit& fit, const Block& block);
/// The length of a vector.
std::size_t length_of(const Fit& fit);
/// A name for each number, such as "H1_layer0_17".
std::vector<std::string> names_of(const Fit& fit);

/// True if the function for this kind accepts infinite bars. In this case, --infinite keep is
/// allowed.
bool may_keep_infinite(Kind kind);

/// Rewords an error of a library function that received the bars of an input. The message begins
/// with the name of the input instead of the function's name.
Error about_input(const Error& error, std::string_view name);

/// The bars of a block in the form that its function expects. @param name the name of the input,
/// for messages.
/// @param dropped is increased by the number of bars that were left out.
std::vector<Bar> bars_of(const Fit& fit, std::span<const Bar> bars, std::string_view name,
                         std::size_t& dropped);

/// Writes the vector of a block. Must not be called for an Euler curve.
void write_block(const Fit& fit, const Block& block, std::span<const Bar> bars,
                 std::span<double> out, const RunContext& context);

/// The content that `--fit` writes. @param dropped the number of bars that were left out of the
/// fit.
std::string fit_json(const Fit& fit, std::size_t dropped);

/// Parses a file for `--fitted`. @throws Error (bad_data) if the file does not contain a fit.
Fit read_fit(const Input& input);

}  // namespace ph::vectorise

namespace ph {

template <>
inline constexpr std::array names_of<vectorise::Kind>{
    Named{vectorise::Kind::statistics, "statistics"},
    Named{vectorise::Kind::betti, "betti"},
    Named{vectorise::Kind::landscape, "landscape"},
    Named{vectorise::Kind::silhouette, "silhouette"},
    Named{vectorise::Kind::image, "image"},
    Named{vectorise::Kind::entropy, "entropy"},
    Named{vectorise::Kind::life_entropy, "life-entropy"},
    Named{vectorise::Kind::lengths, "lengths"},
    Named{vectorise::Kind::atol, "atol"},
    Named{vectorise::Kind::euler, "euler"},
};

template <>
inline constexpr std::array names_of<vectorise::InfiniteRule::Rule>{
    Named{vectorise::InfiniteRule::Rule::drop, "drop"},
    Named{vectorise::InfiniteRule::Rule::keep, "keep"},
    Named{vectorise::InfiniteRule::Rule::error, "error"},
};

}  // namespace ph

// SPDX-License-Identifier: MIT
// What vectors are made, and of what: all that a test set has in common with the training set.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ph/cubical.hpp"
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
inline constexpr std::array<std::string_view, 10> kKinds{
    "statistics", "betti",        "landscape", "silhouette", "image",
    "entropy",    "life-entropy", "lengths",   "atol",       "euler"};

/// What becomes of bars that are not finite.
struct InfiniteRule {
  enum class Rule { drop, keep, error, cap };
  Rule rule = Rule::drop;
  double cap = 0;
};

/// Of the bars of one dimension; of an Euler curve of all of them.
struct Block {
  int dim = 0;       ///< not of an Euler curve
  Grid grid;         ///< of curves and landscapes
  ImageFrame frame;  ///< of images
  double sigma = 0;  ///< the same
  Atol atol;
};

struct Fit {
  Kind kind = Kind::statistics;
  InfiniteRule infinite;
  std::size_t layers = 5;   ///< of landscapes
  std::size_t count = 5;    ///< of lengths
  double power = 1;         ///< of silhouettes and images
  bool normalised = false;  ///< of the entropy
  CubicalOptions cubical;   ///< of images whose Euler curves are asked for
  std::vector<Block> blocks;
};

/// How many numbers a block has, by axis: {layers, points}.
std::vector<std::size_t> shape_of(const Fit& fit, const Block& block);
/// How many numbers a vector has.
std::size_t length_of(const Fit& fit);
/// A name for each of them: "H1_layer0_17".
std::vector<std::string> names_of(const Fit& fit);

/// Which infinite bars may be kept: those functions know what they are.
bool may_keep_infinite(Kind kind);

/// An error of a function of the library that was given bars of an input: begins with the name of
/// the input in place of that of the function, and gives the option as advice.
Error about_input(const Error& error, std::string_view name);

/// The bars of a block as its function takes them. @param name of the input, for messages.
/// @param dropped grows by how many were left out.
std::vector<Bar> bars_of(const Fit& fit, std::span<const Bar> bars, std::string_view name,
                         std::size_t& dropped);

/// The vector of a block. Not of an Euler curve.
void write_block(const Fit& fit, const Block& block, std::span<const Bar> bars,
                 std::span<double> out, const RunContext& context);

}  // namespace ph::vectorise

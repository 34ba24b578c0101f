// SPDX-License-Identifier: MIT
#include "apps/vectorise/fit/fit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ph/detail/vectors/checked_bars.hpp"
#include "ph/error.hpp"

namespace ph::vectorise {
namespace {

std::size_t product(const std::vector<std::size_t>& shape) {
  std::size_t numbers = 1;
  for (const std::size_t n : shape)
    if (__builtin_mul_overflow(numbers, n, &numbers))
      throw Error(ErrorKind::resource, "a vector would have more numbers than 64 bits can count");
  return numbers;
}

/// The part of a number's name before its index.
std::string_view word_of(Kind kind) {
  switch (kind) {
    case Kind::atol:
      return "centre";
    case Kind::lengths:
      return "length";
    case Kind::life_entropy:
      return "life_entropy";
    default:
      return name_of(kind);
  }
}

void add_names(const Fit& fit, const Block& block, std::vector<std::string>& names) {
  const std::string of_dim = fit.kind == Kind::euler ? "" : fmt::format("H{}_", block.dim);
  const std::vector<std::size_t> shape = shape_of(fit, block);
  if (fit.kind == Kind::entropy) {
    names.push_back(of_dim + "entropy");
  } else if (fit.kind == Kind::statistics) {
    for (const std::string_view name : statistics_names())
      names.push_back(of_dim + std::string(name));
  } else if (shape.size() == 2) {
    const bool is_image = fit.kind == Kind::image;
    for (std::size_t i = 0; i < shape[0]; ++i)
      for (std::size_t j = 0; j < shape[1]; ++j)
        names.push_back(is_image ? fmt::format("{}p{}_b{}", of_dim, i, j)
                                 : fmt::format("{}layer{}_{}", of_dim, i, j));
  } else {
    for (std::size_t i = 0; i < shape[0]; ++i)
      names.push_back(fmt::format("{}{}{}", of_dim, word_of(fit.kind), i));
  }
}

}  // namespace

std::vector<std::size_t> shape_of(const Fit& fit, const Block& block) {
  switch (fit.kind) {
    case Kind::statistics:
      return {kStatistics};
    case Kind::landscape:
      return {fit.layers, block.grid.points};
    case Kind::image:
      return {block.frame.lengths.pixels, block.frame.births.pixels};  // mutant: fit-rows
    case Kind::entropy:
      return {1};
    case Kind::lengths:
      return {fit.count};
    case Kind::atol:
      return {block.atol.centres.size()};
    default:
      return {block.grid.points};
  }
}

std::size_t length_of(const Fit& fit) {
  std::size_t length = 0;
  for (const Block& block : fit.blocks) length += product(shape_of(fit, block));
  return length;
}

std::vector<std::string> names_of(const Fit& fit) {
  std::vector<std::string> names;
  names.reserve(length_of(fit));
  for (const Block& block : fit.blocks) add_names(fit, block, names);
  return names;
}

bool may_keep_infinite(Kind kind) {
  return kind == Kind::betti || kind == Kind::landscape || kind == Kind::euler;
}

Error about_input(const Error& error, std::string_view name) {
  return Error(error.kind(), fmt::format("{}: {}", name, error.message().without_place().marked()));
}

std::vector<Bar> bars_of(const Fit& fit, std::span<const Bar> bars, std::string_view name,
                         std::size_t& dropped) {
  using Rule = InfiniteRule::Rule;
  InfiniteBars rule;
  if (fit.infinite.rule == Rule::cap) rule = {InfiniteBars::Rule::cap, fit.infinite.cap};
  if (fit.infinite.rule == Rule::error)
    for (const Bar& bar : bars)
      if (!std::isfinite(bar.birth) || !std::isfinite(bar.death))
        throw Error(
            ErrorKind::bad_data,
            fmt::format("{}: found a bar [{}, {}) of H{}, expected finite bars; --infinite "
                        "drop leaves out all other bars, --infinite T sets the death of bars "
                        "that never die",
                        name, bar.birth, bar.death, bar.dim));
  try {
    if (fit.infinite.rule == Rule::keep) {
      for (const Bar& bar : bars) vectors::check_bar(bar, "bars");
      return {bars.begin(), bars.end()};
    }
    FiniteBars finite = finite_bars(bars, rule);
    dropped += finite.dropped;
    return std::move(finite.bars);
  } catch (const Error& error) {
    throw about_input(
        error, fmt::format("{}{}", name, fit.infinite.rule == Rule::cap ? ": --infinite" : ""));
  }
}

void write_block(const Fit& fit, const Block& block, std::span<const Bar> bars,
                 std::span<double> out, const RunContext& context) {
  switch (fit.kind) {
    case Kind::statistics:
      return statistics(bars, out);
    case Kind::betti:
      return betti_curve(bars, block.grid, out);
    case Kind::landscape:
      return landscape(bars, block.grid, fit.layers, out, context);
    case Kind::silhouette:
      return silhouette(bars, block.grid, fit.power, out);
    case Kind::image:
      return persistence_image(bars, block.frame, block.sigma, fit.power, out, context);
    case Kind::entropy:
      out[0] = entropy(bars, fit.normalised);
      return;
    case Kind::life_entropy:
      return life_entropy_curve(bars, block.grid, out);
    case Kind::lengths:
      return longest_lengths(bars, out);
    case Kind::atol:
      return atol_vector(bars, block.atol, out);
    case Kind::euler:
      throw Error(ErrorKind::internal, "an Euler curve has no block of bars");
  }
}

}  // namespace ph::vectorise

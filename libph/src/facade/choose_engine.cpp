// SPDX-License-Identifier: MIT
#include "ph/detail/facade/choose_engine.hpp"

#include <fmt/format.h>

#include <cmath>

namespace ph::detail {
namespace {

std::string_view asked_beside(const Task& task) {
  switch (task.representatives) {
    case Representatives::cycles:
      return " together with cycles";
    case Representatives::voxels:
      return " together with sets of voxels";
    case Representatives::cocycles:
      return " together with cocycles";
    case Representatives::none:
      break;
  }
  return {};
}

}  // namespace

void check(const Options& options) {
  const auto at_least_0 = [](std::string_view name, int dim) {
    if (dim < 0)  // mutant: negative-dimension
      throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected >= 0", name, dim));
  };
  at_least_0("highest dimension", options.max_dim.value_or(0));
  at_least_0("lowest dimension", options.min_dim);
  if (std::isnan(options.min_persistence))  // mutant: persistence-nan
    throw Error(ErrorKind::usage, "least persistence: found nan, expected a number");
  require_field(options.field);  // mutant: field-is-prime
}

void check_as_it_is(const Options& options, bool has_incidences) {
  check(options);
  if (options.collapse == Collapse::on)
    throw Error(ErrorKind::usage, "edge collapse is for Rips complexes only");
  if (!has_incidences && options.field != 2)  // mutant: field-without-incidences
    throw Error(ErrorKind::usage,
                fmt::format("field {}: this boundary matrix has no incidence numbers, so "
                            "only field 2 is possible",
                            options.field));
}

void refuse(Engine asked, const Task& task) {
  if (asked != Engine::automatic)
    throw Error(
        ErrorKind::usage,
        fmt::format("engine {}: cannot compute homology of this complex up to dimension {}{}{}",
                    asked.name(), task.max_dim, asked_beside(task),
                    !task.zero_length            ? ""
                    : asked_beside(task).empty() ? " together with zero-length bars"
                                                 : " and zero-length bars"));
  if (!task.wants_no_sets())
    throw Error(ErrorKind::usage,
                "sets of voxels need an image in which at most three axes have more than one "
                "voxel, and bars of positive length");
  throw Error(ErrorKind::usage, "cocycles need a complex that can list the cofacets of its cells");
}

}  // namespace ph::detail

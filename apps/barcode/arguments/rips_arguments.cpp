// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/argument_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "apps/common/values/numbers.hpp"

namespace ph::barcode {

using app::parse_integer;
using app::parse_number;

void add_rips_options(app::Options& options, Job& job) {
  options.topic("rips");
  const auto number = [&](const std::string& option, const std::string& placeholder,
                          const std::string& description, bool may_be_zero, auto take) {
    options.value({option, kOfAllPairs}, placeholder, description, [=](const std::string& text) {
      const double value = parse_number(option, text);
      if (!std::isfinite(value) || value < 0 || (value == 0 && !may_be_zero))
        throw Error(ErrorKind::usage,
                    fmt::format("{}: found '{}', expected a finite number {} 0", option, text,
                                may_be_zero ? "of at least" : "above"));
      take(value);
    });
  };
  options.choice(
      {"--collapse", kOfRips},
      "collapse edges first, which leaves fewer of them and the same bars (default auto: "
      "where it pays)",
      job.question.options.collapse);
  options.choice(
      {"--device", kOfPoints},
      "what finds the components of points with Euclidean distances, --max-dim 0 (default "
      "cpu); the results are the same. gpu: one of NVIDIA, where that is built in",
      job.question.rips.device);
  const auto limits = [&job]() -> GreedyLimits& {
    if (!job.question.rips.subsample) job.question.rips.subsample.emplace();
    return *job.question.rips.subsample;
  };
  options.value(
      {"--subsample", kOfAllPairs}, "N",
      "keep N points, each the farthest from those before (default: all); with their "
      "covering radius E, bars longer than 2 E are real and come at most 2 E late",
      [=](const std::string& text) { limits().points = parse_integer("--subsample", text, 1); });
  number("--subsample-radius", "R",
         "keep points until all are within R of one (default 0), in units of the distance", true,
         [=](double radius) { limits().radius = radius; });
  number("--approximate", "EPS",
         "sparse Rips: fewer edges, and bars that are born and die later by a factor of 1 + EPS at "
         "most",
         false, [&job](double epsilon) { job.question.rips.approximation = epsilon; });
  options.path(
      {"--vertex-weights", kOfRips}, "FILE",
      "when each point enters, one number per point, in units of the distance (default: all at "
      "0)",
      job.question.vertex_weights);
  options.value({"--dtm", kOfAllPairs}, "K",
                "DTM filtration: points enter at twice their distance to the measure of their K "
                "nearest points, themselves included",
                [&job](const std::string& text) {
                  job.question.rips.dtm_neighbours = parse_integer("--dtm", text, 1);
                });
  options.value({"--core", kOfAllPairs}, "K",
                "points enter at their core distance, the distance to their K-th nearest other "
                "point, and edges at the mutual reachability distances of HDBSCAN*",
                [&job](const std::string& text) {
                  job.question.rips.core_neighbours = parse_integer("--core", text, 0);
                });
  options.choice(
      {"--weight-exponent", kOfRips},
      "how the ball of a point born at B has grown at T: to (T^P - B^P)^(1/P) (default inf, "
      "with --dtm 1)",
      job.question.rips.weight_exponent);
}

void check_rips_arguments(Job& job) {
  std::vector<std::string_view> sources;
  if (!job.question.vertex_weights.empty()) {
    sources.push_back("--vertex-weights");
  }
  if (job.question.rips.dtm_neighbours) sources.push_back("--dtm");
  if (job.question.rips.core_neighbours) sources.push_back("--core");
  if (job.reading.options.diagonal == Diagonal::births) sources.push_back("--diagonal births");
  const auto exclude = [](std::string_view one, std::string_view other) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: cannot be combined with {}; leave out one of them", one, other));
  };
  if (sources.size() > 1) exclude(sources[0], sources[1]);
  if (sources.empty() && job.question.rips.weight_exponent)
    throw Error(ErrorKind::usage, "--weight-exponent needs --dtm, --core or --vertex-weights");
  if (sources.empty()) return;
  if (job.question.rips.subsample) exclude(sources[0], "--subsample");
  if (job.question.rips.approximation) exclude(sources[0], "--approximate");
  if (job.reading.options.diagonal == Diagonal::births && job.reading.options.from_correlation)
    exclude("--diagonal births", "--from-correlation");
  if (job.question.vertex_weights == "-" && std::ranges::count(job.inputs, "-") > 0)
    throw Error(ErrorKind::usage, "--vertex-weights: standard input can be read once only");
}

}  // namespace ph::barcode

// SPDX-License-Identifier: MIT
#include "ph/parts/cloud_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "libph/src/facade/parts/cloud_state.hpp"
#include "libph/src/metric/blocks/cloud_blocks.hpp"
#include "ph/barcode.hpp"
#include "ph/detail/facade/describe.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/detail/metric/spanning_forest.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

/// The size of the sample that each part draws from the cloud, unless the user chooses it. With a
/// larger sample, each part takes longer. With a smaller sample, a larger share of the cloud counts
/// as near a block. For a cloud that fills three dimensions, this share is (blocks / sample)^1/3.
/// All parts compute the same number and therefore draw the same points.
Index points_to_draw(Index points, double blocks) {
  constexpr double least_a_block = 64, most = 1 << 28;
  const double n = static_cast<double>(points);
  const double balanced = std::sqrt(n * std::sqrt(n)) / std::sqrt(blocks);
  return static_cast<Index>(std::min({n, std::max(balanced, least_a_block * blocks), most}));
}

void check(PointsView points, int part, int parts, const CloudPartOptions& options) {
  const auto refuse = [](const std::string& what) {
    throw Error(ErrorKind::usage, "parts of a cloud: " + what);
  };
  if (options.distance != PointDistance::euclidean)
    refuse(fmt::format("found distance {}, expected euclidean", name_of(options.distance)));
  constexpr Index most_axes = 8;  // with more axes, most points are near all blocks
  if (points.cols() > most_axes)
    refuse(fmt::format("found {} coordinates, expected at most {}", points.cols(), most_axes));
  if (options.threshold && !(*options.threshold >= 0))
    refuse(fmt::format("found threshold {}, expected a number >= 0", *options.threshold));
  if (parts < 1 || parts > 1 << 30)
    refuse(fmt::format("found {} parts, expected 1 to 2^30", parts));
  if (part < 0 || part >= parts)
    refuse(fmt::format("found part {0} of {1}, expected part 1 to {1}", part + 1, parts));
  if (options.blocks < 0 || options.blocks > (1 << 30) / parts)
    refuse(fmt::format("found {} blocks in each of {} parts, expected at most 2^30 blocks in total",
                       options.blocks, parts));
  if (options.sample < 0 || options.sample > points.rows() || options.sample > Index{1} << 30)
    refuse(fmt::format(
        "found a sample of {}, expected 0 to the number of points, {}, and at most 2^30",
        options.sample, points.rows()));
}

WholeCloud whole_cloud(PointsView points, int parts, const CloudPartOptions& options) {
  constexpr Index points_of_block = 1 << 22;
  const Index n = points.rows();
  WholeCloud whole{
      n,     points.cols(),  options.sample,
      parts, options.blocks, options.threshold.value_or(std::numeric_limits<double>::infinity()),
      0};
  if (whole.blocks == 0)
    whole.blocks = static_cast<int>(std::clamp<Index>(
        (n / parts + points_of_block - 1) / points_of_block, 1, (1 << 30) / parts));
  if (whole.sample == 0)
    whole.sample =
        points_to_draw(n, static_cast<double>(whole.blocks) * static_cast<double>(parts));
  if (n > 0 && whole.sample == 0) whole.sample = 1;
  return whole;
}

}  // namespace

CloudPart::CloudPart(PointsView points, int part, int parts, const CloudPartOptions& options,
                     const RunContext& context) {
  check(points, part, parts, options);
  state_ = std::make_unique<State>(whole_cloud(points, parts, options), context);
  WholeCloud& whole = state_->whole;
  state_->present = {part};
  const auto blocks_of = static_cast<std::uint32_t>(whole.blocks);
  const std::uint32_t first = static_cast<std::uint32_t>(part) * blocks_of;
  const CloudBlocks blocks(points, static_cast<std::size_t>(whole.sample),
                           static_cast<std::uint32_t>(parts) * blocks_of,
                           {first, first + blocks_of}, context);
  whole.fingerprint = blocks.fingerprint();
  state_->size = blocks.size();
  for (std::uint32_t b = first; b < first + blocks_of; ++b) {
    context.report({"blocks", b - first, blocks_of});
    state_->forest.join(blocks.forest(b, whole.limit, context), context);
  }
}

CloudPartForecast CloudPart::forecast(PointsView points, int parts,
                                      const CloudPartOptions& options) {
  check(points, 0, parts, options);
  const WholeCloud whole = whole_cloud(points, parts, options);
  const auto n = static_cast<double>(whole.points), of_part = n / parts;
  const double of_block = of_part / whole.blocks;
  // The factors below were measured on 10⁶ to 10⁸ points, uniform and in clusters (see
  // bench/parts/cloud_parts.cpp). More points lie near a block than in it if the block is small or
  // at the border of a cluster.
  constexpr double small = 32 << 20;
  CloudPartForecast forecast;
  forecast.memory = {60 * of_block + 16 * of_part, small + 700 * of_block + 24 * of_part};
  forecast.file = {16 * of_part, 1024 + 50 * of_part};
  forecast.join = {24 * n, small + 64 * n};
  // If parts are joined along a tree, half of the remaining parts are sent at each step.
  forecast.sent = {16 * (n - of_part), 25 * n * std::ceil(std::log2(parts)) + 1024.0 * (parts - 1)};
  return forecast;
}

CloudPart::CloudPart(std::unique_ptr<State> state) : state_(std::move(state)) {}
CloudPart::CloudPart(CloudPart&&) noexcept = default;
CloudPart& CloudPart::operator=(CloudPart&&) noexcept = default;
CloudPart::~CloudPart() = default;

int CloudPart::parts() const { return state_->whole.parts; }

Index CloudPart::points() const { return state_->whole.points; }
Index CloudPart::coordinates() const { return state_->whole.axes; }
std::optional<double> CloudPart::threshold() const {
  const double limit = state_->whole.limit;
  return limit < kInfinity ? std::optional(limit) : std::nullopt;
}
bool CloudPart::is_of(PointsView points, int part, int parts,
                      const CloudPartOptions& options) const {
  WholeCloud whole = whole_cloud(points, parts, options);
  whole.fingerprint = CloudBlocks::fingerprint_of(points);
  return state_->whole == whole && state_->present == std::vector{part};
}

const std::vector<int>& CloudPart::present() const { return state_->present; }
std::vector<int> CloudPart::missing() const {
  std::vector<int> missing;
  auto next = state_->present.begin();
  for (int part = 0; part < parts(); ++part) {
    if (next != state_->present.end() && *next == part)
      ++next;
    else
      missing.push_back(part);
  }
  return missing;
}

void CloudPart::join(CloudPart other, const RunContext& context) {
  if (other.state_->whole != state_->whole)
    throw Error(
        ErrorKind::bad_data,
        "parts of clouds: found parts that differ in points, options or number of parts, expected "
        "parts of one cloud");
  const std::vector<int>& others = other.state_->present;
  std::vector<int> present, twice;
  std::ranges::set_intersection(state_->present, others, std::back_inserter(twice));
  if (!twice.empty())
    throw Error(ErrorKind::bad_data,
                fmt::format("parts of a cloud: found part {} twice", twice[0] + 1));
  std::ranges::merge(state_->present, others, std::back_inserter(present));
  if (other.state_->size > state_->whole.points - state_->size)
    throw Error(ErrorKind::bad_data, fmt::format("parts of a cloud: found more points than the {} "
                                                 "of the cloud, expected parts of one cloud",
                                                 state_->whole.points));
  state_->forest.join(std::move(other.state_->forest), context);
  state_->present = std::move(present);
  state_->size += other.state_->size;
}

Rips CloudPart::rips(const RunContext& context) const& {
  auto copy = std::make_unique<State>(state_->whole, context);
  copy->present = state_->present;
  copy->size = state_->size;
  copy->forest.numbers = state_->forest.numbers;
  copy->forest.edges = state_->forest.edges;
  copy->forest.claims = state_->forest.claims;
  return CloudPart(std::move(copy)).rips(context);
}

// A part leaves out an edge if other edges join its ends. If the part has only claimed that these
// other edges are in the forest, the entire forest must confirm the claim.
void CloudPart::State::check_joined() const {
  const bool is_spanning =
      whole.limit < kInfinity ||
      forest.edges.size() + 1 == static_cast<std::size_t>(std::max<Index>(whole.points, 1));
  if (size != whole.points || !forest.claims.empty() || !is_spanning)  // mutant: cloud-joined
    throw Error(ErrorKind::bad_data,
                "parts of a cloud: found points that are not joined as the parts claim, expected "
                "parts of one cloud whose points did not change between the parts");
}

BarcodeInfo CloudPart::info() const {
  BarcodeInfo info = detail::info_of_task({}, 0, Engine::union_find);
  info.complex = "rips";
  info.metric = metric_name(PointDistance::euclidean);
  info.points = info.vertices = points();
  info.coordinates = coordinates();
  info.threshold = threshold();
  return info;
}

// Each edge of the forest kills one component. All components are born at 0.
Barcode CloudPart::barcode(const RunContext& context) const {
  state_->check_joined();
  const FlagEdges& edges = state_->forest.edges;
  const auto first = std::ranges::upper_bound(edges, 0.0, {}, &FlagEdge::value);
  const auto immortal = static_cast<std::size_t>(state_->whole.points) - edges.size();
  const std::size_t count = static_cast<std::size_t>(edges.end() - first) + immortal;
  const MemoryClaim claim(context.memory, count * sizeof(Bar));
  Barcode bars;
  bars.reserve_more(count);
  for (auto edge = first; edge != edges.end(); ++edge) bars.add({0, 0, edge->value});
  for (std::size_t i = 0; i < immortal; ++i) bars.add({0, 0, kInfinity});
  bars.set_info(info());
  return bars;
}

Rips CloudPart::rips(const RunContext& context) && {
  const WholeCloud& whole = state_->whole;
  RipsGraph::check_size(whole.points);
  state_->check_joined();
  NumberedForest forest = std::move(state_->forest);
  if (forest.numbers.size() < static_cast<std::size_t>(whole.points))
    for (FlagEdge& e : forest.edges)
      e = {e.value, static_cast<std::uint32_t>(forest.numbers[e.u]),
           static_cast<std::uint32_t>(forest.numbers[e.v])};
  forest.numbers = std::pmr::vector<Index>(&context.memory);
  return Rips(RipsGraph::of_forest(whole.points, whole.limit, std::move(forest.edges), context));
}

}  // namespace ph

// SPDX-License-Identifier: MIT
// Writes a part of a cloud as bytes, and reads such bytes. The bytes contain the data of the cloud,
// the numbers of the parts, and their points, edges and claims. When bytes are read, each number
// that refers to a list is checked against the length of the list.
#include <cmath>
#include <string_view>
#include <utility>

#include "libph/src/facade/parts/cloud_state.hpp"
#include "ph/detail/components/disjoint_sets.hpp"
#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/detail/core/sealed_part.hpp"
#include "ph/detail/metric/spanning_forest.hpp"

namespace ph {
namespace {

constexpr std::string_view kCloudKind = "cloud";

void put_edges(ByteWriter& to, const FlagEdges& edges) {
  to.put_list(edges, [&](const FlagEdge& e) {
    to.put(e.value);
    to.put(e.u);
    to.put(e.v);
  });
}

FlagEdges get_edges(ByteReader& from, std::size_t points, double limit, std::string_view what,
                    const RunContext& context) {
  constexpr std::size_t bytes_of_edge = 16;
  FlagEdges edges(&context.memory);
  edges.resize(from.count(bytes_of_edge, what));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    FlagEdge& e = edges[i];
    e.value = from.get<double>(what);
    e.u = from.get<std::uint32_t>(what);
    e.v = from.get<std::uint32_t>(what);
    const bool is_edge = e.value >= 0 && !std::signbit(e.value) && e.value <= limit &&
                         std::isfinite(e.value) && e.v < e.u && e.u < points;
    if (!is_edge || (i > 0 && !precedes(edges[i - 1], e))) from.refuse(what);
  }
  return edges;
}

WholeCloud get_whole_cloud(ByteReader& from) {
  WholeCloud whole{};
  for (Index* const n : {&whole.points, &whole.axes, &whole.sample})
    *n = static_cast<Index>(from.get<std::int64_t>("size"));
  for (int* const n : {&whole.parts, &whole.blocks}) *n = from.get<std::int32_t>("number of parts");
  whole.limit = from.get<double>("threshold");
  whole.fingerprint = from.get<std::uint64_t>("fingerprint");
  constexpr Index most_points = Index{1} << 60, most_axes = 8;
  if (whole.points < 0 || whole.points > most_points || whole.axes < 0 || whole.axes > most_axes ||
      whole.sample < 0 || whole.sample > whole.points)
    from.refuse("size");
  if (whole.parts < 1 || whole.blocks < 1) from.refuse("number of parts");
  if (!(whole.limit >= 0)) from.refuse("threshold");
  return whole;
}

}  // namespace

std::vector<std::byte> CloudPart::bytes() const {
  const NumberedForest& forest = state_->forest;
  ByteWriter to;
  to.reserve(256 + 4 * state_->present.size() + 2 * forest.numbers.size() +
             16 * (forest.edges.size() + forest.claims.size()));
  const WholeCloud& whole = state_->whole;
  for (const Index n : {whole.points, whole.axes, whole.sample}) to.put(std::int64_t{n});
  for (const int n : {whole.parts, whole.blocks}) to.put(std::int32_t{n});
  to.put(whole.limit);
  to.put(whole.fingerprint);
  to.put_list(state_->present, [&](int part) { to.put(std::int32_t{part}); });
  to.put(std::int64_t{state_->size});
  Index next = 0;
  to.put_list(forest.numbers, [&](Index number) {
    to.put_short(static_cast<std::uint64_t>(number - next));
    next = number + 1;
  });
  put_edges(to, forest.edges);
  put_edges(to, forest.claims);
  return sealed_part(kCloudKind, to.take());
}

CloudPart CloudPart::of_bytes(std::span<const std::byte> bytes, const RunContext& context) {
  ByteReader from(content_of_part(bytes, kCloudKind), "part of a cloud");
  auto state = std::make_unique<State>(get_whole_cloud(from), context);
  const WholeCloud& whole = state->whole;
  state->present.resize(from.count(sizeof(std::int32_t), "part"));
  if (state->present.empty()) from.refuse("part");
  int last = -1;
  for (int& part : state->present) {
    part = from.get<std::int32_t>("part");
    if (part <= last || part >= whole.parts) from.refuse("part");
    last = part;
  }
  state->size = static_cast<Index>(from.get<std::int64_t>("number of points"));
  if (state->size < 0 || state->size > whole.points) from.refuse("number of points");

  NumberedForest& forest = state->forest;
  forest.numbers.resize(from.count(1, "points"));
  if (forest.numbers.size() >= UINT32_MAX) from.refuse("points");
  std::uint64_t next = 0;
  for (Index& number : forest.numbers) {
    const std::uint64_t skipped = from.get_short("point");
    const auto left = static_cast<std::uint64_t>(whole.points) - next;
    if (skipped >= left) from.refuse("point");
    number = static_cast<Index>(next + skipped);
    next += skipped + 1;
  }
  forest.edges = get_edges(from, forest.numbers.size(), whole.limit, "edge", context);
  forest.claims = get_edges(from, forest.numbers.size(), whole.limit, "claim", context);
  from.expect_end();
  DisjointSets sets(forest.numbers.size(), &context.memory);
  for (const FlagEdge& e : forest.edges) {
    const std::uint32_t u = sets.find(e.u), v = sets.find(e.v);
    if (u == v) from.refuse("forest");
    sets.link(u, v);
  }
  return CloudPart(std::move(state));
}

}  // namespace ph

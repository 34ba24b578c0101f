// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/matrices/matrix_entry.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

constexpr std::int64_t kMostPoints = std::int64_t{1} << 31;
// Every number up to the largest id is a point. The number of points may be at most
// kMostPointsPerPair times the number of pairs, or kFreePoints, whichever is more.
constexpr Index kMostPointsPerPair = 1024;
constexpr Index kFreePoints = Index{1} << 20;

}  // namespace

namespace detail {

std::vector<WeightedEdge> unique_edges(std::vector<LocatedEdge> pairs, const Input& input,
                                       const std::function<void(std::size_t, const Fault&)>& fail) {
  std::sort(pairs.begin(), pairs.end(), [](const LocatedEdge& a, const LocatedEdge& b) {
    return std::tie(a.edge.u, a.edge.v, a.place) < std::tie(b.edge.u, b.edge.v, b.place);
  });
  std::vector<WeightedEdge> edges;
  input.require_memory(pairs.size() * sizeof(WeightedEdge));
  edges.reserve(pairs.size());
  for (const auto& [edge, place] : pairs) {
    if (!edges.empty() && edges.back().u == edge.u && edges.back().v == edge.v) {
      if (edges.back().value != edge.value) {
        fail(place, {fmt::format("pair {} {} listed again with another distance", edge.u, edge.v),
                     fmt::format("{}", edge.value),
                     fmt::format("{}", edges.back().value),
                     {}});
      }
    } else {
      edges.push_back(edge);
    }
  }
  std::erase_if(edges, [](const WeightedEdge& edge) { return std::isinf(edge.value); });
  return edges;
}

}  // namespace detail

SparseDistances read_sparse(const Input& input, const ReadOptions& options) {
  if (detail::is_dipha(input)) return detail::read_dipha_sparse(input, options);
  TextLines lines(input);
  Cells cells(lines);
  detail::MatrixEntries entries(options);
  std::vector<detail::LocatedEdge> found;
  Index size = 0;
  std::size_t largest_line = 0;
  bool first = true;
  while (lines.next()) {
    cells.start();
    if (std::exchange(first, false) && !header_names(lines.line()).empty()) {
      detail::note(options, fmt::format("line {} is a header: skipped", lines.number()));
      continue;
    }
    detail::LocatedEdge line{{}, lines.number()};
    const auto missing = [&](const char* what) {
      if (!cells.more()) {
        lines.fail(lines.line().data() + lines.line().size(),
                   {fmt::format("{} missing", what), "the end of the line", "i j distance", {}});
      }
    };
    line.edge.u = cells.integer(0, kMostPoints - 1, "point");
    missing("second point");
    const char* second = cells.place();
    line.edge.v = cells.integer(0, kMostPoints - 1, "point");
    missing("distance");
    const char* third = cells.place();
    const double raw = cells.number(options.nan == NanPolicy::drop ? Allow::any : Allow::infinite);
    cells.expect_end("i j distance");
    if (line.edge.u == line.edge.v) {
      lines.fail(second, {"a point joined to itself",
                          fmt::format("{} {}", line.edge.u, line.edge.v),
                          "two different points",
                          {}});
    }
    const detail::EntryPlace place{1, 0, static_cast<std::size_t>(third - input.text().data())};
    line.edge.value =
        entries.distance(raw, place, [&](const Fault& fault) { lines.fail(third, fault); });
    if (line.edge.u > line.edge.v) std::swap(line.edge.u, line.edge.v);
    if (line.edge.v >= size) {
      size = line.edge.v + 1;
      largest_line = line.place;
    }
    if (found.size() == found.capacity()) {
      input.require_memory(2 * found.capacity() * sizeof(detail::LocatedEdge));
    }
    found.push_back(line);
  }
  entries.finish([&](const detail::EntryPlace& place, const Fault& fault) {
    detail::fail_in_text(input, place.byte, fault);
  });
  if (size == 0 && !options.allow_empty) {
    input.fail({"no points",
                {},
                "lines of i j distance",
                mark(Setting::allow_empty) + " accepts an empty set"});
  }
  const auto fail = [&](std::size_t line, const Fault& fault) { input.fail_at(line, 1, fault); };
  const Index most = std::max(kFreePoints, kMostPointsPerPair * static_cast<Index>(found.size()));
  if (size > most) {
    fail(largest_line, {"point far beyond the others", fmt::format("id {}", size - 1),
                        fmt::format("at most {} for {} pairs", most - 1, found.size()),
                        "ids count the points from 0"});
  }
  return SparseDistances(size, detail::unique_edges(std::move(found), input, fail));
}

SparseDistances read_sparse(const std::filesystem::path& path, const ReadOptions& options) {
  return read_sparse(Input::open(path, options.context, Input::Excess::refused,
                                 detail::start_check(Format::sparse)),
                     options);
}

}  // namespace ph

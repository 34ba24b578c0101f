// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "ph/io/read.hpp"
#include "readers.hpp"

namespace ph {
namespace {

constexpr std::int64_t kMostPoints = std::int64_t{1} << 31;

struct Line {
  WeightedEdge edge;
  std::size_t number;
};

// Throws on a pair listed with two distances; leaves each pair once, sorted.
std::vector<WeightedEdge> unique_edges(std::vector<Line> lines, const Input& input) {
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::tie(a.edge.u, a.edge.v, a.number) < std::tie(b.edge.u, b.edge.v, b.number);
  });
  std::vector<WeightedEdge> edges;
  input.require_memory(lines.size() * sizeof(WeightedEdge));
  edges.reserve(lines.size());
  for (const auto& [edge, number] : lines) {
    if (!edges.empty() && edges.back().u == edge.u && edges.back().v == edge.v) {
      if (edges.back().value != edge.value) {
        input.fail_at(number, 1,
                      {fmt::format("pair {} {} listed again with another distance", edge.u, edge.v),
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

}  // namespace

SparseDistances read_sparse(const Input& input, const ReadOptions& options) {
  TextLines lines(input);
  Cells cells(lines);
  std::vector<Line> found;
  Index size = 0;
  bool first = true;
  while (lines.next()) {
    cells.start();
    if (std::exchange(first, false) && !header_names(lines.line()).empty()) {
      detail::note(options, fmt::format("line {} is a header: skipped", lines.number()));
      continue;
    }
    Line line{{}, lines.number()};
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
    line.edge.value = cells.number(options.nan == NanPolicy::drop ? Allow::any : Allow::infinite);
    cells.expect_end("i j distance");
    if (line.edge.u == line.edge.v) {
      lines.fail(second, {"a point joined to itself",
                          fmt::format("{} {}", line.edge.u, line.edge.v),
                          "two different points",
                          {}});
    }
    if (line.edge.value < 0) {
      lines.fail(third, {"negative distance", fmt::format("{}", line.edge.value), "0 or more", {}});
    }
    if (std::isnan(line.edge.value)) line.edge.value = std::numeric_limits<double>::infinity();
    if (line.edge.u > line.edge.v) std::swap(line.edge.u, line.edge.v);
    size = std::max(size, line.edge.v + 1);
    if (found.size() == found.capacity()) {
      input.require_memory(2 * found.capacity() * sizeof(Line));
    }
    found.push_back(line);
  }
  if (size == 0 && !options.allow_empty) {
    input.fail({"no points", {}, "lines of i j distance", "--allow-empty accepts an empty set"});
  }
  return SparseDistances(size, unique_edges(std::move(found), input));
}

SparseDistances read_sparse(const std::filesystem::path& path, const ReadOptions& options) {
  return read_sparse(Input::open(path, options.context), options);
}

}  // namespace ph

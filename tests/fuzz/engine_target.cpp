// SPDX-License-Identifier: MIT
// Runs the conformance suite on filtrations that are built from the bytes.
#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/detail/rips/rips_filtration.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/representatives.hpp"

namespace ph::fuzz {
namespace {

/// Makes each choice from one byte. After the last byte, choices are made from a counter.
class ByteChoices {
 public:
  explicit ByteChoices(std::string_view bytes) : bytes_(bytes) {}
  int integer(int low, int high) { return low + next() % (high - low + 1); }
  double real() { return next() / 255.0; }

 private:
  int next() {
    const std::size_t at = at_++;
    return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : static_cast<int>(at % 256);
  }
  std::string_view bytes_;
  std::size_t at_ = 0;
};

template <class F>
int count_cells(const F& filtration, int top) {
  int count = 0;
  for (int dim = 0; dim <= std::min(top, filtration.top_dim()); ++dim)
    filtration.for_each_cell(dim, [&](const auto&) { ++count; });
  return count;
}

/// A part of the conformance suite: mostly the engines, and occasionally the slower parts.
struct Suite {
  enum class Part { engines, contract, representatives };
  int max_dim;
  std::int64_t field;
  Part part;

  template <class F>
  void operator()(const F& filtration) const {
    const int top = std::min(max_dim, std::max(0, filtration.top_dim()));
    switch (part) {
      case Part::engines:
        return test::check_engines(filtration, top, field);
      case Part::contract:
        return test::check_contract(filtration, top + 1, field);
      case Part::representatives:  // checked with one reduction per bar
        if (count_cells(filtration, top + 1) <= 50)
          return test::check_representatives(filtration, top, field);
        return test::check_engines(filtration, top, field);
    }
  }
};

using Choices = test::InputGenerator<ByteChoices>;

/// A monotone map from the numbers 0 to 3 to numbers or infinities. A monotone map keeps a
/// filtration valid.
class Stretch {
 public:
  explicit Stretch(Choices& choices)
      : low_(choices.integer(0, 3) == 0 ? 0 : -kInfinity),
        high_(choices.integer(0, 3) == 0 ? 2 : kInfinity) {}
  double operator()(double value) const {
    return value <= low_ ? -kInfinity : value >= high_ ? kInfinity : value;
  }

 private:
  double low_, high_;
};

void check_rips(Choices& choices, bool ties, const Suite& suite) {
  RipsOptions options;
  if (choices.coin()) options.threshold = ties ? choices.integer(0, 3) : choices.real();
  const auto rips = [&]() -> Rips {
    switch (choices.integer(0, 2)) {
      case 0:
        return Rips(choices.points(choices.integer(0, 7), choices.integer(1, 3), ties), options);
      case 1: {
        const Index n = choices.integer(0, 7);
        const double never = Stretch(choices)(kInfinity);
        std::vector<double> lower(static_cast<std::size_t>(n * (n - 1) / 2));
        for (double& d : lower) d = choices.integer(0, 7) == 0 ? never : choices.value(ties);
        return Rips(DistanceMatrix(n, lower), options);
      }
      default:
        return Rips(choices.sparse(choices.integer(0, 7), ties, choices.real()), options);
    }
  }();
  test::with_all_edges(rips, suite.max_dim, suite);
  if (suite.part == Suite::Part::engines) test::check_collapse(rips, suite.max_dim, suite.field);
}

void check_cubical(Choices& choices, bool ties, const Suite& suite) {
  const int dim = choices.integer(1, 3);
  std::vector<Index> extents;
  for (int k = 0; k < dim; ++k) extents.push_back(choices.integer(1, dim == 3 ? 2 : 4));
  suite(Cubical(choices.image(extents, ties), choices.cubical_options(dim)));
}

void check_simplices(Choices& choices, bool ties, const Suite& suite) {
  SimplexList list =
      choices.simplices(choices.integer(4, 7), choices.integer(0, 3), choices.integer(1, 8), ties);
  const Stretch stretch(choices);
  for (double& value : list.values) value = stretch(value);
  suite(ExplicitComplex::from_simplices(list));
}

void check_graph(Choices& choices, bool ties, Suite suite) {
  const Stretch stretch(choices);
  std::vector<double> births(static_cast<std::size_t>(choices.integer(1, 8)));
  for (double& birth : births) birth = stretch(choices.value(ties));
  std::vector<WeightedEdge> edges;
  std::set<std::pair<Index, Index>> seen;  // the suite cannot tell parallel edges apart
  for (int left = choices.integer(0, 14); left > 0; --left) {
    const Index u = choices.integer(0, static_cast<int>(births.size()) - 1);
    const Index v = choices.integer(0, static_cast<int>(births.size()) - 1);
    const double born =
        std::max(births[static_cast<std::size_t>(u)], births[static_cast<std::size_t>(v)]);
    const double value = std::max(born, stretch(choices.value(ties)));
    if (seen.insert(std::minmax(u, v)).second) edges.push_back({u, v, value});
  }
  suite.max_dim = std::min(suite.max_dim, 1);
  suite(FilteredGraph(births, edges));
  suite(FilteredGraph::lower_star(births, edges));
}

/// Checks a chain complex over Z/2 that is not a simplicial complex.
void check_boundary(Choices& choices, bool ties, Suite suite) {
  const Stretch stretch(choices);
  BoundaryMatrix m;
  const int vertices = choices.integer(0, 6), edges = choices.integer(0, 8);
  for (int i = 0; i < vertices + edges; ++i) {
    m.dims.push_back(i < vertices ? 0 : 1);
    for (int v = 0; i >= vertices && v < vertices; ++v)
      if (choices.integer(0, 2) == 0) m.rows.push_back(v);
    m.offsets.push_back(m.rows.size());
    m.values.push_back(i < vertices ? stretch(0) : stretch(choices.value(ties)));
  }
  suite.max_dim = std::min(suite.max_dim, 1);
  suite.field = 2;
  suite(ExplicitComplex::from_boundary(m));
}

}  // namespace

void run_engines(std::string_view bytes) {
  testing::FLAGS_gtest_throw_on_failure = true;  // a fuzz target runs outside any test
  Choices choices{ByteChoices(bytes)};
  const int kind = choices.integer(0, 6);
  const bool ties = choices.coin();
  constexpr std::array<std::int64_t, 3> kFields{2, 3, 5};
  const std::int64_t field = kFields[static_cast<std::size_t>(choices.integer(0, 2))];
  const int max_dim = choices.integer(0, 3), part = choices.integer(0, 15);
  const Suite suite{max_dim, field,
                    part == 0   ? Suite::Part::representatives
                    : part == 1 ? Suite::Part::contract
                                : Suite::Part::engines};
  switch (kind) {
    case 0:
      return check_cubical(choices, ties, suite);
    case 1:
      return check_simplices(choices, ties, suite);
    case 2:
      return check_graph(choices, ties, suite);
    case 3:
      return check_boundary(choices, ties, suite);
    default:
      return check_rips(choices, ties, suite);
  }
}

}  // namespace ph::fuzz

// SPDX-License-Identifier: MIT
// Loops of bars against an oracle of their own: boundaries and cocycles by elimination on dense
// rows, shortest walks by Dijkstra's algorithm through all pairs of a vertex and values of
// cocycles.
#include "ph/loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "support/expect_error.hpp"
#include "support/for_each_seed.hpp"

namespace ph::test {
namespace {

using Pair = std::array<Index, 2>;
using EdgeChain = std::map<std::pair<std::vector<Index>, std::vector<Index>>, std::int64_t>;
using Row = std::vector<std::int64_t>;

std::int64_t modulo(std::int64_t a, std::int64_t p) { return (a % p + p) % p; }
std::int64_t inverse(std::int64_t a, std::int64_t p) {
  for (std::int64_t b = 1; b < p; ++b)
    if (modulo(a * b, p) == 1) return b;
  return 0;
}

void add(EdgeChain& chain, const std::vector<Index>& tail, const std::vector<Index>& head,
         std::int64_t a, std::int64_t p) {
  auto& sum = chain[{tail, head}];
  sum = modulo(sum + a, p);
  if (sum == 0) chain.erase({tail, head});
}

/// The vertices of a loop.
std::vector<std::vector<Index>> vertices_of(const Loop& loop, std::size_t arity) {
  std::vector<std::vector<Index>> vertices;
  for (auto it = loop.numbers.begin(); it != loop.numbers.end();
       it += static_cast<std::ptrdiff_t>(arity))
    vertices.emplace_back(it, it + static_cast<std::ptrdiff_t>(arity));
  return vertices;
}

/// Loops of simplices as a chain of edges from the smaller to the larger vertex.
EdgeChain sum_of(const std::vector<Loop>& loops, std::int64_t p) {
  EdgeChain chain;
  for (const Loop& loop : loops) {
    const auto v = vertices_of(loop, 1);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto& next = v[(i + 1) % v.size()];
      if (v[i] < next)
        add(chain, v[i], next, loop.coefficient, p);
      else
        add(chain, next, v[i], -loop.coefficient, p);
    }
  }
  return chain;
}

EdgeChain edges_of(const InputChain& chain, std::int64_t p) {
  EdgeChain edges;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const auto numbers = chain.cell(i).numbers;
    add(edges, {numbers[0]}, {numbers[1]}, chain.coefficient(i), p);
  }
  return edges;
}

/// What closed_walks promises of the form of its walks.
void check_form(const std::vector<Loop>& loops, std::size_t arity, std::int64_t p) {
  std::set<std::vector<std::vector<Index>>> seen;
  std::size_t last = SIZE_MAX;
  for (const Loop& loop : loops) {
    const auto v = vertices_of(loop, arity);
    ASSERT_FALSE(v.empty());
    EXPECT_LE(v.size(), last);
    last = v.size();
    EXPECT_EQ(std::set(v.begin(), v.end()).size(), v.size()) << "a vertex comes twice";
    EXPECT_EQ(std::ranges::min(v), v.front());
    EXPECT_TRUE(loop.coefficient >= 1 && loop.coefficient <= p / 2) << loop.coefficient;
    if (p == 2 && v.size() > 2) {
      EXPECT_LT(v[1], v.back());
    }
  }
}

/// A flag complex, edge by edge, as the oracle has it.
struct FlagComplex {
  struct Edge {
    Pair ends;  // named, ascending
    double value;
  };
  std::vector<Edge> edges;  // in order
  std::int64_t p;

  FlagComplex(const RipsGraph& graph, std::int64_t field) : p(field) {
    for (std::uint32_t key = 1; key <= graph.edge_count(); ++key) {
      const FlagEdge& e = graph.edge(key);
      edges.push_back({{graph.name(e.v), graph.name(e.u)}, e.value});
    }
  }
  std::optional<std::size_t> place(Index a, Index b) const {
    const Pair ends{std::min(a, b), std::max(a, b)};
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (edges[i].ends == ends) return i;
    return std::nullopt;
  }
  /// Boundaries of the triangles of which `in` has all edges, as rows over all edges.
  template <class In>
  std::vector<Row> boundaries(In&& in) const {
    std::set<Index> vertices;
    for (const Edge& e : edges) vertices.insert(e.ends.begin(), e.ends.end());
    std::vector<Row> rows;
    for (const Index a : vertices)
      for (auto b = vertices.upper_bound(a); b != vertices.end(); ++b)
        for (auto c = std::next(b); c != vertices.end(); ++c) {
          const auto ab = place(a, *b), bc = place(*b, *c), ac = place(a, *c);
          if (!ab || !bc || !ac || !in(edges[*ab]) || !in(edges[*bc]) || !in(edges[*ac])) continue;
          Row row(edges.size(), 0);
          row[*ab] = row[*bc] = 1;
          row[*ac] = p - 1;
          rows.push_back(row);
        }
    return rows;
  }
  Row row_of(const EdgeChain& chain) const {
    Row row(edges.size(), 0);
    for (const auto& [ends, a] : chain) row[*place(ends.first[0], ends.second[0])] = a;
    return row;
  }
};

/// Reduces rows to echelon form. @return the pivot of each row that is left.
std::vector<std::size_t> eliminate(std::vector<Row>& rows, std::int64_t p) {
  std::vector<std::size_t> pivots;
  const std::size_t columns = rows.empty() ? 0 : rows.front().size();
  for (std::size_t c = 0; c < columns && pivots.size() < rows.size(); ++c) {
    const std::size_t top = pivots.size();
    std::size_t r = top;
    while (r < rows.size() && rows[r][c] == 0) ++r;
    if (r == rows.size()) continue;
    std::swap(rows[top], rows[r]);
    const std::int64_t scale = inverse(rows[top][c], p);
    for (auto& a : rows[top]) a = a * scale % p;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == top || rows[i][c] == 0) continue;
      const std::int64_t factor = rows[i][c];
      for (std::size_t k = 0; k < columns; ++k)
        rows[i][k] = modulo(rows[i][k] - factor * rows[top][k], p);
    }
    pivots.push_back(c);
  }
  rows.resize(pivots.size());
  return pivots;
}

bool is_in_span(std::vector<Row> rows, const Row& row, std::int64_t p) {
  const std::size_t rank = eliminate(rows, p).size();
  rows.push_back(row);
  return eliminate(rows, p).size() == rank;
}

/// All functions on the edges that `in` has that vanish on the boundaries of its triangles.
template <class In>
std::vector<Row> cocycles_of(const FlagComplex& complex, In&& in) {
  std::vector<Row> rows = complex.boundaries(in);
  const std::vector<std::size_t> pivots = eliminate(rows, complex.p);
  std::vector<Row> cocycles;
  for (std::size_t free = 0; free < complex.edges.size(); ++free) {
    if (!in(complex.edges[free]) || std::ranges::find(pivots, free) != pivots.end()) continue;
    Row cocycle(complex.edges.size(), 0);
    cocycle[free] = 1;
    for (std::size_t r = 0; r < rows.size(); ++r)
      cocycle[pivots[r]] = modulo(-rows[r][free], complex.p);
    cocycles.push_back(cocycle);
  }
  return cocycles;
}

/// The length of the shortest closed walk that passes edge `birth` once, goes on along edges that
/// `may_use` allows, and with the coefficient of that edge in `chain` is homologous to it where all
/// `cocycles` are; nothing if there is none, or if there are too many pairs to look at.
std::optional<double> shortest_walk(const FlagComplex& complex, const Row& chain, std::size_t birth,
                                    const std::vector<bool>& may_use,
                                    const std::vector<Row>& cocycles, bool& gave_up) {
  const std::int64_t p = complex.p;
  const auto value_on = [&](const Row& cocycle, const Row& of) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < of.size(); ++i) sum = modulo(sum + cocycle[i] * of[i], p);
    return sum;
  };
  std::vector<std::int64_t> target;
  for (const Row& cocycle : cocycles)
    target.push_back(
        modulo(value_on(cocycle, chain) * inverse(chain[birth], p) - cocycle[birth], p));
  const auto [low, high] = complex.edges[birth].ends;
  using State = std::pair<Index, std::vector<std::int64_t>>;
  std::map<State, double> best;
  std::set<std::pair<double, State>> queue;
  const auto reach = [&](const State& state, double length) {
    const auto [it, is_new] = best.try_emplace(state, length);
    if (!is_new && it->second <= length) return;
    if (!is_new) queue.erase({it->second, state});
    it->second = length;
    queue.insert({length, state});
  };
  reach({high, std::vector<std::int64_t>(cocycles.size(), 0)}, 0);
  while (!queue.empty()) {
    const auto [length, state] = *queue.begin();
    queue.erase(queue.begin());
    if (state == State{low, target}) return length + complex.edges[birth].value;
    if (best.size() > 20000) {
      gave_up = true;
      return std::nullopt;
    }
    for (std::size_t i = 0; i < complex.edges.size(); ++i) {
      const auto [a, b] = complex.edges[i].ends;
      if (!may_use[i] || (a != state.first && b != state.first)) continue;
      const bool ascends = a == state.first;
      State next{ascends ? b : a, state.second};
      for (std::size_t k = 0; k < cocycles.size(); ++k)
        next.second[k] = modulo(next.second[k] + (ascends ? 1 : -1) * cocycles[k][i], p);
      reach(next, length + complex.edges[i].value);
    }
  }
  return std::nullopt;
}

double total_of(const BarLoops& of_bar) {
  double sum = 0;
  for (const Loop& loop : of_bar.loops) sum += loop.length.value_or(kInfinity);
  return sum;
}

struct Counts {
  int bars = 0, shortest = 0, shorter = 0, locally = 0;
};

/// All that ph/loops.hpp promises of the loops of one filtration.
void check_loops(const Rips& rips, const Options& asked, Counts& counts) {
  Options options = asked;
  options.representatives = Representatives::cycles;
  const std::int64_t p = options.field;
  const Barcode bars = persistence(rips, options);
  const auto plain = loops(rips, bars, options, false);
  const auto tight = loops(rips, bars, options, true);
  ASSERT_EQ(plain.size(), bars.size());
  ASSERT_EQ(tight.size(), bars.size());
  const FlagComplex complex(rips.graph(), p);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    SCOPED_TRACE("bar " + std::to_string(i));
    if (bars[i].dim != 1) {
      EXPECT_TRUE(plain[i].loops.empty() && tight[i].loops.empty());
      continue;
    }
    const EdgeChain chain = edges_of(bars.representative(i), p);
    EXPECT_EQ(plain[i].tightness, Tightness::none);
    EXPECT_EQ(sum_of(plain[i].loops, p), chain);
    check_form(plain[i].loops, 1, p);
    if (p == 2) {
      std::size_t steps = 0;
      for (const Loop& loop : plain[i].loops) steps += loop.numbers.size();
      EXPECT_EQ(steps, chain.size()) << "an edge is in two walks";
    }

    const double birth = bars[i].birth, death = bars[i].death;
    if (!(birth < death)) {
      EXPECT_EQ(tight[i].loops, plain[i].loops);
      continue;
    }
    ++counts.bars;
    const auto birth_ends = bars.birth_cell(i).numbers;
    const std::size_t born = *complex.place(birth_ends[0], birth_ends[1]);
    for (const Loop& loop : tight[i].loops) {
      double length = 0;
      for (std::size_t k = 0; k < loop.numbers.size(); ++k) {
        const auto edge =
            complex.place(loop.numbers[k], loop.numbers[(k + 1) % loop.numbers.size()]);
        ASSERT_TRUE(edge) << "no edge";
        EXPECT_LE(complex.edges[*edge].value, birth);
        if (options.collapse == Collapse::off) {
          EXPECT_LE(*edge, born);
        }
        length += complex.edges[*edge].value;
      }
      EXPECT_NEAR(*loop.length, length, 1e-9);
    }
    check_form(tight[i].loops, 1, p);
    for (const Loop& loop : tight[i].loops) {
      // No vertex can be left out.
      const auto& v = loop.numbers;
      for (std::size_t k = 0; k < v.size() && v.size() > 3; ++k) {
        const auto first = complex.place(v[k], v[(k + 1) % v.size()]),
                   second = complex.place(v[(k + 1) % v.size()], v[(k + 2) % v.size()]),
                   both = complex.place(v[k], v[(k + 2) % v.size()]);
        if (first == born || second == born || !both || *both >= born) continue;
        EXPECT_GT(complex.edges[*both].value,
                  complex.edges[*first].value + complex.edges[*second].value - 1e-9);
      }
    }

    const Row given = complex.row_of(chain), found = complex.row_of(sum_of(tight[i].loops, p));
    EXPECT_EQ(found[born], given[born]);
    Row difference(given.size());
    for (std::size_t k = 0; k < given.size(); ++k) difference[k] = modulo(found[k] - given[k], p);
    const auto is_before = [&](const FlagComplex::Edge& e) { return e.value < death; };
    const auto is_there = [&](const FlagComplex::Edge& e) { return e.value <= death; };
    EXPECT_TRUE(is_in_span(complex.boundaries(is_before), difference, p)) << "not homologous";
    EXPECT_FALSE(is_in_span(complex.boundaries(is_before), found, p)) << "dies too early";
    if (!bars[i].is_infinite()) {
      EXPECT_TRUE(is_in_span(complex.boundaries(is_there), found, p)) << "does not die";
    }
    EXPECT_LE(total_of(tight[i]), total_of(plain[i]) + 1e-9);
    counts.shorter += total_of(tight[i]) < total_of(plain[i]) - 1e-9 ? 1 : 0;

    std::vector<bool> may_use;
    for (std::size_t k = 0; k < complex.edges.size(); ++k)
      may_use.push_back(options.collapse == Collapse::off
                            ? k < born
                            : k != born && complex.edges[k].value <= birth);
    bool gave_up = false;
    const auto least =
        shortest_walk(complex, given, born, may_use, cocycles_of(complex, is_before), gave_up);
    if (gave_up) continue;
    ASSERT_NE(tight[i].tightness, Tightness::none);
    EXPECT_EQ(tight[i].tightness == Tightness::shortest, least.has_value());
    if (!least) {
      ++counts.locally;
      continue;
    }
    ++counts.shortest;
    if (tight[i].loops.size() == 1)
      EXPECT_NEAR(total_of(tight[i]), *least, 1e-9);
    else
      EXPECT_LE(total_of(tight[i]), *least + 1e-9);
  }
}

constexpr std::int64_t kFields[] = {2, 3, 5};

Options options_of(Generator& random) {
  Options options;
  options.field = kFields[random.integer(0, 2)];
  options.max_dim = random.integer(1, 2);
  options.collapse = static_cast<Collapse>(random.integer(0, 2));
  options.min_persistence = random.integer(0, 3) == 0 ? 0.1 : 0;
  return options;
}

TEST(Loops, AreShortestInRandomDistances) {
  Counts counts;
  for_each_seed(1600, [&](Generator& random, bool ties, std::int64_t) {
    RipsOptions rips;
    if (random.coin()) rips.threshold = ties ? random.integer(1, 3) : random.real();
    const Rips complex(random.distances(random.integer(4, 10), ties), rips);
    check_loops(complex, options_of(random), counts);
  });
  // The inputs are worth something.
  EXPECT_TRUE(is_enough(counts.bars, 1500)) << counts.bars;
  EXPECT_TRUE(is_enough(counts.shortest, 1000)) << counts.shortest;
  EXPECT_TRUE(is_enough(counts.shorter, 50)) << counts.shorter;
}

TEST(Loops, AreShortestInRandomPoints) {
  Counts counts;
  for_each_seed(600, [&](Generator& random, bool ties, std::int64_t) {
    RipsOptions rips;
    rips.merge_equal_points = random.coin();
    if (random.integer(0, 2) == 0) rips.threshold = ties ? random.integer(1, 3) : random.real();
    const Rips complex(random.points(random.integer(5, 13), random.integer(2, 3), ties), rips);
    check_loops(complex, options_of(random), counts);
  });
  EXPECT_TRUE(is_enough(counts.bars, 200)) << counts.bars;
}

TEST(Loops, AreShortestInSparseDistances) {
  Counts counts;
  for_each_seed(600, [&](Generator& random, bool ties, std::int64_t) {
    const Rips complex(random.sparse(random.integer(5, 10), ties, 0.5));
    check_loops(complex, options_of(random), counts);
  });
  EXPECT_TRUE(is_enough(counts.bars, 300)) << counts.bars;
}

TEST(Loops, KeepTheNumbersOfPointsThatAreLeft) {
  Counts counts;
  for_each_seed(200, [&](Generator& random, bool ties, std::int64_t) {
    const DistanceMatrix distances = random.distances(12, ties);
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < 12; ++v)
      if (random.integer(0, 3) > 0) vertices.push_back(v);
    std::vector<double> births(12);
    for (double& b : births) b = random.value(ties);
    RipsOptions rips;
    rips.vertices = vertices;
    if (random.coin()) rips.births = births;
    const Rips complex(distances, rips);
    check_loops(complex, options_of(random), counts);
  });
  EXPECT_TRUE(is_enough(counts.bars, 100)) << counts.bars;
}

TEST(Loops, OfSparseRipsFiltrations) {
  Counts counts;
  for_each_seed(100, [&](Generator& random, bool, std::int64_t) {
    RipsOptions rips;
    rips.approximation = 0.5 + random.real();
    const Rips complex(random.points(random.integer(5, 13), 2, false), rips);
    check_loops(complex, options_of(random), counts);
  });
  EXPECT_TRUE(is_enough(counts.bars, 20)) << counts.bars;
}

// A bar that is only represented by a difference: two rings that a tube joins.
TEST(Loops, MayNeedTwoWalks) {
  Points points(16, 3);
  for (Index i = 0; i < 8; ++i) {
    const double angle = 0.78539816339744830962 * static_cast<double>(i);
    points.set_row(i, {std::cos(angle), std::sin(angle), 0});
    points.set_row(8 + i, {1.02 * std::cos(angle), 1.02 * std::sin(angle), 0.9});
  }
  const Rips rips(points);
  for (const std::int64_t field : kFields) {
    const Options options{.field = field, .representatives = Representatives::cycles};
    const Barcode bars = persistence(rips, options);
    const auto found = loops(rips, bars, options);
    Counts counts;
    check_loops(rips, options, counts);
    bool two = false;
    for (const BarLoops& of_bar : found) two |= of_bar.loops.size() == 2;
    EXPECT_TRUE(two);
    EXPECT_EQ(counts.locally, 1);
    EXPECT_EQ(found[bars.longest(1)].loops.size(), 1u);
  }
}

TEST(Loops, StayAsTheyAreWithoutMemory) {
  Generator random(1);
  const Rips rips(random.points(60, 2, false));
  const Options options{.representatives = Representatives::cycles};
  const Barcode bars = persistence(rips, options);
  for (std::size_t limit = 1; limit < (std::size_t{1} << 26); limit *= 2) {
    RunContext context;
    context.memory.set_limit(limit);
    try {
      const auto found = loops(rips, bars, options, true, context);
      for (std::size_t i = 0; i < bars.size(); ++i)
        EXPECT_EQ(found[i].loops.empty(), bars[i].dim != 1);
      EXPECT_LE(context.memory.peak(), limit);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::resource);
      EXPECT_LT(limit, std::size_t{1} << 16);
    }
    EXPECT_EQ(context.memory.used(), 0u);
  }
}

TEST(Loops, StopWhenAsked) {
  Generator random(1);
  const Rips rips(random.points(60, 2, false));
  const Options options{.representatives = Representatives::cycles};
  const Barcode bars = persistence(rips, options);
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  expect_error(ErrorKind::cancelled, {}, [&] { loops(rips, bars, options, true, context); });
}

TEST(Loops, NeedCycles) {
  Generator random(1);
  const Rips rips(random.points(9, 2, false));
  expect_error(ErrorKind::usage, "without cycles", [&] { loops(rips, persistence(rips)); });
  const Barcode cocycles = persistence(rips, {.representatives = Representatives::cocycles});
  expect_error(ErrorKind::usage, "without cycles", [&] { loops(rips, cocycles); });
  const Barcode cycles = persistence(rips, {.representatives = Representatives::cycles});
  const Rips other(Points(random.points(2, 2, false)));
  if (!cycles.bars(1).empty())
    expect_error(ErrorKind::usage, "another complex", [&] { loops(other, cycles); });
}

// --- closed_walks ---

InputChain chain_of(const std::vector<Index>& numbers, const std::vector<std::int64_t>& a,
                    CellKind kind = CellKind::vertices) {
  return InputChain(kind, numbers, a);
}

TEST(ClosedWalks, OfAnEight) {
  const std::vector<Index> edges{0, 1, 1, 2, 0, 2, 2, 3, 3, 4, 4, 5, 2, 5};
  const auto walks = closed_walks(chain_of(edges, std::vector<std::int64_t>(7, 1)), 2);
  ASSERT_EQ(walks.size(), 2u);
  EXPECT_EQ(walks[0], (Loop{{2, 3, 4, 5}, 1, {}}));
  EXPECT_EQ(walks[1], (Loop{{0, 1, 2}, 1, {}}));
}

TEST(ClosedWalks, WithCoefficients) {
  // Three ways from 0 to 9, each once: a cycle modulo 3.
  const std::vector<Index> edges{0, 1, 1, 9, 0, 2, 2, 9, 0, 3, 3, 9};
  const std::vector<std::int64_t> ones(6, 1);
  const InputChain chain = chain_of(edges, ones);
  const auto walks = closed_walks(chain, 3);
  EXPECT_EQ(sum_of(walks, 3), edges_of(chain, 3));
  EXPECT_EQ(walks.size(), 2u);
  // The other way round is the same walk with the opposite coefficient.
  const std::vector<Index> ring{0, 1, 1, 2, 0, 2};
  EXPECT_EQ(closed_walks(chain_of(ring, {2, 2, -2}), 7), (std::vector{Loop{{0, 1, 2}, 2, {}}}));
  EXPECT_EQ(closed_walks(chain_of(ring, {-2, -2, 2}), 7), (std::vector{Loop{{0, 2, 1}, 2, {}}}));
}

TEST(ClosedWalks, OfRandomCycles) {
  for_each_seed(1500, [](Generator& random, bool, std::int64_t p) {
    const int n = random.integer(3, 12);
    EdgeChain sum;
    for (int k = random.integer(1, 6); k > 0; --k) {
      std::vector<Index> walk;
      for (int i = random.integer(3, 9); i > 0; --i) {
        const Index v = random.integer(0, n - 1);
        if (walk.empty() || walk.back() != v) walk.push_back(v);
      }
      if (walk.front() == walk.back()) walk.pop_back();
      if (walk.size() < 2) continue;
      const EdgeChain one = sum_of({Loop{walk, random.integer(1, 10), {}}}, p);
      for (const auto& [ends, a] : one) add(sum, ends.first, ends.second, a, p);
    }
    std::vector<Index> numbers;
    std::vector<std::int64_t> coefficients;
    for (const auto& [ends, a] : sum) {
      numbers.insert(numbers.end(), {ends.first[0], ends.second[0]});
      coefficients.push_back(a);
    }
    const auto walks = closed_walks(chain_of(numbers, coefficients), p);
    EXPECT_EQ(sum_of(walks, p), sum);
    check_form(walks, 1, p);
    // Any order of the edges gives the same.
    std::vector<Index> reversed;
    for (std::size_t i = coefficients.size(); i-- > 0;)
      reversed.insert(reversed.end(), {numbers[2 * i], numbers[2 * i + 1]});
    std::ranges::reverse(coefficients);
    EXPECT_EQ(closed_walks(chain_of(reversed, coefficients), p), walks);
  });
}

TEST(ClosedWalks, RefuseWhatIsNoCycleOfEdges) {
  expect_error(ErrorKind::usage, "a boundary that is not zero", [] {
    closed_walks(chain_of({0, 1, 1, 2}, {1, 1}), 2);
  });
  expect_error(ErrorKind::usage, "a cycle over Z/5", [] {
    closed_walks(chain_of({0, 1, 1, 2, 0, 2}, {1, 1, 1}), 5);
  });
  expect_error(ErrorKind::usage, "3 vertices", [] { closed_walks(chain_of({0, 1, 2}, {1}), 2); });
  expect_error(ErrorKind::usage, "rows",
               [] { closed_walks(chain_of({0}, {1}, CellKind::row), 2); });
  expect_error(ErrorKind::usage, "another cube", [] {
    closed_walks(chain_of({1, 1}, {1}, CellKind::grid), 2);
  });
  expect_error(ErrorKind::usage, "a prime", [] { closed_walks(chain_of({}, {}), 4); });
  EXPECT_TRUE(closed_walks(chain_of({}, {}), 2).empty());
}

/// Loops of an image as a chain of edges, each by the doubled coordinates of its middle.
std::map<std::vector<Index>, std::int64_t> grid_sum(const std::vector<Loop>& loops,
                                                    const std::vector<Index>& periods,
                                                    std::int64_t p) {
  std::map<std::vector<Index>, std::int64_t> sum;
  for (const Loop& loop : loops) {
    const auto v = vertices_of(loop, periods.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto& next = v[(i + 1) % v.size()];
      std::vector<Index> edge = v[i];
      int steps = 0;
      std::int64_t sign = 0;
      for (std::size_t k = 0; k < edge.size(); ++k) {
        EXPECT_EQ(v[i][k] % 2, 0) << "no vertex";
        Index step = next[k] - v[i][k];
        if (periods[k] > 0 && std::abs(step) == periods[k] - 2) step = step > 0 ? -2 : 2;
        if (step == 0) continue;
        ++steps;
        EXPECT_EQ(std::abs(step), 2);
        sign = step / 2;
        edge[k] += step / 2;
        if (periods[k] > 0) edge[k] = modulo(edge[k], periods[k]);
      }
      EXPECT_EQ(steps, 1);
      auto& a = sum[edge];
      a = modulo(a + sign * loop.coefficient, p);
      if (a == 0) sum.erase(edge);
    }
  }
  return sum;
}

TEST(ClosedWalks, OfImages) {
  int count = 0;
  for_each_seed(400, [&](Generator& random, bool ties, std::int64_t p) {
    const int dim = random.integer(2, 3);
    std::vector<Index> extents;
    for (int k = 0; k < dim; ++k) extents.push_back(random.integer(3, dim == 2 ? 6 : 4));
    const CubicalOptions how = random.cubical_options(dim);
    const Cubical cubical(random.image(extents, ties), how);
    const Options options{.max_dim = 1, .field = p, .representatives = Representatives::cycles};
    const Barcode bars = persistence(cubical, options);
    const auto found = loops(cubical, bars, options);
    std::vector<Index> periods(extents.size(), 0);
    for (std::size_t k = 0; k < how.periodic.size(); ++k)
      if (how.periodic[k]) periods[k] = 2 * extents[k];
    for (std::size_t i = 0; i < bars.size(); ++i) {
      EXPECT_EQ(found[i].tightness, Tightness::none);
      if (bars[i].dim != 1) {
        EXPECT_TRUE(found[i].loops.empty());
        continue;
      }
      ++count;
      const InputChain chain = bars.representative(i);
      std::map<std::vector<Index>, std::int64_t> want;
      for (std::size_t k = 0; k < chain.size(); ++k) {
        const auto numbers = chain.cell(k).numbers;
        want[{numbers.begin(), numbers.end()}] = modulo(chain.coefficient(k), p);
      }
      EXPECT_EQ(grid_sum(found[i].loops, periods, p), want);
      check_form(found[i].loops, extents.size(), p);
    }
  });
  EXPECT_TRUE(is_enough(count, 1000)) << count;
}

// Vertices do not tell which edge is meant, but all steps are there.
TEST(ClosedWalks, OfShortPeriodicAxes) {
  for (const Index n : {1, 2}) {
    const Image image{{n, 3}, Voxels(std::vector<double>(static_cast<std::size_t>(3 * n), 1.0))};
    const Cubical cubical(image, {.periodic = {true, false}});
    const Options options{.representatives = Representatives::cycles};
    const Barcode bars = persistence(cubical, options);
    ASSERT_FALSE(bars.bars(1).empty());
    const auto found = loops(cubical, bars, options);
    const std::size_t i = bars.longest(1);
    std::size_t steps = 0;
    for (const Loop& loop : found[i].loops) steps += loop.numbers.size() / 2;
    EXPECT_EQ(steps, bars.representative(i).size());
  }
}

TEST(ClosedWalks, OfSimplicialComplexes) {
  int count = 0;
  for_each_seed(400, [&](Generator& random, bool ties, std::int64_t p) {
    const auto list = random.simplices(random.integer(4, 7), 2, random.integer(1, 9), ties);
    const auto complex = ExplicitComplex::from_simplices(list);
    const Options options{.max_dim = 1, .field = p, .representatives = Representatives::cycles};
    const Barcode bars = persistence(complex, options);
    const auto found = loops(complex, bars, options);
    for (std::size_t i = 0; i < bars.size(); ++i) {
      if (bars[i].dim != 1) continue;
      ++count;
      EXPECT_EQ(sum_of(found[i].loops, p), edges_of(bars.representative(i), p));
    }
  });
  EXPECT_TRUE(is_enough(count, 50)) << count;
}

// Rows of a boundary matrix have no vertices to walk along.
TEST(ClosedWalks, OfABoundaryMatrixThereAreNone) {
  BoundaryMatrix matrix;
  for (const int dim : {0, 0, 0, 1, 1, 1}) matrix.dims.push_back(dim);
  matrix.rows = {0, 1, 1, 2, 0, 2};
  matrix.offsets = {0, 0, 0, 0, 2, 4, 6};
  const auto complex = ExplicitComplex::from_boundary(matrix);
  const Options options{.representatives = Representatives::cycles};
  const Barcode bars = persistence(complex, options);
  const auto found = loops(complex, bars, options);
  ASSERT_EQ(bars.bars(1).size(), 1u);
  EXPECT_TRUE(found[bars.longest(1)].loops.empty());
}

}  // namespace
}  // namespace ph::test

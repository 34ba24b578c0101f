// SPDX-License-Identifier: MIT
// Compares H0 of many points with the minimum work of any method: building a k-d tree and finding
// the nearest neighbour of each point. Prints CPU seconds of all threads, the least of three runs.
//
//     bench_components [POINTS [DIM [THREADS]]]
#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdlib>
#include <numeric>
#include <random>

#include "metric/kd_tree.hpp"
#include "metric/neighbour_search.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/ph.hpp"

namespace {

enum class Shape { cube, clusters, far_halves, line, grid };
constexpr std::pair<const char*, Shape> kShapes[] = {{"cube", Shape::cube},
                                                     {"clusters", Shape::clusters},
                                                     {"far halves", Shape::far_halves},
                                                     {"line", Shape::line},
                                                     {"grid", Shape::grid}};

// Clusters: a hundred, each with sixteen widths. The grid has copies and ties.
ph::Points make_points(Shape shape, ph::Index n, ph::Index d) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  ph::Points points(n, d), centres(100, d);
  for (double& x : centres.coordinates()) x = uniform(random);
  const double side = std::round(std::pow(static_cast<double>(n), 1.0 / static_cast<double>(d)));
  for (ph::Index i = 0; i < n; ++i) {
    const double width = std::ldexp(0.02, -static_cast<int>(random() % 16));
    for (ph::Index k = 0; k < d; ++k) {
      double& x = points(i, k);
      x = uniform(random);
      if (shape == Shape::clusters) x = centres(i % 100, k) + width * normal(random);
      if (shape == Shape::far_halves) x += static_cast<double>(10 * (i % 2));
      if (shape == Shape::line && k > 0) x = points(i, 0);
      if (shape == Shape::grid) x = std::floor(side * x);
    }
  }
  return points;
}

template <class Act>
double seconds_of(Act&& act) {
  const auto now = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  };
  double best = ph::kInfinity;
  for (int run = 0; run < 3; ++run) {
    const double start = now();
    act();
    best = std::min(best, now() - start);
  }
  return best;
}

void run(const char* name, Shape shape, ph::Index n, ph::Index d, const ph::RunContext& context) {
  const ph::Points points = make_points(shape, n, d);
  std::vector<std::uint32_t> rows(static_cast<std::size_t>(n));
  std::iota(rows.begin(), rows.end(), 0U);
  std::optional<ph::KdTree> tree;
  const double build = seconds_of([&] { tree.emplace(points, rows, context); });
  const ph::PointMetric metric(tree->points());
  const auto search = ph::NeighbourSearch::make(*tree, metric, ph::PointDistance::euclidean, 2);
  const double nearest = seconds_of([&] {
    const std::size_t leaves = tree->first_leaf();
    ph::for_each_piece("nearest", leaves, 512, context, [&](std::size_t begin, std::size_t end) {
      std::array<ph::NeighbourSearch::Neighbour, ph::KdTree::kLeafSize> found;
      for (std::size_t leaf = begin; leaf < end; ++leaf)
        search->nearest(static_cast<ph::KdTree::Node>(leaves + leaf), 1, ph::kInfinity,
                        ph::NeighbourSearch::Ties::by_row, found);
    });
  });
  std::optional<ph::Rips> rips;
  const double forest = seconds_of([&] {
    rips.emplace(ph::Rips::borrowed(points, {}, context));
    rips->graph(ph::RipsForm::forest, context);
  });
  std::size_t bars = 0;
  const double pairs =
      seconds_of([&] { bars = ph::persistence(*rips, {.max_dim = 0}, context).size(); });
  const double ratio = (forest + pairs) / (build + nearest);
  fmt::print("{:10} {:9} {:4} {:8.2f} {:8.2f} {:8.2f} {:8.2f} {:7.1f} {:9}\n", name, n, d, build,
             nearest, forest, pairs, ratio, bars);
}

}  // namespace

int main(int argc, char** argv) {
  const ph::Index n = argc > 1 ? std::atol(argv[1]) : 1000000;
  const ph::Index d = argc > 2 ? std::atol(argv[2]) : 3;
  ph::RunContext context;
  context.threads = argc > 3 ? std::atoi(argv[3]) : 0;
  fmt::print("{:10} {:>9} {:>4} {:>8} {:>8} {:>8} {:>8} {:>7} {:>9}\n", "points", "n", "dim",
             "tree s", "nearest", "forest", "pairs", "ratio", "bars");
  for (const auto& [name, shape] : kShapes) run(name, shape, n, d, context);
}

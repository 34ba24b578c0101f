// SPDX-License-Identifier: MIT
// Runs every engine on small standard inputs. Use it for profiling, and to compare times before and
// after a change.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "ph/custom.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/ph.hpp"

namespace {

ph::Points random_points(ph::Index n, ph::Index d) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  ph::Points points(n, d);
  for (double& x : points.coordinates()) x = uniform(random);
  return points;
}

ph::Image random_volume(ph::Index n) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> values(static_cast<std::size_t>(n * n * n));
  for (double& v : values) v = uniform(random);
  return {{n, n, n}, std::move(values)};
}

template <class Complex>
void run(benchmark::State& state, const Complex& complex, ph::Options options) {
  std::size_t bars = 0;
  for (auto _ : state) bars = ph::persistence(complex, options).size();
  state.counters["bars"] = static_cast<double>(bars);
}

/// Adds one benchmark. Its dimension is max_dim or, if the engine does not support max_dim, the
/// highest dimension below it that the engine supports. If there is no such dimension, adds
/// nothing.
template <class Complex>
void add(const std::string& input, const Complex& complex, const ph::EngineFacts& engine,
         int max_dim) {
  for (; max_dim >= 0; --max_dim) try {
      const ph::Options options{.max_dim = max_dim, .engine = engine.id};
      const ph::AnyComplex any(complex);
      ph::build(any, ph::plan(any, options));
      benchmark::RegisterBenchmark((input + std::string(engine.id.name())).c_str(),
                                   [=](auto& state) { run(state, complex, options); })
          ->Unit(benchmark::kMillisecond);
      return;
    } catch (const ph::Error&) {
      // The engine does not support this complex, or does not support this dimension of it.
    }
}

}  // namespace

int main(int argc, char** argv) {
  const ph::Rips small(random_points(60, 3)), large(random_points(1000, 3));
  const ph::Cubical grid(random_volume(12)), volume(random_volume(64));
  for (const ph::EngineFacts& engine : ph::detail::engine_facts()) {
    add("rips_60/", small, engine, 1);
    add("cubical_12/", grid, engine, 1);
    if (engine.is_oracle) continue;
    // Leaves out engines that list the cells of dimension 2, because they would list every
    // triangle.
    if (engine.listed_dim(1) < 2) add("rips_1000/", large, engine, 1);
    add("cubical_64/", volume, engine, 3);
  }
  benchmark::RegisterBenchmark("rips_graph_1000", [points = random_points(1000, 3)](auto& state) {
    for (auto _ : state)
      benchmark::DoNotOptimize(ph::Rips(points).graph(ph::RipsForm::edges).edge_count());
  })->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

// SPDX-License-Identifier: MIT
// Every registered engine on small standard inputs: for profiles and for before/after.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "facade/all_engines.hpp"
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

}  // namespace

int main(int argc, char** argv) {
  const ph::Rips small(random_points(60, 3)), large(random_points(1000, 3));
  const ph::Cubical grid(random_volume(12)), volume(random_volume(64));
  ph::for_each_engine([&](auto engine) {
    const std::string name = engine.name;
    const bool components_only = engine.id == ph::Engine::union_find;
    const bool is_oracle = engine.id == ph::Engine::standard;
    const bool images_only = engine.id == ph::Engine::arrows;
    const ph::Options options{.max_dim = components_only ? 0 : 1, .engine = engine.id};
    if (!images_only)
      benchmark::RegisterBenchmark(("rips_60/" + name).c_str(),
                                   [=](auto& state) { run(state, small, options); });
    benchmark::RegisterBenchmark(("cubical_12/" + name).c_str(),
                                 [=, &grid](auto& state) { run(state, grid, options); });
    if (is_oracle) return;
    if (engine.id != ph::Engine::twist && !images_only) {  // twist would list every triangle
      benchmark::RegisterBenchmark(("rips_1000/" + name).c_str(), [=](auto& state) {
        run(state, large, options);
      })->Unit(benchmark::kMillisecond);
    }
    benchmark::RegisterBenchmark(("cubical_64/" + name).c_str(), [=, &volume](auto& state) {
      run(state, volume, {.max_dim = components_only ? 0 : 3, .engine = engine.id});
    })->Unit(benchmark::kMillisecond);
  });
  benchmark::RegisterBenchmark("rips_graph_1000", [points = random_points(1000, 3)](auto& state) {
    for (auto _ : state) benchmark::DoNotOptimize(ph::Rips(points).edge_count());
  })->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

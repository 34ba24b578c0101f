// SPDX-License-Identifier: MIT
// Measures vectors of 10,000 bars, and Euler curves of images of N³ voxels with noise or with
// smooth waves. Prints CPU milliseconds for each vector, and for each curve the CPU seconds of one
// thread, the nanoseconds per voxel and the peak of memory in MiB. Each time is the shortest of
// three runs.
//
// bench_vectors [N]     (default 512; 0: no Euler curves)
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "ph/cubical.hpp"
#include "ph/euler_curve.hpp"
#include "ph/vectorise.hpp"

namespace {

constexpr int kRuns = 3;

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
  for (int run = 0; run < kRuns; ++run) {
    const double start = now();
    act();
    best = std::min(best, now() - start);
  }
  return best;
}

void vectors_of_bars() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<ph::Bar> bars(10'000);
  for (ph::Bar& bar : bars) {
    const auto [low, high] = std::minmax({uniform(random), uniform(random)});
    bar = {1, low, high};
  }
  const ph::Grid grid{0, 1, 1000};
  std::vector<double> curve(1000), layers(5 * 1000), image(100 * 100), numbers(ph::kStatistics);
  const ph::ImageFrame frame{{0, 1, 100}, {0, 1, 100}};
  const auto row = [](const char* name, double seconds) {
    fmt::print("{:<40} {:9.4f} ms\n", name, 1000 * seconds);
  };
  row("statistics", seconds_of([&] { ph::statistics(bars, numbers); }));
  row("Betti curve, 1000 points", seconds_of([&] { ph::betti_curve(bars, grid, curve); }));
  row("silhouette, 1000 points", seconds_of([&] { ph::silhouette(bars, grid, 1, curve); }));
  row("landscape, 5 x 1000", seconds_of([&] { ph::landscape(bars, grid, 5, layers); }));
  row("exact landscape, 5 layers", seconds_of([&] { ph::exact_landscape(bars, 5); }));
  for (const double sigma : {0.05, 0.01})
    row(fmt::format("image, 100 x 100, sigma {}", sigma).c_str(),
        seconds_of([&] { ph::persistence_image(bars, frame, sigma, 1, image); }));
}

template <class T>
std::vector<T> voxels_of(ph::Index n, bool is_noise, double scale) {
  std::mt19937_64 random(1);
  std::vector<T> voxels;
  voxels.reserve(static_cast<std::size_t>(n * n * n));
  const auto wave = [](ph::Index x, double k) { return std::sin(static_cast<double>(x) * k); };
  for (ph::Index z = 0; z < n; ++z)
    for (ph::Index y = 0; y < n; ++y) {
      const double of_row = wave(y, 0.07) + wave(z, 0.06);
      for (ph::Index x = 0; x < n; ++x) {
        const double v = is_noise ? static_cast<double>(random() >> 40) * 0x1p-24
                                  : 0.5 + (wave(x, 0.05) + of_row) / 6.5;
        voxels.push_back(static_cast<T>(scale * v));
      }
    }
  return voxels;
}

template <class T>
void curves_of(const char* type, ph::Index n, bool is_noise, double scale) {
  const ph::Image image{{n, n, n}, voxels_of<T>(n, is_noise, scale)};
  using Construction = ph::CubicalOptions::Construction;
  const ph::Grid grid{0, scale, 256};
  std::vector<double> out(grid.points);
  for (const auto construction : {Construction::vertices, Construction::cells}) {
    const ph::Cubical cubical(image, {.construction = construction});
    const auto row = [&](const char* what, double seconds, std::size_t bytes) {
      fmt::print("{:<8} {:<7} {}  {:<5} {:7.2f} s {:7.2f} ns a voxel {:6.0f} MiB\n", type,
                 is_noise ? "noise" : "smooth", construction == Construction::vertices ? 'V' : 'T',
                 what, seconds, 1e9 * seconds / static_cast<double>(n * n * n),
                 static_cast<double>(bytes) / (1 << 20));
    };
    ph::RunContext context, on_grid;
    context.threads = on_grid.threads = 1;
    const double exact = seconds_of([&] { ph::euler_curve(cubical, context); });
    row("exact", exact, context.memory.peak());
    const double sampled = seconds_of([&] { ph::euler_curve(cubical, grid, out, on_grid); });
    row("grid", sampled, on_grid.memory.peak());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const ph::Index n = argc > 1 ? std::atoi(argv[1]) : 512;
  vectors_of_bars();
  if (n < 2) return 0;
  fmt::print("\nEuler curve of {}³ voxels\n", n);
  for (const bool is_noise : {true, false}) {
    curves_of<std::uint8_t>("uint8", n, is_noise, 255);
    curves_of<std::uint16_t>("uint16", n, is_noise, 65535);
    curves_of<float>("float32", n, is_noise, 1);
  }
}

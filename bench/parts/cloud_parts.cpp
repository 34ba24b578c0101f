// SPDX-License-Identifier: MIT
// Computes H0 of points in parts, one after another, and H0 of all points at once. Prints the CPU
// seconds of both, the largest memory of a part without the points, the bytes of all parts, and
// whether the bars are the same. Uses one thread.
//
// bench_cloud_parts [POINTS [PARTS…]]
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "ph/parts/cloud_part.hpp"
#include "ph/persistence.hpp"

namespace {

// Uniform points in a cube, or points in clusters of many widths.
ph::Points make_points(ph::Index n, bool clusters) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  ph::Points points(n, 3), centres(100, 3);
  for (double& x : centres.coordinates()) x = uniform(random);
  for (ph::Index i = 0; i < n; ++i) {
    const double width = std::ldexp(0.02, -static_cast<int>(random() % 16));
    for (ph::Index k = 0; k < 3; ++k)
      points(i, k) = clusters ? centres(i % 100, k) + width * normal(random) : uniform(random);
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
  const double start = now();
  act();
  return now() - start;
}

double megabytes(std::size_t bytes) { return static_cast<double>(bytes) / 1e6; }

}  // namespace

int main(int argc, char** argv) {
  const ph::Index n = argc > 1 ? std::atol(argv[1]) : 1000000;
  std::vector<int> counts;
  for (int i = 2; i < argc; ++i) counts.push_back(std::atoi(argv[i]));
  if (counts.empty()) counts = {4, 8};
  fmt::print("{:9} {:>9} {:>5} {:>8} {:>8} {:>6} {:>9} {:>9}\n", "points", "n", "parts", "cpu s",
             "join s", "ratio", "memory MB", "bytes MB");
  for (const bool clusters : {false, true}) {
    const char* const name = clusters ? "clusters" : "cube";
    const ph::Points points = make_points(n, clusters);
    ph::Barcode expected;
    ph::RunContext of_one;
    of_one.threads = 1;
    const double one = seconds_of([&] {
      const ph::Rips rips = ph::Rips::borrowed(points, {}, of_one);
      expected = ph::persistence(rips, {.max_dim = 0, .cells = false}, of_one);
    });
    fmt::print("{:9} {:9} {:5} {:8.2f} {:8} {:6} {:9.0f}\n", name, n, 1, one, "", "",
               megabytes(of_one.memory.peak()));
    for (const int count : counts) {
      std::vector<std::vector<std::byte>> files;
      std::size_t memory = 0, bytes = 0;
      const double parts = seconds_of([&] {
        for (int i = 0; i < count; ++i) {
          ph::RunContext of_part;
          of_part.threads = 1;
          files.push_back(ph::CloudPart(points, i, count, {}, of_part).bytes());
          memory = std::max(memory, of_part.memory.peak());
          bytes += files.back().size();
        }
      });
      bool is_equal = false;
      const double join = seconds_of([&] {
        ph::CloudPart whole = ph::CloudPart::of_bytes(files[0]);
        for (std::size_t i = 1; i < files.size(); ++i)
          whole.join(ph::CloudPart::of_bytes(files[i]));
        is_equal = std::ranges::equal(whole.barcode(), expected);
      });
      fmt::print("{:9} {:9} {:5} {:8.2f} {:8.2f} {:6.2f} {:9.0f} {:9.1f}{}\n", name, n, count,
                 parts, join, (parts + join) / one, megabytes(memory), megabytes(bytes),
                 is_equal ? "" : " OTHER BARS");
    }
  }
}

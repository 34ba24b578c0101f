// SPDX-License-Identifier: MIT
// Does the least work of any algorithm for H0 and H1 of a distance matrix: reads the input, finds
// the enclosing radius, and sorts the edges up to this radius by (value, u, v). compare_rips.py
// uses the time as a lower bound.
//
// The program shares no code with libph and must not be tuned together with libph. A reference that
// changes with libph would hide changes of libph. The sort is a radix sort that begins with the
// lowest digit and has 11 bits per digit. Only the 32 bits of the value are sorted, because the
// sort is stable and edges are created in the order of (u, v).
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <sys/resource.h>

namespace {

struct Edge {
  float value;
  std::uint32_t u, v;
};

std::string contents(const char* path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::string text(file ? static_cast<std::size_t>(file.tellg()) : 0, '\0');
  file.seekg(0);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

/// The distances of n points: the strict lower triangle of the matrix, row by row.
struct Triangle {
  std::size_t n = 0;
  std::vector<float> values;
};

/// Reads distances stored as float32 in little-endian order, which is the order of the machines on
/// which this program is measured.
Triangle read_triangle(const std::string& bytes) {
  Triangle t;
  t.values.resize(bytes.size() / sizeof(float));
  std::memcpy(t.values.data(), bytes.data(), t.values.size() * sizeof(float));
  while (t.n * (t.n + 1) / 2 <= t.values.size()) ++t.n;
  return t;
}

/// The distances between the points in a text. Each line is a point, and coordinates are separated
/// by blanks or commas.
Triangle read_points(std::string_view text) {
  std::vector<double> coordinates;
  Triangle t;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t before = coordinates.size();
    const char* const end = line.data() + line.size();
    for (const char* at = line.data(); at < end;) {
      double x = 0;
      const auto [next, error] = std::from_chars(at, end, x);
      if (error == std::errc()) coordinates.push_back(x);
      at = error == std::errc() ? next : at + 1;
    }
    t.n += coordinates.size() > before;
  }
  if (t.n == 0) return t;
  const std::size_t dim = coordinates.size() / t.n;
  t.values.reserve(t.n * (t.n - 1) / 2);
  for (std::size_t i = 0; i < t.n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < dim; ++k) {
        const double d = coordinates[i * dim + k] - coordinates[j * dim + k];
        sum += d * d;
      }
      t.values.push_back(static_cast<float>(std::sqrt(sum)));
    }
  }
  return t;
}

/// The enclosing radius: min over i of max over j of d(i, j).
float enclosing_radius(const Triangle& t) {
  std::vector<float> farthest(t.n, 0);
  const float* d = t.values.data();
  for (std::size_t i = 0; i < t.n; ++i) {
    for (std::size_t j = 0; j < i; ++j, ++d) {
      farthest[i] = std::max(farthest[i], *d);
      farthest[j] = std::max(farthest[j], *d);
    }
  }
  return *std::min_element(farthest.begin(), farthest.end());
}

std::vector<Edge> edges_up_to(const Triangle& t, float radius) {
  std::vector<Edge> edges;
  edges.reserve(static_cast<std::size_t>(std::count_if(
      t.values.begin(), t.values.end(), [radius](float value) { return value <= radius; })));
  const float* d = t.values.data();
  for (std::uint32_t i = 0; i < t.n; ++i)
    for (std::uint32_t j = 0; j < i; ++j, ++d)
      if (*d <= radius) edges.push_back({*d, i, j});
  return edges;
}

/// Sorts edges by length. Non-negative floats have the same order as their bits.
void sort_edges(std::vector<Edge>& edges) {
  constexpr int kBits = 11, kPasses = 3;
  constexpr std::size_t kBins = std::size_t{1} << kBits;
  std::array<std::array<std::size_t, kBins>, kPasses> starts{};
  const auto digit = [](float value, int pass) {
    return (std::bit_cast<std::uint32_t>(value) >> (pass * kBits)) & (kBins - 1);
  };
  for (const Edge& e : edges)
    for (int pass = 0; pass < kPasses; ++pass) ++starts[pass][digit(e.value, pass)];
  std::vector<Edge> other(edges.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    std::size_t before = 0;
    for (std::size_t& start : starts[pass]) before += std::exchange(start, before);
    for (const Edge& e : edges) other[starts[pass][digit(e.value, pass)]++] = e;
    edges.swap(other);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s points|binary FILE\n", argv[0]);
    return 64;
  }
  const std::string text = contents(argv[2]);
  const Triangle t =
      argv[1] == std::string_view("binary") ? read_triangle(text) : read_points(text);
  if (t.n == 0) {
    std::fprintf(stderr, "%s: no points\n", argv[2]);
    return 65;
  }
  std::vector<Edge> edges = edges_up_to(t, enclosing_radius(t));
  sort_edges(edges);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const bool sorted = std::is_sorted(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.value, a.u, a.v) < std::tie(b.value, b.u, b.v);
  });
  std::printf("%zu points, %zu edges, %s, user %.3f s\n", t.n, edges.size(),
              sorted ? "sorted" : "NOT SORTED",
              static_cast<double>(usage.ru_utime.tv_sec) +
                  static_cast<double>(usage.ru_utime.tv_usec) * 1e-6);
  return sorted ? 0 : 70;
}

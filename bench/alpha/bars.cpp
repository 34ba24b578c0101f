// SPDX-License-Identifier: MIT
// bench_alpha delaunay|bars FILE [THREADS]: computes CGAL's triangulation of points, or all bars of
// their alpha complex. Prints the CPU seconds without the time for reading, and the number of cells
// or bars.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <string_view>
#include <vector>

#include "ph/io/read.hpp"
#include "ph/persistence.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::size_t cells_of(const ph::Points& points, double& start) {
  if (points.cols() == 2) {
    std::vector<Kernel::Point_2> all;
    for (ph::Index i = 0; i < points.rows(); ++i) all.emplace_back(points(i, 0), points(i, 1));
    start = seconds();
    const CGAL::Delaunay_triangulation_2<Kernel> triangulation(all.begin(), all.end());
    return triangulation.number_of_faces();
  }
  std::vector<Kernel::Point_3> all;
  for (ph::Index i = 0; i < points.rows(); ++i)
    all.emplace_back(points(i, 0), points(i, 1), points(i, 2));
  start = seconds();
  const CGAL::Delaunay_triangulation_3<Kernel> triangulation(all.begin(), all.end());
  return triangulation.number_of_finite_cells();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 64;
  const ph::Points points = ph::read_points(argv[2]);
  ph::RunContext context;
  context.threads = argc > 3 ? std::atoi(argv[3]) : 1;
  double start = seconds();
  std::size_t count = 0;
  if (std::string_view(argv[1]) == "delaunay") {
    count = cells_of(points, start);
  } else {
    const ph::Alpha alpha(points, {}, context);
    count = ph::persistence(alpha, {.cells = false}, context).size();
  }
  fmt::print("{} {}\n", seconds() - start, count);
}

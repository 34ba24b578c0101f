// SPDX-License-Identifier: MIT
// Computes a Rips barcode as a user of the library does, with the call that the README shows.
// Prints the number of bars in each dimension and the sum of their finite lengths. front_door.py
// compares the cost of this call with the cost of ph-barcode.
//
// Unlike the README's call, this call passes a context, because both programs must use one thread.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "ph/io/read.hpp"
#include "ph/ph.hpp"

namespace {

template <class Data>
ph::Barcode bars_of(Data data, bool moves, int max_dim, const ph::RunContext& context) {
  const ph::Options options{.max_dim = max_dim};
  return moves ? ph::persistence(ph::Rips(std::move(data), {}, context), options, context)
               : ph::persistence(ph::Rips(data, {}, context), options, context);
}

void print_summary(const ph::Barcode& bars, int max_dim) {
  for (int dim = 0; dim <= max_dim; ++dim) {
    std::size_t count = 0;
    double lengths = 0;
    for (const ph::Bar& bar : bars.bars(dim)) {
      ++count;
      if (std::isfinite(bar.death)) lengths += bar.death - bar.birth;
    }
    std::printf("%d %zu %.17g\n", dim, count, lengths);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: %s points|distances copied|moved MAX_DIM FILE\n", argv[0]);
    return 64;
  }
  try {
    const bool moves = argv[2] == std::string_view("moved");
    const int max_dim = std::atoi(argv[3]);
    ph::RunContext context;
    context.threads = 1;
    print_summary(argv[1] == std::string_view("points")
                      ? bars_of(ph::read_points(argv[4]), moves, max_dim, context)
                      : bars_of(ph::read_distances(argv[4]), moves, max_dim, context),
                  max_dim);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
}

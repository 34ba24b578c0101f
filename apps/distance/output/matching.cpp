// SPDX-License-Identifier: MIT
#include "apps/distance/output/matching.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "apps/distance/output/table.hpp"
#include "ph/detail/diagram/ground_cost.hpp"
#include "ph/detail/io/json_writer.hpp"
#include "ph/io/write.hpp"

namespace ph::distance_program {
namespace {

/// Two bars, one from each barcode, or a bar and a point of the diagonal.
struct Pair {
  // The index among the bars of the dimension; -1 means the diagonal.
  std::array<std::int64_t, 2> places;
  std::array<std::array<double, 2>, 2> ends;
  double cost;
};

/// The difference of two numbers, or 0 if both numbers are infinite.
double difference(double x, double y) { return x == y ? 0 : x - y; }  // mutant: matching-infinite

Pair pair_of(const DimMatching& m, std::size_t k, double ground) {
  const diagram::GroundCost cost(1, ground);
  Pair pair{{m.matching.pairs[k].first, m.matching.pairs[k].second}, {}, 0};
  for (std::size_t side = 0; side < 2; ++side) {
    const bool on_diagonal = pair.places[side] < 0;
    const std::size_t of = on_diagonal ? 1 - side : side;
    const Bar& bar = m.bars[of][static_cast<std::size_t>(pair.places[of])];
    const double middle = std::midpoint(bar.birth, bar.death);  // mutant: matching-diagonal
    pair.ends[side] = on_diagonal ? std::array{middle, middle} : std::array{bar.birth, bar.death};
    if (on_diagonal) pair.cost = cost.distance_alone({bar.birth, bar.death});
  }
  const auto& [a, b] = pair.ends;
  if (pair.places[0] >= 0 && pair.places[1] >= 0)
    pair.cost = cost.distance({difference(a[0], b[0]), difference(a[1], b[1])}, {0, 0});
  return pair;
}

std::string csv_row(int dim, const std::string& choice, const Pair& pair) {
  std::string row = fmt::format("{},{}", dim, choice);
  for (const std::int64_t place : pair.places)
    row += place < 0 ? ",diagonal" : "," + std::to_string(place);
  for (const auto& ends : pair.ends)
    row += fmt::format(",{},{}", shortest(ends[0]), shortest(ends[1]));
  return fmt::format("{},{}\n", row, shortest(pair.cost));
}

std::string json_side(const Pair& pair, std::size_t side) {
  const std::int64_t place = pair.places[side];
  const auto& [birth, death] = pair.ends[side];
  return json::object({{"bar", place < 0 ? json::string("diagonal") : json::integer(place)},
                       {"birth", birth == -kInfinity ? json::string("-inf") : json::number(birth)},
                       {"death", json::number(death)}});
}

std::string json_row(int dim, const Pair& pair) {
  return json::object({{"dim", json::integer(dim)},
                       {"a", json_side(pair, 0)},
                       {"b", json_side(pair, 1)},
                       {"cost", json::number(pair.cost)}});
}

}  // namespace

void write_matching(OutputFile& file, std::span<const DimMatching> matchings, bool is_json,
                    const app::DistanceChoice& choice, const std::vector<std::string>& inputs) {
  if (is_json) {
    const auto distance = [](const DimMatching& m) {
      return json::object({{"dim", json::integer(m.dim)},
                           {"value", json::number(m.matching.distance.value)},
                           {"lower", json::number(m.matching.distance.lower)}});
    };
    file.write("{\n  " + document_members("ph-distance matching", choice, inputs) +
               ",\n  \"distances\": " + json::lines(matchings, distance) + ",\n  \"pairs\": [");
  } else {
    file.write("dim,distance,order,ground,a,b,a_birth,a_death,b_birth,b_death,cost\n");
  }
  const std::string cells =
      fmt::format("{},{},{}", choice.name(), shortest(choice.order()), shortest(*choice.ground()));
  std::string_view before = "\n    ";
  for (const DimMatching& m : matchings)
    for (std::size_t k = 0; k < m.matching.pairs.size(); ++k) {
      const Pair pair = pair_of(m, k, *choice.ground());  // mutant: matching-cost
      if (!is_json) {
        file.write(csv_row(m.dim, cells, pair));
        continue;
      }
      file.write(before);
      file.write(json_row(m.dim, pair));
      before = ",\n    ";
    }
  if (is_json) file.write(before.starts_with(',') ? "\n  ]\n}\n" : "]\n}\n");
}

}  // namespace ph::distance_program

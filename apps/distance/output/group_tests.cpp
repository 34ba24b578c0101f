// SPDX-License-Identifier: MIT
#include "apps/distance/output/group_tests.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/distance/output/table.hpp"
#include "ph/detail/io/json_writer.hpp"
#include "ph/error.hpp"
#include "ph/io/write.hpp"

namespace ph::distance_program {
namespace {

/// Throws Error (bad_data) with the names of two barcodes that are infinitely far apart, if there
/// are any.
void require_finite(const PairDistances& distances, std::size_t d,
                    const std::vector<Barcode>& barcodes, const std::vector<std::string>& inputs) {
  const int dim = distances.dims()[d];
  for (std::size_t a = 0; a < distances.count(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (std::isinf(distances.at(d, a, b).value))  // mutant: group-infinite
        throw Error(ErrorKind::bad_data,
                    fmt::format("--groups: {} and {}: found an infinite distance in H{} ({}), "
                                "expected finite distances; leave such bars out",
                                printable(inputs[b]), printable(inputs[a]), dim,
                                app::why_infinite(barcodes[b].bars(dim), barcodes[a].bars(dim))));
}

}  // namespace

std::vector<PermutationTest> tests_of(const PairDistances& distances, const Groups& groups,
                                      const std::vector<Barcode>& barcodes,
                                      const std::vector<std::string>& inputs,
                                      const Arguments& arguments, const RunContext& context) {
  std::vector<PermutationTest> tests;
  for (std::size_t d = 0; d < distances.dims().size(); ++d) {
    require_finite(distances, d, barcodes, inputs);
    const MemoryClaim claim(context.memory, distances.pairs() * sizeof(double));
    tests.push_back(permutation_test(distances.matrix(d), groups.of, arguments.test, context));
  }
  return tests;
}

void write_tests(OutputFile& file, const std::vector<PermutationTest>& tests,
                 const PairDistances& distances, const Groups& groups,
                 const std::vector<std::string>& inputs, const Arguments& arguments) {
  const app::DistanceChoice& choice = arguments.distance;
  const auto& [shuffles, power, seed] = arguments.test;
  const OutputFormat format = arguments.table_format();
  if (format == OutputFormat::json) {
    const auto test = [&](const std::size_t& d) {
      return json::object({{"dim", json::integer(distances.dims()[d])},
                           {"p", json::number(tests[d].p)},
                           {"loss", json::number(tests[d].loss)}});
    };
    std::vector<std::size_t> places(tests.size());
    for (std::size_t d = 0; d < places.size(); ++d) places[d] = d;
    const auto group = [&](std::int64_t g) {
      return json::string(groups.names[static_cast<std::size_t>(g)]);
    };
    std::string members = document_members("ph-distance", choice, inputs);
    json::add_members(members,
                      {{"groups", json::array(groups.of, group)},
                       {"shuffles", json::integer(shuffles)},
                       {"power", json::number(power)},
                       {"seed", json::integer(seed)},
                       {"tests", json::lines(places, test)}},
                      ",\n  ");
    file.write("{\n  " + members + ",\n  ");
    write_distance_rows(file, distances);
    file.write("\n}\n");
    return;
  }
  const bool is_text = format == OutputFormat::text;
  if (is_text)
    file.write(fmt::format("{}: {}\n", heading(choice, inputs), words_of(groups)));
  else
    file.write(fmt::format("dim,{},power,shuffles,seed,p,loss\n", kChoiceColumns));
  for (std::size_t d = 0; d < tests.size(); ++d) {
    const std::string p = shortest(tests[d].p), loss = shortest(tests[d].loss);
    const int dim = distances.dims()[d];
    file.write(is_text ? fmt::format("H{}  p {}, loss {} ({} shuffles, power {}, seed {})\n", dim,
                                     p, loss, shuffles, shortest(power), seed)
                       : fmt::format("{},{},{},{},{},{},{}\n", dim, choice_cells(choice),
                                     shortest(power), shuffles, seed, p, loss));
  }
  if (is_text && tests.empty()) file.write("no bars\n");
}

}  // namespace ph::distance_program

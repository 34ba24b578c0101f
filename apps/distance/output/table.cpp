// SPDX-License-Identifier: MIT
#include "apps/distance/output/table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/common/files/csv_cell.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "ph/detail/io/json_writer.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/io/write.hpp"

namespace ph::distance_program {
namespace {

/// Calls `use(dim, a, b, bounds)` for all pairs of indices a < b.
template <class Use>
void for_each(const PairDistances& distances, Use&& use) {
  for (std::size_t dim = 0; dim < distances.dims().size(); ++dim)
    for (std::size_t a = 0; a < distances.count(); ++a)
      for (std::size_t b = a + 1; b < distances.count(); ++b)
        use(dim, a, b, distances.at(dim, b, a));
}

void write_text(OutputFile& file, const PairDistances& distances,
                const std::vector<Barcode>& barcodes, const std::vector<std::string>& inputs,
                const app::DistanceChoice& choice) {
  file.write(heading(choice, inputs) + "\n");
  for_each(distances, [&](std::size_t d, std::size_t a, std::size_t b, const auto& bounds) {
    const int dim = distances.dims()[d];
    std::string line = fmt::format(
        "H{}  {}", dim, app::text_of(bounds, choice, barcodes[a].bars(dim), barcodes[b].bars(dim)));
    if (inputs.size() > 2)
      line += fmt::format("  {}  {}", printable(inputs[a]), printable(inputs[b]));
    file.write(line + "\n");
  });
  if (distances.dims().empty()) file.write("no bars\n");
}

void write_csv(OutputFile& file, const PairDistances& distances,
               const std::vector<std::string>& inputs, const app::DistanceChoice& choice) {
  file.write(fmt::format("a,b,dim,{},value,lower\n", kChoiceColumns));
  const std::string cells = choice_cells(choice);
  std::vector<std::string> names;
  for (const std::string& input : inputs) names.push_back(app::csv_cell(input));
  for_each(distances, [&](std::size_t dim, std::size_t a, std::size_t b, const auto& bounds) {
    file.write(fmt::format("{},{},{},{},{},{}\n", names[a], names[b], distances.dims()[dim], cells,
                           shortest(bounds.value), shortest(bounds.lower)));
  });
}

}  // namespace

std::string choice_cells(const app::DistanceChoice& choice) {
  const auto ground = choice.ground();
  return fmt::format("{},{},{},{}", choice.name(), shortest(choice.order()),
                     ground ? shortest(*ground) : "",
                     ground ? "" : std::to_string(choice.directions));
}

std::string document_members(std::string_view format, const app::DistanceChoice& choice,
                             const std::vector<std::string>& inputs) {
  std::string members;
  const std::string_view between = ",\n  ";
  json::add_members(members,
                    {{"format", json::string(format)},
                     {"version", "1"},
                     {"program", json::string(app::program_and_version("ph-distance"))},
                     {"distance", json::string(choice.name())},
                     {"order", json::number(choice.order())}},
                    between);
  if (const auto ground = choice.ground())
    json::add_members(
        members,
        {{"ground", json::number(*ground)},
         {"relative_error", json::number(choice.limits.relative_error)},
         {"at_most", std::isinf(choice.limits.at_most) ? "" : json::number(choice.limits.at_most)}},
        between);
  else
    json::add_members(members, {{"directions", json::integer(choice.directions)}}, between);
  json::add_members(members, {{"inputs", json::array(inputs, json::string)}}, between);
  return members;
}

std::string heading(const app::DistanceChoice& choice, const std::vector<std::string>& inputs) {
  return fmt::format("{} of {}", app::words_of(choice),
                     inputs.size() == 2
                         ? fmt::format("{} and {}", printable(inputs[0]), printable(inputs[1]))
                         : fmt::format("{} barcodes", inputs.size()));
}

void write_distances(OutputFile& file, const PairDistances& distances,
                     const std::vector<Barcode>& barcodes, const std::vector<std::string>& inputs,
                     const Arguments& arguments) {
  const app::DistanceChoice& choice = arguments.distance;
  switch (arguments.table_format()) {
    case OutputFormat::text:
      return write_text(file, distances, barcodes, inputs, choice);
    case OutputFormat::csv:
      return write_csv(file, distances, inputs, choice);
    case OutputFormat::json:
      break;
  }
  file.write("{\n  " + document_members("ph-distance", choice, inputs) + ",\n  ");
  write_distance_rows(file, distances);
  file.write("\n}\n");
}

void write_distance_rows(OutputFile& file, const PairDistances& distances) {
  file.write("\"distances\": [");
  std::string_view before = "\n    ";
  for_each(distances, [&](std::size_t dim, std::size_t a, std::size_t b, const auto& bounds) {
    file.write(before);
    file.write(json::object({{"a", json::integer(a)},
                             {"b", json::integer(b)},
                             {"dim", json::integer(distances.dims()[dim])},
                             {"value", json::number(bounds.value)},
                             {"lower", json::number(bounds.lower)}}));
    before = ",\n    ";
  });
  file.write(before.starts_with(',') ? "\n  ]" : "]");
}

}  // namespace ph::distance_program

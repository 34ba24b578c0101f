// SPDX-License-Identifier: MIT
// Checks the contents of a report page: arrays of arbitrary numbers, and texts of arbitrary bytes.
#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "ph/detail/io/json_cursor.hpp"
#include "ph/detail/report/array_block.hpp"
#include "ph/detail/report/metadata.hpp"
#include "tests/fuzz/chosen_numbers.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"
#include "tests/support/report_arrays.hpp"

namespace ph::fuzz {
namespace {

using namespace report;

/// Writes an array and reads it back. The numbers must be equal bit for bit, and the HTML element
/// must contain nothing else.
template <class T>
void check_array(ChosenNumbers& chosen) {
  const auto rows = static_cast<std::size_t>(chosen.choice(9)),
             columns = static_cast<std::size_t>(1 + chosen.choice(4));
  std::vector<T> numbers(rows * columns);
  for (T& x : numbers) {
    unsigned char bytes[sizeof(T)];
    for (unsigned char& byte : bytes) byte = chosen.byte();
    std::memcpy(&x, bytes, sizeof x);
  }
  std::string element;
  write_array([&element](std::string_view piece) { element += piece; },
              raw_array("a/b", std::span<const T>(numbers)),
              {.shape = {rows, columns}, .delta = std::is_integral_v<T> && chosen.coin()},
              default_context());
  require(std::ranges::count(element, '<') == 2 && std::ranges::count(element, '>') == 2,
          "an array is more than an element");
  const std::vector<T> found = test::numbers_of<T>(element, numbers.size(), columns);
  require(found.size() == numbers.size() &&
              (found.empty() ||
               std::memcmp(found.data(), numbers.data(), found.size() * sizeof(T)) == 0),
          "an array is not read back equal");
}

std::string text_of(ChosenNumbers& chosen) {
  std::string text(static_cast<std::size_t>(chosen.choice(12)), ' ');
  for (char& c : text) c = static_cast<char>(chosen.byte());
  return text;
}

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// Checks that the metadata are JSON without HTML tags, and contain the texts and numbers of the
/// input.
void check_metadata(ChosenNumbers& chosen) {
  Metadata meta;
  meta.title = text_of(chosen);
  meta.value_label = text_of(chosen);
  meta.barcodes.push_back({text_of(chosen), CellKind::grid, Representatives::cycles});
  meta.axes = {text_of(chosen)};
  meta.cloud.emplace().projection = text_of(chosen);
  meta.distances = {{1, chosen.number()}};
  meta.provenance.command = {text_of(chosen), text_of(chosen)};
  meta.provenance.notes = {{text_of(chosen), text_of(chosen)}};
  meta.provenance.run.input = text_of(chosen);
  const std::string json = metadata_json(meta);
  require(json.find('<') == std::string::npos, "metadata hold a tag");

  const Input input = Input::view(json, "metadata");
  detail::JsonCursor cursor(input);
  bool has_title = false;
  cursor.for_each_member([&](const std::string& name) {
    if (name != "title") return cursor.skip_value();
    const std::string title = cursor.string();
    require(!is_ascii(meta.title) || title == meta.title, "a title is another");
    has_title = true;
  });
  cursor.expect_end();
  require(has_title || meta.title.empty(), "a title is lost");
}

}  // namespace

void run_report(std::string_view bytes) {
  ChosenNumbers chosen(bytes);
  switch (chosen.choice(8)) {
    case 0:
      return check_array<std::uint8_t>(chosen);
    case 1:
      return check_array<std::int8_t>(chosen);
    case 2:
      return check_array<std::uint16_t>(chosen);
    case 3:
      return check_array<std::int16_t>(chosen);
    case 4:
      return check_array<std::uint32_t>(chosen);
    case 5:
      return check_array<std::int32_t>(chosen);
    case 6:
      return check_array<float>(chosen);
    case 7:
      return check_array<double>(chosen);
    default:
      return check_metadata(chosen);
  }
}

}  // namespace ph::fuzz

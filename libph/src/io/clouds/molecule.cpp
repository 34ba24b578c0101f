// SPDX-License-Identifier: MIT
// Reads the places of the atoms in a molecule, as programs for chemistry write them in XYZ.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/clouds/cloud_rows.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

constexpr std::size_t kCoordinates = 3;
constexpr std::size_t kShown = 40;  // bytes of a line shown in a message

// A chemical symbol, possibly with a number: C, Na, H12.
bool is_element(std::string_view word) {
  const auto is_in = [](char first, char last) {
    return [=](char c) { return first <= c && c <= last; };
  };
  const auto* const digits = std::ranges::find_if(word, is_in('0', '9'));
  const auto letters = static_cast<std::size_t>(digits - word.begin());
  return letters >= 1 && letters <= 2 && is_in('A', 'Z')(word[0]) &&
         (letters == 1 || is_in('a', 'z')(word[1])) &&
         std::all_of(digits, word.end(), is_in('0', '9'));
}

struct Start {
  std::size_t atoms = 0;
  std::string_view comment;  // the second line
  std::size_t offset = 0;    // the first byte of the first atom
};

// The start of a molecule: the number of atoms, a line of any text, then the element and the place
// of the first atom.
std::optional<Start> start_of(const Input& input) {
  constexpr std::size_t probe = 1 << 16;
  const std::string_view text = input.text();
  std::string_view rest = text.substr(0, probe);
  const auto take_line = [&] {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    while (!line.empty() && std::string_view(" \t\r").find(line.back()) != line.npos)
      line.remove_suffix(1);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return line;
  };
  Start start;
  const std::string_view number = take_line();
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), start.atoms);
  if (error != std::errc{} || end != number.data() + number.size()) return std::nullopt;
  start.comment = take_line();
  start.offset = static_cast<std::size_t>(rest.data() - text.data());
  std::string_view atom = take_line();
  for (std::size_t k = 0; k <= kCoordinates; ++k) {
    const std::string_view word = atom.substr(0, atom.find_first_of(" \t"));
    if (k == 0 ? !is_element(word) : !number_in(word)) return std::nullopt;
    atom.remove_prefix(word.size());
    atom.remove_prefix(std::min(atom.find_first_not_of(" \t"), atom.size()));
  }
  return start;
}

// Refuses a molecule of extended XYZ whose columns are not the element and then the place.
void check_properties(const Input& input, std::string_view comment) {
  const std::size_t at = comment.find("Properties=");
  if (at == comment.npos || comment.substr(at).starts_with("Properties=species:S:1:pos:R:3"))
    return;
  input.fail_at(2, 1,
                {"columns of a molecule", printable(comment.substr(at), kShown),
                 "Properties=species:S:1:pos:R:3, then any others",
                 "write the coordinates alone, one point per line"});
}

}  // namespace

bool is_molecule(const Input& input) { return start_of(input).has_value(); }

Cloud read_molecule(const Input& input, const ReadOptions& options) {
  const Start start = start_of(input).value();
  check_properties(input, start.comment);
  const auto refuse_count = [&](std::string_view what, std::size_t line, std::string found,
                                std::string hint) {
    input.fail_at(line, 1,
                  {std::string(what), std::move(found),
                   fmt::format("{} atoms, as line 1 says", start.atoms), std::move(hint)});
  };
  constexpr std::size_t least = 8;  // bytes of an atom: C 0 0 0, with a line end
  const std::size_t most = (input.size() - start.offset + 1) / least;
  if (start.atoms > most) refuse_count("truncated", 1, fmt::format("at most {}", most), {});
  input.require_memory(start.atoms * kCoordinates * sizeof(double));
  TextTable table{Points(static_cast<Index>(start.atoms), kCoordinates), {}};
  TextLines lines(input, start.offset, 2);
  Cells cells(lines);
  std::size_t count = 0;
  bool has_more = false;  // columns after z
  for (; lines.next(); ++count) {
    if (count == start.atoms)
      refuse_count("trailing data", lines.number(), printable(lines.line(), kShown),
                   "if there are several molecules, write each into its own file");
    cells.start();
    const char* const place = cells.place();
    const std::string_view element = cells.word();
    if (!is_element(element))
      lines.fail(place, {"atom without an element",
                         printable(element, kShown),
                         "a symbol such as C, then x y z",
                         {}});
    double* const row = table.rows.data() + count * kCoordinates;
    for (std::size_t k = 0; k < kCoordinates; ++k) row[k] = cells.number(Allow::any);
    has_more = has_more || cells.more();
  }
  if (count < start.atoms)
    refuse_count("truncated", lines.number(), fmt::format("{} atoms", count), {});
  note(options,
       fmt::format("a molecule of {} atoms: line 2, \"{}\"{} are left out", count,
                   printable(start.comment, kShown),
                   has_more ? ", the elements and the columns after z" : " and the elements"));
  return cloud_of_rows(table, input, options, RowSource::text);
}

}  // namespace ph::detail

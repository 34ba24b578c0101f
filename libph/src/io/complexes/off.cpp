// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/error.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

constexpr std::int64_t kMost = std::int64_t{1} << 40;

/// These keywords may be in the first line. The coordinates of a vertex may be followed by texture
/// coordinates (ST), colours (C) and a normal (N), which are ignored.
constexpr std::array<std::string_view, 9> kWords{"OFF",   "COFF",   "NOFF",   "CNOFF",  "NCOFF",
                                                 "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
constexpr std::size_t kProbe = 64;  // the bytes that decide

// The keyword at the start of a text, or nothing. The files of ModelNet have the number of vertices
// immediately after the keyword: "OFF30 0 0".
std::string_view keyword(std::string_view text) {
  const std::size_t end = std::min(text.find_first_of(" \t\r\n0123456789"), text.size());
  const std::string_view word = text.substr(0, end);
  if (std::ranges::find(kWords, word) == kWords.end()) return {};
  const std::string_view rest = text.substr(end);
  const std::size_t blank = rest.find_first_not_of("0123456789");
  const bool has_count = blank != 0 && !rest.empty();
  if (!has_count) return word;
  // Two numbers must follow, because "OFF1" may be the name of a column.
  const std::size_t next = rest.find_first_not_of(" \t", std::min(blank, rest.size()));
  const bool has_faces = blank != std::string_view::npos && next != std::string_view::npos &&
                         next > blank && rest[next] >= '0' && rest[next] <= '9';
  return has_faces ? word : std::string_view();
}

// Goes to the line of the next vertex or face, which must exist.
void need_line(TextLines& lines, const char* what, std::size_t have, std::size_t all) {
  if (!lines.next()) {
    lines.input().fail({fmt::format("truncated: too few {}", what),
                        fmt::format("{}", have),
                        fmt::format("{}, the number in the header", all),
                        {}});
  }
}

void need_cell(const TextLines& lines, const Cells& cells, const char* expected) {
  if (!cells.more()) {
    lines.fail(lines.line().data() + lines.line().size(),
               {"line too short", "the end of the line", expected, {}});
  }
}

}  // namespace

namespace detail {

bool is_off(const Input& input) { return !keyword(input.text().substr(0, kProbe)).empty(); }

}  // namespace detail

Mesh read_off(const Input& input, const ReadOptions& options) {
  TextLines lines(input);
  Cells cells(lines);
  const std::string_view word = lines.next() ? keyword(lines.line()) : std::string_view();
  if (word.empty()) {
    input.fail_at(1, 1,
                  {"not an OFF file",
                   "a different first word",
                   alternatives(fmt::format("{}", fmt::join(kWords, "|"))),
                   {}});
  }
  cells.start_in(lines.line().substr(word.size()));
  if (!cells.more()) {
    if (!lines.next())
      input.fail({"truncated: the counts are missing",
                  "the end of the file",
                  "the numbers of vertices and faces",
                  {}});
    cells.start();
  }
  const auto vertices = static_cast<std::size_t>(cells.integer(0, kMost, "number of vertices"));
  need_cell(lines, cells, "the number of faces");
  const auto faces = static_cast<std::size_t>(cells.integer(0, kMost, "number of faces"));
  if (cells.more()) cells.integer(0, kMost, "number of edges");
  // A vertex takes at least six bytes ("0 0 0\n"), and a face takes at least two bytes.
  const std::size_t rest = input.size() - lines.offset() + 1;
  if (vertices > rest / 6 || faces > rest / 2) {
    lines.fail(lines.line().data(), {"truncated: the counts do not fit the file",
                                     fmt::format("{} vertices and {} faces", vertices, faces),
                                     fmt::format("no more than fit into {} bytes", rest),
                                     {}});
  }
  input.require_memory(vertices * 3 * sizeof(double) + faces * sizeof(std::size_t));
  Mesh mesh;
  mesh.vertices = Points(static_cast<Index>(vertices), 3);
  for (std::size_t i = 0; i < vertices; ++i) {
    need_line(lines, "vertices", i, vertices);
    cells.start();
    for (Index k = 0; k < 3; ++k) {
      need_cell(lines, cells, "x y z");
      mesh.vertices(static_cast<Index>(i), k) = cells.number();
    }
    while (cells.more()) cells.number();  // colours and similar columns are ignored
  }
  for (std::size_t i = 0; i < faces; ++i) {
    need_line(lines, "faces", i, faces);
    cells.start();
    const Index corners =
        cells.integer(1, static_cast<Index>(lines.line().size()), "number of corners");
    for (Index k = 0; k < corners; ++k) {
      need_cell(lines, cells, "a vertex for each corner");
      detail::require_growth(input, mesh.corners);
      mesh.corners.push_back(cells.integer(0, static_cast<Index>(vertices) - 1, "vertex"));
    }
    while (cells.more()) cells.number();  // colours are ignored
    mesh.offsets.push_back(mesh.corners.size());
  }
  if (lines.next()) {
    lines.fail(lines.line().data(), {"trailing data", "another line", "the end of the file", {}});
  }
  if (vertices == 0 && !options.allow_empty) {
    input.fail(
        {"no vertices", {}, "at least one", mark(Setting::allow_empty) + " accepts an empty mesh"});
  }
  return mesh;
}

Mesh read_off(const std::filesystem::path& path, const ReadOptions& options) {
  return read_off(
      Input::open(path, options.context, Input::Excess::refused, detail::start_check(Format::off)),
      options);
}

}  // namespace ph

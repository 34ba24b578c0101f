// SPDX-License-Identifier: MIT
// Reads any format. This file chooses the format if the caller does not, and refuses options that
// the format does not support.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/bytes/utf8.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

// True if the input is an image that need not be entirely in memory.
bool goes_by_blocks(const Input& input, Format format, const ReadOptions& options) {
  switch (format) {
    case Format::nifti:
    case Format::nrrd:
    case Format::metaimage:
    case Format::vti:
    case Format::tiff:
      return true;
    case Format::raw:
      return options.raw && options.raw->coordinates == 0;
    case Format::npy:
      return detail::guess_array(input, options).meaning == ArrayMeaning::image;
    case Format::dipha:
      return detail::dipha_type(input) == detail::DiphaType::image;
    default:
      return false;
  }
}

// Chooses the format of a text of numbers from the options or, if they leave it open, from the
// rows.
Format format_of_text(const Input& input, const ReadOptions& options) {
  if (options.array == ArrayMeaning::image) {
    // Rows of two to four numbers are usually coordinates, and rarely pixels.
    const std::size_t width = detail::table_layout(input, options).columns.size();
    if (width >= 2 && width <= 4) return Format::points;
    if (width > 4)
      detail::note(options,
                   fmt::format("read as an image; {} reads points", mark(Setting::voxel, "X")));
    return Format::grid;
  }
  const detail::TextGuess guess = detail::guess_text(input, options);
  const bool is_table = guess.format == Format::points || guess.format == Format::distance;
  if (!is_table) return guess.format;
  // mutant: guess-matrix-option
  if (const std::string option = detail::matrix_option(options); !option.empty()) {
    const bool is_square = guess.table.rows == guess.columns;
    // A table that is not square is read as points if the option concerns only the diagonal. Points
    // have no diagonal. An option that accepts any diagonal is therefore always fulfilled, and an
    // option that takes births from the diagonal is refused later.
    const bool has_diagonal = !options.from_correlation && options.diagonal != Diagonal::zero;
    const bool is_by_diagonal =
        options.diagonal == Diagonal::births || options.symmetrise == Symmetrise::none;
    if (!is_square && has_diagonal && is_by_diagonal) return Format::points;
    if (guess.table.rows != 0 && !is_square) {
      input.fail({"not a square matrix",
                  guess.table.rows > guess.columns
                      ? fmt::format("more than {0} rows of {0} cells", guess.columns)
                      : fmt::format("{} rows of {} cells", guess.table.rows, guess.columns),
                  fmt::format("as many rows as columns, for {}", option),
                  "is the file truncated, or a set of points?"});
    }
    return Format::distance;
  }
  if (options.array == ArrayMeaning::points) return Format::points;
  using detail::SquareKind;
  if (guess.columns == 1 && guess.table.rows > 1 && options.array == ArrayMeaning::automatic)
    detail::note(options, Message::guess(fmt::format(
                              "one number per line: points on a line; {} reads a signal",
                              mark(Setting::complex, "cubical"))));
  const std::string size = fmt::format("{} x {} numbers", guess.table.rows, guess.columns);
  const bool is_nearly = guess.table.square == SquareKind::nearly_correlations ||
                         guess.table.square == SquareKind::nearly_symmetric;
  const bool is_of_ones = guess.table.square == SquareKind::correlations ||
                          guess.table.square == SquareKind::nearly_correlations;
  const std::string_view symmetric = is_nearly ? "nearly symmetric" : "symmetric";
  const std::string as_points = mark(Setting::format, "points");
  const std::string correlations = mark(Setting::from_correlation);
  const std::string choices = fmt::format(
      "{} reads distances{}, {} one point per row",
      detail::way_to_distances(is_of_ones || guess.table.square == SquareKind::distances),
      is_of_ones ? fmt::format(", {} correlations", correlations) : "", as_points);
  if (guess.format == Format::distance) {
    detail::note(
        options,
        fmt::format("square with a zero diagonal: read as distances; {} reads points", as_points));
  } else if (guess.table.rows > 2 && is_of_ones) {
    input.fail({"correlations or points",
                fmt::format("{}, {}, from -1 to 1 with ones on the diagonal", size, symmetric),
                "an option that says which",
                fmt::format("{} reads correlations r as distances 1 - r, {} one point per row",
                            correlations, as_points)});
  } else if (guess.table.same_names && (guess.table.square == SquareKind::symmetric ||
                                        guess.table.square == SquareKind::nearly_symmetric)) {
    input.fail({"distances, correlations or points",
                fmt::format("{}, rows and columns with the same names, no zero diagonal", size),
                "an option that says which", choices});
  } else if (guess.table.square != SquareKind::nothing && guess.table.square != SquareKind::zeros) {
    detail::note(options, Message::guess(
                              fmt::format("{}, {}: read as points; {}", size, symmetric, choices)));
  }
  return guess.format;
}

// Refuses JSON, which would pass for a list of simplices because of its colons.
void refuse_json(const Input& input) {
  const std::string_view text = input.text();
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos || text[first] != '{') return;
  constexpr std::string_view format = "\"format\": \"ph-";
  const bool is_result = text.substr(first, 2 * format.size()).find(format) != text.npos;
  input.fail({"not numbers", is_result ? "a JSON file of libph" : "a JSON file",
              "points, distances, an image or a complex",
              is_result ? "it is a result, not an input" : "write the numbers as text or as .npy"});
}

// Refuses options that the format of an input does not support.
void check_part(const Input& input, Format format, const ReadOptions& options) {
  const auto refuse = [&](Setting setting, std::string_view meant_for) {
    throw Error(ErrorKind::usage, fmt::format("{}: makes sense for {} only, found {}",
                                              mark(setting), meant_for, format_info(format).name));
  };
  const bool is_table = format == Format::points || format == Format::distance ||
                        format == Format::grid || format == Format::npy || format == Format::npz ||
                        (format == Format::raw && options.raw && options.raw->coordinates != 0);
  if (!options.columns.empty() && !is_table)
    refuse(Setting::columns, "tables of numbers (text, NPY, NPZ or raw points)");
  if (options.channel != Channel::automatic && format != Format::png && format != Format::tiff)
    refuse(Setting::channel, "PNG and TIFF pictures");
  if (options.weld && format != Format::off && format != Format::ply)
    refuse(Setting::weld, "meshes (OFF or PLY)");
  if (format == Format::ply && !input.member().empty()) {
    input.fail({"a property of a mesh", printable(input.member(), 40), "the mesh itself",
                mark(Setting::values, "FILE.ply:NAME") + " takes one"});
  }
}

// Reads the values of cells or vertices from a separate file, if there is one.
void add_values(ReadResult& result, const std::filesystem::path& values_path,
                const ReadOptions& options) {
  if (values_path.empty()) return;
  const auto values_for = [&](std::size_t count, std::string_view owner) {
    return read_values(
        Input::open(values_path, options.context, Input::Excess::refused, detail::start_check()),
        count, options, owner);
  };
  if (auto* boundary = std::get_if<BoundaryInput>(&result.data)) {
    boundary->matrix.values = values_for(boundary->matrix.size(), "cell");
  } else if (auto* mesh = std::get_if<Mesh>(&result.data)) {
    mesh->values = values_for(static_cast<std::size_t>(mesh->vertices.rows()), "vertex");
  } else if (auto* simplices = std::get_if<SimplicesInput>(&result.data)) {
    const auto& vertices = simplices->simplices.vertices;
    const Index largest =
        vertices.empty() ? -1 : *std::max_element(vertices.begin(), vertices.end());
    simplices->vertex_values = values_for(static_cast<std::size_t>(largest + 1), "vertex");
  } else {
    throw Error(ErrorKind::usage,
                fmt::format("{}: format {} takes no separate values", mark(Setting::values),
                            format_info(result.format).name));
  }
}

// Joins the vertices at one position if options.weld is set. Otherwise a note reports them.
void join_vertices(Mesh& mesh, const Input& input, const ReadOptions& options, ReadResult& result) {
  if (!options.weld) {
    if (mesh.values.empty()) return;  // the vertices may be points, and the faces may not be used
    if (const std::string text = detail::note_on_seams(mesh, input); !text.empty())
      detail::note(options, Message::guess(text));
    return;
  }
  const Index before = mesh.vertices.rows();
  std::vector<Index> kept = detail::weld(mesh, input);
  const Index joined = before - mesh.vertices.rows();
  if (joined > 0) result.point_ids = std::move(kept);
  detail::note(options,
               joined > 0
                   ? fmt::format("{} of {} vertices joined with another one at the same position",
                                 joined, before)
                   : mark(Setting::weld) + " does nothing: no two vertices have the same position");
}

}  // namespace

std::string detail::way_to_raw() {
  return fmt::format("{} reads numbers without a header as an image; {} reads them as points",
                     mark(Setting::raw_shape, "N,M"), mark(Setting::raw_points, "D"));
}

void detail::refuse_bytes(const Input& input, std::string_view hint) {
  detail::require_text(input, hint);
  // Form feeds, the end mark of DOS and escape sequences occur in texts. Other control characters
  // do not.
  constexpr std::size_t most = 4096;
  const std::string_view probe = input.text().substr(0, most);
  const auto* const odd = std::ranges::find_if(probe, [](char c) {
    return static_cast<unsigned char>(c) < 0x20 &&
           std::string_view("\t\n\v\f\r\x1A\x1B").find(c) == std::string_view::npos;
  });
  if (odd != probe.end()) {
    const auto place = static_cast<std::size_t>(odd - probe.begin());
    input.fail_at_byte(
        place, {"not plain text", "a control character, " + printable(probe.substr(place, 1)),
                "UTF-8", std::string(hint)});
  }
  const std::size_t foreign = first_of_many_foreign_bytes(probe);
  if (foreign != std::string_view::npos)
    input.fail_at_byte(foreign,
                       {"not plain text", "bytes that are no UTF-8", "UTF-8", std::string(hint)});
}

ReadResult read_any(const Input& input, Format format, const ReadOptions& options,
                    const std::filesystem::path& values_path) {
  std::vector<Message> notes;
  std::vector<Index> dropped;
  ReadOptions inner = options;
  inner.note = [&](Message text) {
    notes.push_back(text);
    if (options.note) options.note(std::move(text));
  };
  inner.dropped = &dropped;
  if (options.stack) {
    detail::Stack stack = detail::read_stack(input, format, inner);
    check_part(input, stack.format, options);
    ReadResult result;
    result.description =
        fmt::format("image of {} voxels, {} {} files", fmt::join(stack.image.extents, " x "),
                    stack.image.extents[0], stack.kind);
    result.data = std::move(stack.image);
    result.format = stack.format;
    add_values(result, values_path, options);
    result.notes = std::move(notes);
    if (options.dropped != nullptr) options.dropped->clear();
    return result;
  }
  if (format == Format::automatic) {
    const auto known = detail::format_by_content(input);
    if (known == Format::points) detail::refuse_bytes(input, detail::way_to_raw());
    if (!known) refuse_json(input);
    format = known ? *known : format_of_text(input, inner);
    if (format == Format::binary)
      if (const std::string way = detail::way_to_raw_points(input); !way.empty())
        detail::note(inner, Message::guess("a file named .bin: read as distances; " + way));
  }
  check_part(input, format, options);
  const FormatInfo& info = format_info(format);
  if (info.read == nullptr) {
    throw Error(ErrorKind::not_built_in,
                fmt::format("{}: format {} is not built in", mark_place(input.name()), info.name));
  }
  if (!goes_by_blocks(input, format, inner)) input.take_memory();
  ReadResult result = info.read(input, inner);
  result.format = format;
  if (options.dropped != nullptr) *options.dropped = dropped;
  if (!dropped.empty()) {
    const auto* points = std::get_if<Points>(&result.data);
    const Index total = (points ? points->rows() : 0) + static_cast<Index>(dropped.size());
    auto next = dropped.begin();
    for (Index i = 0; i < total; ++i) {
      if (next != dropped.end() && *next == i) {
        ++next;
      } else {
        result.point_ids.push_back(i);
      }
    }
  }
  if (const auto* points = std::get_if<Points>(&result.data);
      points && points->rows() == 0 && !options.allow_empty) {
    input.fail(
        {"no points", {}, "at least one", mark(Setting::allow_empty) + " accepts an empty set"});
  }
  add_values(result, values_path, options);
  if (auto* mesh = std::get_if<Mesh>(&result.data)) {
    join_vertices(*mesh, input, inner, result);
  } else if (options.weld) {
    throw Error(ErrorKind::usage, fmt::format("{}: makes sense for meshes only, found {}",
                                              mark(Setting::weld), result.description));
  }
  result.notes = std::move(notes);
  return result;
}

ReadResult read_any(const std::filesystem::path& path, Format format, const ReadOptions& options,
                    const std::filesystem::path& values_path) {
  if (options.stack)
    return read_any(Input::of_folder(path, options.context), format, options, values_path);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(
        ErrorKind::no_input,
        fmt::format("{}: cannot read: it is a directory; {} reads the pictures in it as one "
                    "volume",
                    mark_place(printable(path.string())), mark(Setting::stack)));
  return read_any(
      Input::open(path, options.context, Input::Excess::stays_in_file, detail::start_check(format)),
      format, options, values_path);
}

}  // namespace ph

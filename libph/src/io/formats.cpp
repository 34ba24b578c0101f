// SPDX-License-Identifier: MIT
#include "ph/io/formats.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "ph/io/cloud_io.hpp"
#include "readers.hpp"
#include "table.hpp"

namespace ph {
namespace {

ReadResult result_of(Points points, std::string_view kind) {
  ReadResult result;
  result.description = fmt::format("{} point{} in R^{}, {}", points.rows(),
                                   points.rows() == 1 ? "" : "s", points.cols(), kind);
  result.data = std::move(points);
  return result;
}

ReadResult result_of(DistanceMatrix distances, std::string_view kind) {
  ReadResult result;
  result.description = fmt::format("distances of {} points, {}", distances.size(), kind);
  result.data = std::move(distances);
  return result;
}

ReadResult result_of(Image image, std::string_view kind) {
  ReadResult result;
  result.description =
      image.dim() == 1
          ? fmt::format("signal of {} values, {}", image.extents[0], kind)
          : fmt::format("image of {} voxels, {}", fmt::join(image.extents, " x "), kind);
  result.data = std::move(image);
  return result;
}

ReadResult result_of(Mesh mesh, std::string_view kind) {
  ReadResult result;
  result.description =
      fmt::format("mesh of {} vertices and {} faces, {}", mesh.vertices.rows(), mesh.faces(), kind);
  result.data = std::move(mesh);
  return result;
}

ReadResult result_of(SparseDistances sparse, std::string_view kind) {
  ReadResult result;
  result.description =
      fmt::format("{} distances of {} points, {}", sparse.edges().size(), sparse.size(), kind);
  result.data = std::move(sparse);
  return result;
}

ReadResult result_of(BoundaryInput boundary, std::string_view kind) {
  ReadResult result;
  result.description = fmt::format("boundary matrix of {} cells, {}", boundary.matrix.size(), kind);
  result.data = std::move(boundary);
  return result;
}

ReadResult points_result(const Input& input, const ReadOptions& options) {
  const std::string_view first = input.text().substr(0, 4096);
  const char* kind = first.find(',') != std::string_view::npos ? "CSV" : "text";
  return result_of(read_points(input, options), kind);
}
ReadResult distance_result(const Input& input, const ReadOptions& options) {
  return result_of(read_distances(input, options), "square matrix");
}
ReadResult lower_result(const Input& input, const ReadOptions& options) {
  return result_of(read_lower_distances(input, options), "lower triangle");
}
ReadResult upper_result(const Input& input, const ReadOptions& options) {
  return result_of(read_upper_distances(input, options), "upper triangle");
}
ReadResult binary_result(const Input& input, const ReadOptions& options) {
  return result_of(read_binary_distances(input, options), "binary lower triangle");
}
ReadResult sparse_result(const Input& input, const ReadOptions& options) {
  return result_of(read_sparse(input, options), "sparse");
}
ReadResult dipha_result(const Input& input, const ReadOptions& options) {
  switch (detail::dipha_type(input)) {
    case detail::DiphaType::boundary_matrix:
      return result_of(detail::read_dipha_boundary(input, options), "DIPHA");
    case detail::DiphaType::image:
      return result_of(detail::read_dipha_image(input, options), "DIPHA");
    case detail::DiphaType::distance_matrix:
      return result_of(detail::read_dipha_distances(input, options), "DIPHA");
    case detail::DiphaType::sparse_distance_matrix:
      return result_of(detail::read_dipha_sparse(input, options), "DIPHA");
    case detail::DiphaType::diagram:
      break;
  }
  input.fail({"a persistence diagram", "DIPHA file type 2",
              "an image, a distance matrix or a boundary matrix", "it is a result, not an input"});
}
ReadResult pgm_result(const Input& input, const ReadOptions&) {
  return result_of(detail::read_pgm_image(input), "PGM");
}
ReadResult nifti_result(const Input& input, const ReadOptions& options) {
  return result_of(read_nifti(input, options), "NIfTI-1");
}
ReadResult raw_result(const Input& input, const ReadOptions& options) {
  if (!options.raw)
    throw Error(ErrorKind::usage, "format raw: expected the layout of the image, found none");
  return result_of(read_raw(input, *options.raw, options), "raw");
}
ReadResult perseus_result(const Input& input, const ReadOptions& options) {
  PerseusImage perseus = read_perseus(input, options);
  ReadResult result = result_of(std::move(perseus.image), "Perseus");
  if (std::count(perseus.periodic.begin(), perseus.periodic.end(), true) > 0) {
    result.description += ", periodic";
    result.periodic = std::move(perseus.periodic);
  }
  detail::note(options,
               "Perseus and GUDHI take the values as those of top cubes: --construction cells");
  return result;
}
ReadResult cloud_of(const Cloud& cloud, const Input& input, const ReadOptions& options,
                    std::string_view kind) {
  return result_of(detail::without_nan_rows(points_of(cloud), input, options, true), kind);
}
ReadResult xyz_result(const Input& input, const ReadOptions& options) {
  const ReadOptions inner{.allow_empty = true, .context = options.context, .note = options.note};
  return cloud_of(read_xyz(input, inner), input, options, "XYZ");
}
ReadResult pts_result(const Input& input, const ReadOptions& options) {
  const ReadOptions inner{.allow_empty = true, .context = options.context};
  return cloud_of(read_pts(input, inner), input, options, "PTS");
}
ReadResult grid_result(const Input& input, const ReadOptions& options) {
  return result_of(detail::read_grid(input, options), "text");
}
ReadResult npy_result(const Input& input, const ReadOptions& options) {
  const detail::ArrayGuess guess = detail::guess_array(input, options);
  if (!guess.note.empty()) detail::note(options, guess.note);
  if (guess.meaning == ArrayMeaning::image) detail::refuse_columns(options, "an image");
  if (guess.meaning == ArrayMeaning::distances) detail::refuse_columns(options, "distances, NPY");
  switch (guess.meaning) {
    case ArrayMeaning::points:
      return result_of(read_points(input, options), "NPY");
    case ArrayMeaning::distances:
      return result_of(read_distances(input, options), "NPY");
    default:
      break;
  }
  return result_of(read_npy_image(input, options), "NPY");
}
ReadResult npz_result(const Input& input, const ReadOptions& options) {
  const Input array = detail::read_npz_member(input);
  ReadResult result = npy_result(array, options);
  detail::note(options, "read as " + array.name());
  return result;
}
ReadResult png_result(const Input& input, const ReadOptions& options) {
  return result_of(detail::read_png_image(input, options), "PNG");
}
ReadResult phat_result(const Input& input, const ReadOptions& options) {
  BoundaryInput boundary = read_phat(input, options);
  const char* kind = boundary.binary ? "PHAT binary" : "PHAT ascii";
  return result_of(std::move(boundary), kind);
}
ReadResult simplices_result(const Input& input, const ReadOptions& options) {
  SimplicesInput simplices = read_simplices(input, options);
  ReadResult result;
  result.description = fmt::format("{} simplices", simplices.simplices.size());
  result.data = std::move(simplices);
  return result;
}
ReadResult off_result(const Input& input, const ReadOptions& options) {
  return result_of(read_off(input, options), "OFF");
}
ReadResult ply_result(const Input& input, const ReadOptions& options) {
  Mesh mesh = read_ply_mesh(input, options);
  if (mesh.faces() > 0) return result_of(std::move(mesh), "PLY");
  return result_of(detail::without_nan_rows(std::move(mesh.vertices), input, options, true), "PLY");
}
ReadResult pcd_result(const Input& input, const ReadOptions& options) {
  if (!detail::is_pcd(input)) {
    const std::string_view first = input.text().substr(0, input.text().find('\n'));
    input.fail({"not a PCD file", printable(first, 40), "a header with VERSION and FIELDS", {}});
  }
  return result_of(read_points(input, options), "PCD");
}

constexpr std::array kFormats{
    FormatInfo{Format::automatic, "auto", "by content and extension", "", nullptr},
    FormatInfo{Format::points, "points", "a point a line, numbers separated by blanks or commas",
               "0.5 1.25 -3e-2", &points_result},
    FormatInfo{Format::distance, "distance", "a square distance matrix, a row a line", "0 1.5 2",
               &distance_result},
    FormatInfo{Format::lower_distance, "lower-distance",
               "its lower triangle without the diagonal: 1, 2, 3, … numbers a line", "1.5 2",
               &lower_result},
    FormatInfo{Format::upper_distance, "upper-distance",
               "its upper triangle without the diagonal: n-1, …, 2, 1 numbers a line", "1.5 2",
               &upper_result},
    FormatInfo{Format::sparse, "sparse", "pairs of points with their distance: i j d, from 0",
               "0 1 1.5", &sparse_result},
    FormatInfo{Format::binary, "binary", "the lower triangle as float32, little endian", "",
               &binary_result},
    FormatInfo{Format::dipha, "dipha", "DIPHA: an image, distances or a weighted boundary matrix",
               "", &dipha_result},
    FormatInfo{Format::npy, "npy", "a NumPy array: an image, points or distances", "", &npy_result},
    FormatInfo{Format::pgm, "pgm", "a grey picture, P2 or P5, 8 or 16 bits", "P2 640 480 255",
               &pgm_result},
    FormatInfo{Format::png, "png", "a picture: grey, or one --channel of it", "", &png_result},
    FormatInfo{Format::perseus, "perseus",
               "a cubical complex as text: dimension, sizes, values; or a cube a line", "2",
               &perseus_result},
    FormatInfo{Format::nifti, "nifti", "a NIfTI-1 volume in one file", "", &nifti_result},
    FormatInfo{Format::phat, "phat",
               "a boundary matrix, ascii or binary: a cell a line, its "
               "dimension and facets",
               "1 0 1", &phat_result},
    FormatInfo{Format::simplices, "simplices", "a simplex with its value a line: v0 v1 … : value",
               "0 1 2 : 0.5", &simplices_result},
    FormatInfo{Format::off, "off", "a mesh in OFF", "OFF", &off_result},
    FormatInfo{Format::ply, "ply", "a mesh or cloud in PLY", "ply", &ply_result},
    FormatInfo{Format::pcd, "pcd", "a point cloud in PCD", "VERSION 0.7", &pcd_result},
    FormatInfo{Format::npz, "npz", "one array of a NumPy archive: FILE.npz or FILE.npz:NAME", "",
               &npz_result},
    FormatInfo{Format::xyz, "xyz", "a point cloud as text: x y z, then colours and others",
               "0.5 1.25 2 255 0 0", &xyz_result},
    FormatInfo{Format::pts, "pts", "the same behind a line with the number of points", "1024",
               &pts_result},
    FormatInfo{Format::grid, "grid", "an image as text: a row of pixels a line; or a signal",
               "0.5 1.25 2", &grid_result},
    FormatInfo{Format::raw, "raw", "the numbers of an image: --raw-shape, --raw-type, --raw-skip",
               "", &raw_result},
};

}  // namespace

std::span<const FormatInfo> formats() { return kFormats; }

const FormatInfo& format_info(Format format) {
  return *std::find_if(kFormats.begin(), kFormats.end(),
                       [format](const FormatInfo& info) { return info.format == format; });
}

std::optional<Format> format_from_name(std::string_view name) {
  for (const FormatInfo& info : kFormats) {
    if (info.name == name) return info.format;
  }
  return std::nullopt;
}

namespace {

// Whether it is an image that need not be in memory as a whole.
bool goes_by_blocks(const Input& input, Format format, const ReadOptions& options) {
  switch (format) {
    case Format::nifti:
    case Format::raw:
      return true;
    case Format::npy:
      return detail::guess_array(input, options).meaning == ArrayMeaning::image;
    case Format::dipha:
      return detail::dipha_type(input) == detail::DiphaType::image;
    default:
      return false;
  }
}

// The format of a text of numbers, by what the options say and, where they leave it open, by its
// rows.
Format format_of_text(const Input& input, const ReadOptions& options) {
  if (options.array == ArrayMeaning::image) {
    // Two to four numbers a row are coordinates as a rule, hardly ever a picture.
    const std::size_t width = detail::table_layout(input, options).columns.size();
    if (width >= 2 && width <= 4) return Format::points;
    if (width > 4) detail::note(options, "read as an image; --voxel X reads points");
    return Format::grid;
  }
  const detail::TextGuess guess = detail::guess_text(input, options);
  const bool is_table = guess.format == Format::points || guess.format == Format::distance;
  if (!is_table) return guess.format;
  if (const std::string_view option = detail::matrix_option(options); !option.empty()) {
    const bool is_square = guess.rows == guess.columns;
    // Points have no diagonal: --diagonal zero asks for nothing, births are refused with the
    // points.
    if (!is_square && option.starts_with("--diagonal")) return Format::points;
    if (guess.rows != 0 && !is_square) {
      input.fail({"not a square matrix",
                  guess.rows > guess.columns
                      ? fmt::format("rows of {} cells, and more of them", guess.columns)
                      : fmt::format("{} rows of {} cells", guess.rows, guess.columns),
                  fmt::format("as many rows as columns, for {}", option),
                  "is the file truncated, or a set of points?"});
    }
    return Format::distance;
  }
  if (options.array == ArrayMeaning::points) return Format::points;
  using detail::SquareKind;
  if (guess.columns == 1 && guess.rows > 1 && options.array == ArrayMeaning::automatic)
    detail::note(options, "a number a line: points of a line; --complex cubical reads a signal");
  const std::string size = fmt::format("{} x {} numbers", guess.rows, guess.columns);
  const char* const choices =
      "--format distance reads distances, --from-correlation correlations, --format points a point "
      "a row";
  if (guess.format == Format::distance) {
    detail::note(options,
                 "square with a zero diagonal: read as distances; --format points reads points");
  } else if (guess.rows > 2 && guess.square == SquareKind::correlations) {
    input.fail({"correlations or points",
                fmt::format("{}, symmetric, from -1 to 1 with ones on the diagonal", size),
                "an option that says which",
                "--from-correlation takes distances 1 - r, --format points a point a row"});
  } else if (guess.square == SquareKind::symmetric && guess.same_names) {
    input.fail({"distances, correlations or points",
                fmt::format("{}, rows and columns of the same names, no zero diagonal", size),
                "an option that says which", choices});
  } else if (guess.square != SquareKind::nothing && guess.square != SquareKind::zeros) {
    detail::note(options, fmt::format("{}, symmetric: read as points; {}", size, choices));
  }
  return guess.format;
}

// What an option says of an input that knows nothing of it.
void check_part(const Input& input, Format format, const ReadOptions& options) {
  const auto refuse = [&](std::string_view option, std::string_view meant_for) {
    throw Error(ErrorKind::usage, fmt::format("{}: makes sense for {} only, found {}", option,
                                              meant_for, format_info(format).name));
  };
  const bool is_table = format == Format::points || format == Format::distance ||
                        format == Format::grid || format == Format::npy || format == Format::npz;
  if (!options.columns.empty() && !is_table)
    refuse("--columns", "tables of numbers, as text or NPY");
  if (options.channel != Channel::automatic && format != Format::png)
    refuse("--channel", "PNG pictures");
  if (format == Format::ply && !input.member().empty()) {
    input.fail({"a property of a mesh", printable(input.member(), 40), "the mesh itself",
                "--values FILE.ply:NAME takes one"});
  }
}

}  // namespace

ReadResult read_any(const Input& input, Format format, const ReadOptions& options,
                    const std::filesystem::path& values_path) {
  std::vector<std::string> notes;
  std::vector<Index> dropped;
  ReadOptions inner = options;
  inner.note = [&](std::string text) {
    notes.push_back(text);
    if (options.note) options.note(std::move(text));
  };
  inner.dropped = &dropped;
  if (format == Format::automatic) {
    const auto known = detail::format_by_content(input);
    format = known ? *known : format_of_text(input, inner);
  }
  check_part(input, format, options);
  const FormatInfo& info = format_info(format);
  if (info.read == nullptr) {
    throw Error(ErrorKind::not_built_in,
                fmt::format("{}: format {} is not built in", input.name(), info.name));
  }
  if (!goes_by_blocks(input, format, inner)) input.take_memory();
  ReadResult result = info.read(input, inner);
  result.format = format;
  result.notes = std::move(notes);
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
    input.fail({"no points", {}, "at least one", "--allow-empty accepts an empty set"});
  }
  if (values_path.empty()) return result;

  const auto values_for = [&](std::size_t count, std::string_view owner) {
    return read_values(Input::open(values_path, options.context), count, options, owner);
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
                fmt::format("--values: format {} takes no separate values", info.name));
  }
  return result;
}

ReadResult read_any(const std::filesystem::path& path, Format format, const ReadOptions& options,
                    const std::filesystem::path& values_path) {
  return read_any(Input::open(path, options.context, Input::Excess::stays_in_file), format, options,
                  values_path);
}

}  // namespace ph

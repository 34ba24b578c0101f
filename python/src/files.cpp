// SPDX-License-Identifier: MIT
// This file reads and writes files of data and of barcodes.
#include <algorithm>
#include <array>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ph/detail/io/output_file.hpp"
#include "ph/io/read.hpp"
#include "ph/io/write.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/calls/words.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/results/bars.hpp"
#include "python/src/results/origin.hpp"

namespace ph::python {
namespace {

/// The data that were read, as arrays and plain values.
class Answer {
 public:
  explicit Answer(SharedContext context) : context_(std::move(context)) {}

  py::dict operator()(Points& points) const {
    return of("points", {{"points", py::cast(Block::of(std::move(points)))}});
  }
  /// Returns the square matrix, with both of its triangles, and with births on the diagonal.
  py::dict operator()(DistanceMatrix& distances) const {
    const Index n = distances.size();
    std::vector<double> square;
    square.reserve(static_cast<std::size_t>(n * n));
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j)
        square.push_back(i == j && !distances.births().empty()
                             ? distances.births()[static_cast<std::size_t>(i)]
                             : distances(i, j));
    return of("distances", {{"distances", py::cast(Block::of(std::move(square), {n, n}))}});
  }
  py::dict operator()(SparseDistances& distances) const {
    std::vector<std::int64_t> i, j;
    std::vector<double> values;
    for (const WeightedEdge& edge : distances.edges()) {
      i.push_back(edge.u);
      j.push_back(edge.v);
      values.push_back(edge.value);
    }
    return of("sparse", {{"size", py::cast(distances.size())},
                         {"i", py::cast(Block::of(std::move(i)))},
                         {"j", py::cast(Block::of(std::move(j)))},
                         {"values", py::cast(Block::of(std::move(values)))}});
  }
  py::dict operator()(Image& image) const {
    return of("image", {{"image", py::cast(Block::of(image, context_))}});
  }
  py::dict operator()(SimplicesInput& input) const {
    SimplexList& list = input.simplices;
    const bool has_own = input.vertex_values.empty();
    return of("simplices",
              {{"vertices", py::cast(Block::of(std::move(list.vertices)))},
               {"offsets", py::cast(offsets_of(list.offsets))},
               {"values", py::cast(Block::of(has_own ? std::move(list.values)
                                                     : std::move(input.vertex_values)))},
               {"are_of_vertices", py::cast(!has_own)}});
  }
  py::dict operator()(BoundaryInput& input) const {
    BoundaryMatrix& matrix = input.matrix;
    if (matrix.incidences.empty()) matrix.incidences.assign(matrix.rows.size(), 1);
    const bool has_values = !matrix.values.empty();
    return of("boundary", {{"dims", py::cast(Block::of(std::move(matrix.dims)))},
                           {"offsets", py::cast(offsets_of(matrix.offsets))},
                           {"rows", py::cast(Block::of(std::move(matrix.rows)))},
                           {"incidences", py::cast(Block::of(std::move(matrix.incidences)))},
                           {"values", has_values ? py::cast(Block::of(std::move(matrix.values)))
                                                 : py::none()}});
  }
  py::dict operator()(Mesh& mesh) const {
    const bool has_values = !mesh.values.empty();
    return of("mesh",
              {{"vertices", py::cast(Block::of(std::move(mesh.vertices)))},
               {"corners", py::cast(Block::of(std::move(mesh.corners)))},
               {"offsets", py::cast(offsets_of(mesh.offsets))},
               {"values", has_values ? py::cast(Block::of(std::move(mesh.values))) : py::none()}});
  }

 private:
  static py::dict of(const char* kind,
                     std::initializer_list<std::pair<const char*, py::object>> members) {
    py::dict answer;
    answer["kind"] = kind;
    for (const auto& [name, value] : members) answer[name] = value;
    return answer;
  }
  static Block offsets_of(const std::vector<std::size_t>& offsets) {
    return Block::of(std::vector<std::int64_t>(offsets.begin(), offsets.end()));
  }

  SharedContext context_;
};

ReadOptions read_options_of(const py::dict& given) {
  ReadOptions options;
  options.allow_empty = true;
  options.symmetrise = given["symmetrise"].cast<Symmetrise>();
  options.from_correlation = given["from_correlation"].cast<bool>();
  options.diagonal = given["diagonal"].cast<Diagonal>();
  options.nan = given["nan"].cast<NanPolicy>();
  options.array = given["array"].cast<ArrayMeaning>();
  options.columns = given["columns"].cast<std::vector<std::string>>();
  options.channel = given["channel"].cast<Channel>();
  options.weld = given["weld"].cast<bool>();
  options.stack = given["stack"].cast<bool>();
  if (!given["raw_shape"].is_none() || !given["raw_points"].is_none()) {
    RawLayout layout;
    if (!given["raw_shape"].is_none())
      layout.extents = given["raw_shape"].cast<std::vector<Index>>();
    if (!given["raw_points"].is_none()) layout.coordinates = given["raw_points"].cast<Index>();
    layout.type = given["raw_type"].cast<std::string>();
    layout.big_endian = given["raw_big_endian"].cast<bool>();
    layout.skip = given["raw_skip"].cast<std::size_t>();
    options.raw = std::move(layout);
  }
  return options;
}

py::dict read(const std::string& path, const std::string& format_name,
              const std::string& values_path, const py::dict& given, const RunOptions& options) {
  ReadOptions how = read_options_of(given);
  const std::optional<Format> format = format_from_name(format_name);
  if (!format)
    throw Error(ErrorKind::usage,
                "format: found '" + format_name + "', expected one of format_names()");
  std::vector<Index> dropped;
  how.dropped = &dropped;
  SharedContext used;  // the data that were read also use this context
  ReadResult result;
  run_task(options, false, [&](const SharedContext& context) {
    used = context;
    how.context = context.get();
    result =
        read_any(std::filesystem::path(path), *format, how, std::filesystem::path(values_path));
  });
  py::dict answer = std::visit(Answer(used), result.data);
  answer["description"] = result.description;
  std::vector<std::string> notes, guesses;
  for (const Message& note : result.notes)
    (note.is_guess() ? guesses : notes).push_back(note.in_words(kWords));
  answer["notes"] = notes;
  answer["guesses"] = guesses;
  answer["dropped"] = dropped;
  answer["periodic"] = result.periodic;
  answer["affine"] = result.affine;
  return answer;
}

void save(const Bars& bars, const std::string& path, const std::optional<std::string>& format_name,
          const py::dict& meta, const RunOptions& options) {
  const auto format =
      format_name ? barcode_format_named(*format_name) : barcode_format_of_path(path);
  if (!format || *format == BarcodeFormat::none)
    throw Error(ErrorKind::usage,
                "format: found " +
                    (format_name ? "'" + *format_name + "'" : "none for '" + path + "'") +
                    ", expected csv, json, ripser, pers, dipha or npy");
  const BarcodeInfo info = info_of(meta);
  run_task(options, false, [&](const SharedContext&) {
    OutputFile file(path);
    write_barcode(file, bars.barcode, *format,
                  {.loops = bars.loops, .p_values = bars.p_values, .info = &info});
    file.commit();
  });
}

py::tuple read_bars(const std::string& path, const std::optional<std::string>& format_name,
                    const RunOptions& options) {
  const auto format = format_name ? barcode_format_named(*format_name) : std::nullopt;
  if (format_name && !format)
    throw Error(ErrorKind::usage, "format: found '" + *format_name +
                                      "', expected csv, json, ripser, pers, dipha or npy");
  StoredBarcode stored = run(options, false, [&](const RunContext& context) {
    return read_stored_barcode(Input::open(std::filesystem::path(path), &context,
                                           Input::Excess::refused, barcode_start_check(format)),
                               format);
  });
  const BarcodeInfo& info = stored.bars.info();
  const py::dict meta = meta_of(info);
  const std::int64_t field = info.field;
  return py::make_tuple(
      Bars{std::move(stored.bars), std::move(stored.loops), field, std::move(stored.p_values)},
      meta, stored.left_out);
}

}  // namespace

void bind_files(py::module_& m) {
  m.def("format_names", [] {
    std::vector<std::string> names{"auto"};
    for (const FormatInfo& format : formats())
      if (format.read != nullptr) names.emplace_back(format.name);
    return names;
  });
  m.def("read", &read, py::arg("path"), py::arg("format"), py::arg("values_path"),
        py::arg("options"), py::arg("run"));
  m.def("save", &save, py::arg("bars"), py::arg("path"), py::arg("format"), py::arg("meta"),
        py::arg("run"));
  m.def("read_barcode", &read_bars, py::arg("path"), py::arg("format"), py::arg("run"));
}

}  // namespace ph::python

// SPDX-License-Identifier: MIT
#include "apps/vectorise/data/samples.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

#include "apps/common/inputs/barcode_files.hpp"
#include "apps/vectorise/arguments/scopes.hpp"
#include "ph/io/write.hpp"

namespace ph::vectorise {
namespace {

constexpr std::array<std::string_view, 12> kImages{".png", ".pgm",  ".tif",  ".tiff",
                                                   ".nii", ".nrrd", ".nhdr", ".mha",
                                                   ".mhd", ".vti",  ".npz",  ".grid"};

Cubical read_cubical(const Input& input, CubicalOptions cubical, const Arguments& arguments,
                     app::Session& session) {
  ReadOptions options;
  options.context = &session.context();
  options.nan = arguments.nan;
  options.array = ArrayMeaning::image;
  ReadResult read = read_any(input, Format::automatic, options);
  const Image* image = std::get_if<Image>(&read.data);
  if (image == nullptr)
    throw Error(ErrorKind::bad_data, fmt::format("{}: found {}, expected a barcode or an image",
                                                 input.name(), read.description));
  for (const Message& note : read.notes)
    session.note(fmt::format("{}: {}", input.name(), note.marked()));
  // The rows of a barcode in NPY consist of dim, birth and death, but the file does not name these
  // columns.
  const bool may_be_bars = (read.format == Format::npy || read.format == Format::npz) &&
                           image->extents.size() == 2 && image->extents[1] == 3;
  if (arguments.format == InputKind::automatic && may_be_bars)
    session.note(
        fmt::format("{}: {} x 3 array: read as an image; --format barcode reads one bar per row",
                    input.name(), image->extents[0]));
  if (cubical.periodic.empty()) cubical.periodic = read.periodic;
  if (cubical.periodic.size() > image->extents.size() &&
      cubical.periodic == std::vector<bool>(Cubical::kMaxDim, true))
    cubical.periodic.resize(image->extents.size());  // all axes
  return Cubical(*image, cubical, session.context());
}

}  // namespace

std::vector<std::string> files_of(const Arguments& arguments, Kind kind) {
  return app::barcode_files(arguments.inputs, kind == Kind::euler
                                                  ? std::span<const std::string_view>(kImages)
                                                  : std::span<const std::string_view>());
}

Sample read_sample(const std::string& path, const CubicalOptions& cubical,
                   const Arguments& arguments, app::Session& session) {
  const Input input = app::open_input(path, session, Input::Excess::stays_in_file);
  const bool is_image = arguments.format == InputKind::image ||
                        (arguments.format == InputKind::automatic && !is_barcode(input));
  app::require_in_scope(
      arguments.given, is_image ? kOfImage : kOfBarcode,
      fmt::format("{} {}", input.name(), is_image ? "(an image)" : "(a barcode)"));
  if (is_image) return read_cubical(input, cubical, arguments, session);
  return read_barcode(input);
}

}  // namespace ph::vectorise

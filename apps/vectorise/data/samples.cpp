// SPDX-License-Identifier: MIT
#include "vectorise/data/samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/files/batch_names.hpp"
#include "ph/io/write.hpp"
#include "vectorise/arguments/option_scopes.hpp"

namespace ph::vectorise {
namespace {

constexpr std::array<std::string_view, 7> kBarcodes{".csv",   ".json",    ".ripser", ".pers",
                                                    ".dipha", ".diagram", ".npy"};
constexpr std::array<std::string_view, 5> kImages{".png", ".pgm", ".nii", ".npz", ".grid"};

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
  for (const std::string& note : read.notes)
    session.note(fmt::format("{}: {}", input.name(), note));
  if (cubical.periodic.empty()) cubical.periodic = read.periodic;
  if (cubical.periodic.size() > image->extents.size() &&
      cubical.periodic == std::vector<bool>(Cubical::kMaxDim, true))
    cubical.periodic.resize(image->extents.size());  // all
  return Cubical(*image, cubical, session.context());
}

}  // namespace

std::vector<std::string> files_of(const Arguments& arguments, Kind kind) {
  std::vector<std::string> extensions(kBarcodes.begin(), kBarcodes.end());
  if (kind == Kind::euler) extensions.insert(extensions.end(), kImages.begin(), kImages.end());
  const std::size_t plain = extensions.size();
  for (std::size_t i = 0; i < plain; ++i) extensions.push_back(extensions[i] + ".gz");
  const std::vector<std::string_view> views(extensions.begin(), extensions.end());
  std::vector<std::string> files;
  for (const std::string& input : arguments.inputs) {
    if (!app::is_folder(input)) {
      files.push_back(input);
      continue;
    }
    for (std::string& file : app::files_in(input, views, "a file of a known format"))
      files.push_back(std::move(file));
  }
  return files;
}

Sample read_sample(const std::string& path, Kind kind, const CubicalOptions& cubical,
                   const Arguments& arguments, app::Session& session) {
  std::optional<app::BarHold> somebody_types;
  if (app::is_typed({path})) somebody_types.emplace(session);
  const Input input =
      Input::open(path, &session.context(),
                  kind == Kind::euler ? Input::Excess::stays_in_file : Input::Excess::refused);
  const bool is_image =
      kind == Kind::euler && (arguments.format == InputKind::image ||
                              (arguments.format == InputKind::automatic && !is_barcode(input)));
  if (kind == Kind::euler)
    app::require_in_scope(
        arguments.given, is_image ? kOfImage : kOfBarcode,
        fmt::format("{} {}", input.name(), is_image ? "(an image)" : "(a barcode)"));
  if (is_image) return read_cubical(input, cubical, arguments, session);
  return read_barcode(input);
}

}  // namespace ph::vectorise

// SPDX-License-Identifier: MIT
#include "apps/barcode/batch.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "apps/common/files/batch_names.hpp"
#include "apps/common/files/file_identity.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/io/further_files.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph::barcode {
namespace {

// The formats that ph-barcode reads, compressed or not. A folder may also contain other files.
constexpr std::array<std::string_view, 33> kExtensions{
    ".csv",       ".tsv",    ".txt", ".dat",     ".xyz", ".xyzrgb", ".pts",     ".npy",  ".npz",
    ".png",       ".pgm",    ".tif", ".tiff",    ".nii", ".nrrd",   ".nhdr",    ".mha",  ".mhd",
    ".vti",       ".off",    ".ply", ".pcd",     ".bin", ".dipha",  ".complex", ".phat", ".coo",
    ".simplices", ".sparse", ".cub", ".perseus", ".raw", ".json"};
constexpr std::array<std::string_view, 9> kBarcodeExtensions{
    ".csv", ".json", ".txt", ".ripser", ".pers", ".dipha", ".diagram", ".npy", ".dat"};

std::vector<std::string> with_files_of_folders(const Job& job) {
  std::vector<std::string_view> extensions;
  if (job.stored)
    extensions.assign(kBarcodeExtensions.begin(), kBarcodeExtensions.end());
  else
    extensions.assign(kExtensions.begin(), kExtensions.end());
  std::vector<std::string> packed;
  for (const std::string_view extension : extensions)
    packed.push_back(std::string(extension) + ".gz");
  extensions.insert(extensions.end(), packed.begin(), packed.end());
  std::vector<std::string> inputs;
  for (const std::string& input : job.inputs) {
    if (!job.is_folder_of_inputs(input)) {
      inputs.push_back(input);
      continue;
    }
    for (std::string& file : app::files_in(input, extensions, "a file of a known format"))
      inputs.push_back(std::move(file));
  }
  return inputs;
}

}  // namespace

std::vector<std::string> inputs_of_batch(const Job& job, app::Session& session) {
  const std::vector<std::string> files = with_files_of_folders(job);
  app::InputFiles data;
  for (const std::string& file : files) {
    app::InputFiles header;
    header.add(file, Format::raw);  // without the files that it names
    for (const auto& named : detail::further_files(files::path_of(file), job.reading.format))
      if (header.replaced_by(named.string()) == nullptr) data.add(named.string(), Format::raw);
  }
  std::vector<std::string> inputs;
  for (const std::string& file : files) {
    if (file == "-" || data.replaced_by(file) == nullptr) {
      inputs.push_back(file);
    } else {
      session.note(
          fmt::format("{}: not an input of its own, because a header among the inputs "
                      "names it as its data file",
                      printable(file)));
    }
  }
  return inputs;
}

}  // namespace ph::barcode

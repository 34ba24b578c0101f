// SPDX-License-Identifier: MIT
#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {

Image read_image(const Input& input, const ReadOptions& options) {
  if (options.stack) return detail::read_stack(input, Format::automatic, options).image;
  if (detail::is_png(input) || detail::is_pgm(input) || detail::is_npz(input)) input.take_memory();
  if (detail::is_png(input)) return detail::read_png_image(input, options);
  if (detail::is_pgm(input)) return detail::read_pgm_image(input);
  if (detail::is_dipha(input)) return detail::read_dipha_image(input, options);
  if (detail::is_nifti(input)) return read_nifti(input, options);
  if (detail::is_tiff(input)) return detail::read_tiff_image(input, options);
  if (detail::is_nrrd(input)) return detail::read_nrrd(input, options).image;
  if (detail::is_meta_image(input)) return detail::read_meta_image(input, options).image;
  if (detail::is_vti(input)) return detail::read_vti(input, options).image;
  return read_npy_image(input, options);
}

Image read_image(const std::filesystem::path& path, const ReadOptions& options) {
  if (options.stack) return read_image(Input::of_folder(path, options.context), options);
  return read_image(
      Input::open(path, options.context, Input::Excess::stays_in_file, detail::start_check()),
      options);
}

}  // namespace ph

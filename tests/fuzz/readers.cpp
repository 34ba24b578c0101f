// SPDX-License-Identifier: MIT
#include "tests/fuzz/readers.hpp"

#include <algorithm>
#include <array>

#include "libph/src/io/bytes/readers.hpp"
#include "tests/fuzz/heap_meter.hpp"
#include "tests/fuzz/round_trip.hpp"
#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

/// Calls a function with an input and options, and measures the memory that the call takes.
template <auto read>
Content read_with(const Input& input, const ReadOptions& options) {
  const auto metered = [&] {
    const HeapMeter meter;
    return read(input, options);
  };
  return content_of(metered());
}

template <Format format>
ReadResult of_format(const Input& input, const ReadOptions& options) {
  return read_any(input, format, options);
}

template <ArrayMeaning meaning>
ReadResult of_array(const Input& input, ReadOptions options) {
  options.array = meaning;
  return read_any(input, Format::npy, options);
}

DistanceMatrix correlations(const Input& input, ReadOptions options) {
  options.from_correlation = true;
  return read_distances(input, options);
}

Barcode barcode(const Input& input, const ReadOptions&) { return read_barcode(input); }
template <BarcodeFormat format>
Barcode barcode_of(const Input& input, const ReadOptions&) {
  return read_barcode(input, format);
}

/// Reads a volume, whose places are not checked here.
template <auto read>
Image volume(const Input& input, const ReadOptions& options) {
  return read(input, options).image;
}

/// Reads a raw file with a fixed layout. The input must have exactly the size of this layout.
Image raw(const Input& input, const ReadOptions& options) {
  return read_raw(input, {.extents = {2, 3}, .type = "i2", .skip = 4}, options);
}

/// Reads a raw file with a fixed number of numbers per point.
Points raw_points(const Input& input, const ReadOptions& options) {
  return read_raw_points(input, {.type = "f4", .skip = 4, .coordinates = 3}, options);
}

/// Reads a mesh whose vertices at one position are joined.
ReadResult welded(const Input& input, ReadOptions options) {
  options.weld = true;
  return read_any(input, Format::off, options);
}

Raster png(const Input& input, const ReadOptions&) { return read_png(input); }

segment::SceneTree tree(const Input& input, const ReadOptions&) {
  return segment::read_tree(input);
}

/// The number of values that the caller of the reader expects in a file of values.
constexpr std::size_t kValues = 6;
std::vector<double> values(const Input& input, const ReadOptions& options) {
  return read_values(input, kValues, options);
}

/// All numbers of a camera. If the lens has a ray at one fixed place in the picture, also this ray.
std::vector<double> camera(const Input& input, const ReadOptions&) {
  const Camera c = read_camera(input);
  std::vector<double> numbers{c.intrinsics.fx,
                              c.intrinsics.fy,
                              c.intrinsics.cx,
                              c.intrinsics.cy,
                              static_cast<double>(c.width),
                              static_cast<double>(c.height)};
  numbers.insert(numbers.end(), c.lens.coefficients.begin(), c.lens.coefficients.end());
  if (const auto ray = c.lens.straightened(0.25, 0.25, c.lens.reach()))
    numbers.insert(numbers.end(), ray->begin(), ray->end());
  return numbers;
}

Image depth(const Input& input, const ReadOptions& options) {
  return read_depth(input, options).depth;
}

template <auto read>
void rewrite_with(const Input& input, const ReadOptions& options) {
  write_and_read_again(read(input, options));
}

template <auto read>
constexpr NamedReader reader(std::string_view name, std::string_view extension) {
  return {name, extension, &read_with<read>, &rewrite_with<read>};
}

/// The type of the overload that takes an open input.
template <class T>
using Reads = T (*)(const Input&, const ReadOptions&);

constexpr std::array kReaders{
    reader<&of_format<Format::automatic>>("any", ""),
    reader<Reads<Points>(&read_points)>("points", ".csv"),
    reader<Reads<DistanceMatrix>(&read_distances)>("distances", ".csv"),
    reader<&correlations>("correlations", ".csv"),
    reader<Reads<DistanceMatrix>(&read_lower_distances)>("lower_distances", ".txt"),
    reader<Reads<DistanceMatrix>(&read_upper_distances)>("upper_distances", ".txt"),
    reader<Reads<DistanceMatrix>(&read_binary_distances)>("binary_distances", ".bin"),
    reader<Reads<SparseDistances>(&read_sparse)>("sparse", ".sparse"),
    reader<Reads<Image>(&read_image)>("image", ""),
    reader<&read_npy_image>("npy_image", ".npy"),
    reader<&of_array<ArrayMeaning::points>>("npy_points", ".npy"),
    reader<&of_array<ArrayMeaning::distances>>("npy_distances", ".npy"),
    reader<&of_format<Format::npz>>("npz", ".npz"),
    reader<&of_format<Format::pgm>>("pgm", ".pgm"),
    reader<&of_format<Format::dipha>>("dipha", ".dipha"),
    reader<Reads<Image>(&read_nifti)>("nifti", ".nii"),
    reader<&detail::read_tiff_image>("tiff", ".tif"),
    reader<&volume<&detail::read_nrrd>>("nrrd", ".nrrd"),
    reader<&volume<&detail::read_meta_image>>("metaimage", ".mha"),
    reader<&volume<&detail::read_vti>>("vti", ".vti"),
    reader<&raw>("raw", ".raw"),
    reader<&raw_points>("raw_points", ".bin"),
    reader<Reads<PerseusImage>(&read_perseus)>("perseus", ".perseus"),
    reader<Reads<SimplicesInput>(&read_simplices)>("simplices", ".simplices"),
    reader<Reads<BoundaryInput>(&read_phat)>("phat", ".phat"),
    reader<&values>("values", ".txt"),
    reader<Reads<Mesh>(&read_off)>("off", ".off"),
    reader<&welded>("welded", ".off"),
    reader<Reads<Mesh>(&read_ply_mesh)>("ply_mesh", ".ply"),
    reader<&png>("png", ".png"),
    reader<&camera>("camera", ".yaml"),
    reader<&depth>("depth", ""),
    reader<&read_npy_cloud>("npy_cloud", ".npy"),
    reader<Reads<Cloud>(&read_cloud)>("cloud", ""),
    reader<&read_pcd>("pcd", ".pcd"),
    reader<&of_format<Format::pcd>>("pcd_points", ".pcd"),
    reader<&read_ply>("ply", ".ply"),
    reader<&read_xyz>("xyz", ".xyz"),
    reader<&of_format<Format::xyz>>("xyz_points", ".xyz"),
    reader<&read_pts>("pts", ".pts"),
    reader<&of_format<Format::pts>>("pts_points", ".pts"),
    reader<&tree>("tree", ".tree"),
    reader<&barcode>("barcode", ""),
    reader<&barcode_of<BarcodeFormat::csv>>("barcode_csv", ".csv"),
    reader<&barcode_of<BarcodeFormat::json>>("barcode_json", ".json"),
    reader<&barcode_of<BarcodeFormat::ripser>>("barcode_ripser", ".ripser"),
    reader<&barcode_of<BarcodeFormat::pers>>("barcode_pers", ".pers"),
    reader<&barcode_of<BarcodeFormat::dipha>>("barcode_dipha", ".dipha"),
    reader<&barcode_of<BarcodeFormat::npy>>("barcode_npy", ".npy"),
};

}  // namespace

std::span<const NamedReader> readers() { return kReaders; }

const NamedReader* find_reader(std::string_view name) {
  const auto found = std::find_if(kReaders.begin(), kReaders.end(),
                                  [name](const NamedReader& r) { return r.name == name; });
  return found == kReaders.end() ? nullptr : &*found;
}

}  // namespace ph::fuzz

// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <concepts>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/tables/array.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

constexpr std::size_t kHeaderSize = 348;
// The least offset of the voxels, which come after the header and four bytes for extensions.
constexpr std::size_t kFirstVoxel = 352;
constexpr std::int32_t kNifti2Size = 540;

// The offsets of the fields in the header.
constexpr std::size_t kDim = 40, kDatatype = 70, kBitpix = 72, kSizes = 76, kOffset = 108,
                      kSlope = 112, kIntercept = 116, kQformCode = 252, kSformCode = 254,
                      kQuaternion = 256, kShift = 268, kRows = 280, kMagic = 344;

struct Datatype {
  std::int16_t code;
  const char* kind;  // the name of the type, as for detail::element_type
};
constexpr Datatype kDatatypes[] = {{2, "u1"},    {4, "i2"},   {8, "i4"},   {16, "f4"},
                                   {64, "f8"},   {256, "i1"}, {512, "u2"}, {768, "u4"},
                                   {1024, "i8"}, {1280, "u8"}};

class Header {
 public:
  explicit Header(const Input& input) : input_(input) {
    if (input.size() < kHeaderSize) {
      input.fail_at_byte(input.size(), {"truncated in the NIfTI header",
                                        fmt::format("{} bytes", input.size()),
                                        fmt::format("{}", kHeaderSize),
                                        {}});
    }
    const auto little = load<std::int32_t>(input.bytes().data(), std::endian::little);
    const auto big = load<std::int32_t>(input.bytes().data(), std::endian::big);
    if (little == kNifti2Size || big == kNifti2Size) {
      input.fail_at_byte(
          0, {"NIfTI version", "2", "NIfTI-1, a header of 348 bytes", "convert it to NIfTI-1"});
    }
    if (little != kHeaderSize && big != kHeaderSize) {
      input.fail_at_byte(0,
                         {"not a NIfTI-1 file", fmt::format("header size {}", little), "348", {}});
    }
    order_ = little == kHeaderSize ? std::endian::little : std::endian::big;
    const std::string_view magic = input.text().substr(kMagic, 4);
    if (magic == std::string_view("ni1\0", 4)) {
      input.fail_at_byte(kMagic, {"a NIfTI pair", "a .hdr or .img file", "a single .nii file",
                                  "convert the pair of files to one .nii"});
    }
    if (magic != std::string_view("n+1\0", 4)) {
      input.fail_at_byte(kMagic, {"NIfTI magic", '"' + printable(magic) + '"', "\"n+1\\x00\"",
                                  "is it an ANALYZE 7.5 file?"});
    }
  }

  template <class T>
  T field(std::size_t at) const {
    return load<T>(input_.bytes().data() + at, order_);
  }
  std::endian order() const { return order_; }

  std::vector<Index> extents() const {
    const auto axes = field<std::int16_t>(kDim);
    if (axes < 1 || axes > 7) {
      input_.fail_at_byte(kDim, {"number of axes", fmt::format("{}", axes), "1 to 7", {}});
    }
    std::vector<Index> extents;
    for (std::size_t axis = 1; axis <= static_cast<std::size_t>(axes); ++axis) {
      const auto extent = field<std::int16_t>(kDim + 2 * axis);
      if (extent < 1) {
        input_.fail_at_byte(kDim + 2 * axis, {fmt::format("size of axis {}", axis - 1),
                                              fmt::format("{}", extent),
                                              "1 to 32767",
                                              {}});
      }
      extents.push_back(extent);
    }
    while (extents.size() > 1 && extents.back() == 1) extents.pop_back();
    return extents;
  }

  detail::ElementType type() const {
    const auto code = field<std::int16_t>(kDatatype);
    for (const Datatype& known : kDatatypes) {
      if (known.code != code) continue;
      const detail::ElementType type = *detail::element_type(known.kind);
      const auto bits = field<std::int16_t>(kBitpix);
      if (bits != static_cast<int>(8 * type.size)) {
        input_.fail_at_byte(kBitpix, {"bits of a voxel",
                                      fmt::format("{}", bits),
                                      fmt::format("{} for datatype {}", 8 * type.size, code),
                                      {}});
      }
      return type;
    }
    input_.fail_at_byte(kDatatype, {"NIfTI datatype", fmt::format("{}", code),
                                    "integers or floats of at most 8 bytes: 2, 4, 8, 16, 64, 256, "
                                    "512, 768, 1024 or 1280",
                                    code == 32 || code == 128 || code == 2304
                                        ? "colours and complex numbers are not filtration values"
                                        : ""});
  }

  /// The places of the voxels: method 3 of the standard if the file has it, else method 2, else
  /// method 1, which knows only the sizes of the voxels. Empty if a number is not usable.
  std::optional<Affine> affine() const {
    const auto numbers = [this](std::size_t at, std::size_t k) {
      return double{field<float>(at + 4 * k)};
    };
    Affine affine{};
    if (field<std::int16_t>(kSformCode) > 0) {
      for (std::size_t i = 0; i < 12; ++i) affine[i / 4][i % 4] = numbers(kRows, i);
    } else {
      const bool is_turned = field<std::int16_t>(kQformCode) > 0;
      const double b = is_turned ? numbers(kQuaternion, 0) : 0,
                   c = is_turned ? numbers(kQuaternion, 1) : 0,
                   d = is_turned ? numbers(kQuaternion, 2) : 0;
      const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
      const Affine turn{
          {{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c), 0},
           {2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b), 0},
           {2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c, 0}}};
      const double handedness = is_turned && numbers(kSizes, 0) < 0 ? -1 : 1;
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) {
          const double size = numbers(kSizes, k + 1);
          // The size of an axis that the image does not have may be 0.
          affine[r][k] = turn[r][k] * (size == 0 ? 1 : std::abs(size)) * (k == 2 ? handedness : 1);
        }
        affine[r][3] = is_turned ? numbers(kShift, r) : 0;
      }
    }
    for (const auto& row : affine)
      for (const double number : row)
        if (!std::isfinite(number)) return std::nullopt;
    return affine;
  }

  std::size_t first_voxel() const {
    const auto offset = field<float>(kOffset);
    const bool whole = offset == std::floor(offset);  // false for NaN
    if (!whole || offset < static_cast<float>(kFirstVoxel) ||
        offset > static_cast<float>(input_.size())) {
      input_.fail_at_byte(
          kOffset, {"offset of the voxels",
                    fmt::format("{}", offset),
                    input_.size() < kFirstVoxel
                        ? "a file of at least 352 bytes; is it truncated?"
                        : fmt::format("{} to {}, the size of the file", kFirstVoxel, input_.size()),
                    {}});
    }
    return static_cast<std::size_t>(offset);
  }

 private:
  const Input& input_;
  std::endian order_ = std::endian::little;
};

// Stored numbers become slope * number + intercept. A slope of 0 means unscaled numbers. Some
// programs write NaN instead of 0.
void scale(Image& image, const Header& header, const Input& input, const ReadOptions& options) {
  const double slope = double{header.field<float>(kSlope)};
  const double intercept = double{header.field<float>(kIntercept)};
  if (slope == 0 || std::isnan(slope) || (slope == 1 && intercept == 0)) return;
  if (std::isinf(slope) || !std::isfinite(intercept)) {
    input.fail_at_byte(
        kSlope,
        {"scale of the values", fmt::format("{} and {}", slope, intercept), "finite numbers", {}});
  }
  Voxels stored = std::move(image.values);
  const std::size_t count = stored.size();
  const bool in_file = detail::stays_in_file(input, count * sizeof(double));
  // The number of values between two polls of the stop token.
  constexpr std::size_t block = 1 << 20;
  const auto scale_into = [&](const auto* from, double* to) {
    for (std::size_t k = 0; k < count;) {
      input.poll(input.size());
      const std::size_t begin = k;
      for (const std::size_t end = std::min(count, k + block); k < end; ++k)
        to[k] = static_cast<double>(from[k]) * slope + intercept + 0.0;
      if (stored.is_in_file()) forget_file_pages(from + begin, (k - begin) * sizeof(*from));
      if (in_file) forget_file_pages(to + begin, (k - begin) * sizeof(double));
    }
  };
  image.values = with_voxels(stored.type(), stored.data(), [&]<class T>(const T* from) {
    if (in_file) {
      return detail::voxels_in_file<double>(
          VoxelType::float64, count, [&](std::span<double> to) { scale_into(from, to.data()); });
    }
    if constexpr (std::same_as<T, double>) {
      stored.change([&](auto& numbers) {
        if constexpr (std::same_as<decltype(numbers), std::vector<double>&>)
          scale_into(numbers.data(), numbers.data());
      });
      return stored;
    }
    // The stored numbers and the scaled numbers exist at the same time, and the stored numbers are
    // not counted in any budget.
    input.require_memory(count * (sizeof(T) + sizeof(double)));
    std::vector<double> scaled(count);
    scale_into(from, scaled.data());
    return Voxels(std::move(scaled));
  });
  detail::note(options, fmt::format("values are scaled: {} times the stored value plus {}", slope,
                                    intercept));
}

}  // namespace

namespace detail {

bool is_nifti(const Input& input) {
  if (input.size() < kHeaderSize) return false;
  const std::string_view magic = input.text().substr(kMagic, 4);
  return magic == std::string_view("n+1\0", 4) || magic == std::string_view("ni1\0", 4);
}

std::optional<Affine> nifti_affine(const Input& input) { return Header(input).affine(); }

}  // namespace detail

Image read_nifti(const Input& input, const ReadOptions& options) {
  const Header header(input);
  const detail::ArrayLayout layout{header.type(), header.order(), true, header.first_voxel()};
  Image image = detail::load_array(input, layout, header.extents(), Input::Excess::stays_in_file);
  scale(image, header, input, options);
  return detail::without_nan_pixels(std::move(image), input, options);
}

Image read_nifti(const std::filesystem::path& path, const ReadOptions& options) {
  return read_nifti(Input::open(path, options.context, Input::Excess::stays_in_file,
                                detail::start_check(Format::nifti)),
                    options);
}

}  // namespace ph

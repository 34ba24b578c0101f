// SPDX-License-Identifier: MIT
#include "tests/fuzz/round_trip.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

/// A file in memory. Writers open it by the path of its descriptor.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("written", MFD_CLOEXEC)) {
    require(descriptor_ >= 0, "no file in memory");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }

  std::string name() const { return fmt::format("/dev/fd/{}", descriptor_); }
  std::string text() const {
    std::string bytes(static_cast<std::size_t>(lseek(descriptor_, 0, SEEK_END)), '\0');
    const ssize_t got = pread(descriptor_, bytes.data(), bytes.size(), 0);
    require(got == static_cast<ssize_t>(bytes.size()), "a file in memory cannot be read");
    return bytes;
  }

 private:
  int descriptor_;
};

std::string written(const Barcode& barcode, BarcodeFormat format) {
  const MemoryFile memory;
  OutputFile file(memory.name());
  write_barcode(file, barcode, format);
  file.commit();
  return memory.text();
}

/// The bars without their cells.
Content bars_of(const Barcode& barcode) {
  Barcode bare;
  for (const Bar& bar : barcode) bare.add(bar, {}, {});
  return content_of(bare);
}

std::string written(const Cloud& cloud, PcdData data) {
  std::ostringstream out;
  write_pcd(out, cloud, data);
  return out.str();
}
std::string written(const Cloud& cloud, PlyData data) {
  std::ostringstream out;
  write_ply(out, cloud, data);
  return out.str();
}

const ReadOptions kTakeEmpty{.allow_empty = true};

Cloud read_again(const std::string& bytes, PcdData) {
  return read_pcd(Input::view(bytes, "written.pcd"), kTakeEmpty);
}
Cloud read_again(const std::string& bytes, PlyData) {
  return read_ply(Input::view(bytes, "written.ply"), kTakeEmpty);
}

/// The part of a cloud that a text file preserves: all NaNs become the same NaN, and zeros lose
/// their sign.
Cloud as_text_has_it(Cloud cloud) {
  for (const CloudField& field : cloud.fields) {
    if (field.type != FieldType::float32 && field.type != FieldType::float64) continue;
    const std::size_t size = size_of(field.type);
    for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.size()); ++i) {
      for (std::size_t k = 0; k < field.count; ++k) {
        std::byte* at = cloud.data.data() + i * cloud.stride + field.offset + k * size;
        const auto keep = [at]<class T>(T value) {
          std::memcpy(&value, at, sizeof(T));
          value = std::isnan(value) ? std::numeric_limits<T>::quiet_NaN() : value + T{0};
          std::memcpy(at, &value, sizeof(T));
        };
        field.type == FieldType::float32 ? keep(0.0F) : keep(0.0);
      }
    }
  }
  return cloud;
}

/// The cloud with empty field names. A name that is not a single word would be changed by writing.
Content without_names(Cloud cloud) {
  for (CloudField& field : cloud.fields) field.name.clear();
  return content_of(cloud);
}

}  // namespace

void write_and_read_again(const Barcode& barcode) {
  const auto again = [&](const Barcode& from, BarcodeFormat format) {
    return read_barcode(Input::view(written(from, format), "written"), format);
  };
  require(content_of(again(barcode, BarcodeFormat::json)) == content_of(barcode),
          "a barcode changes through JSON");
  for (const BarcodeFormat format :
       {BarcodeFormat::csv, BarcodeFormat::pers, BarcodeFormat::dipha, BarcodeFormat::npy}) {
    require(content_of(again(barcode, format)) == bars_of(barcode),
            "a barcode changes when it is written and read");
  }
  // Digits are lost only when the bars are first rounded to six digits. Barcodes of high dimension
  // are left out, because the file has a line for each dimension.
  constexpr int kFewDimensions = 64;
  if (!barcode.empty() && barcode[barcode.size() - 1].dim > kFewDimensions) return;
  const Barcode rounded = again(barcode, BarcodeFormat::ripser);
  require(rounded.size() == barcode.size(), "a bar is lost in Ripser's format");
  require(content_of(again(rounded, BarcodeFormat::ripser)) == content_of(rounded),
          "rounded bars change");
}

void write_and_read_again(const Cloud& cloud) {
  if (cloud.fields.empty()) return;  // nothing is known about the points
  for (const PcdData data : {PcdData::binary, PcdData::binary_compressed}) {
    require(without_names(read_again(written(cloud, data), data)) == without_names(cloud),
            "a cloud changes through PCD");
  }
  require(without_names(read_again(written(cloud, PcdData::ascii), PcdData::ascii)) ==
              without_names(as_text_has_it(cloud)),
          "a cloud changes through ascii PCD");
  const bool wide = std::any_of(cloud.fields.begin(), cloud.fields.end(), [](const CloudField& f) {
    return f.type == FieldType::int64 || f.type == FieldType::uint64;
  });
  if (wide) return;  // PLY has no integers of this size
  // The first conversion to PLY splits fields, and loses the numbers of rows and columns. Data read
  // from PLY no longer change.
  const Cloud split = read_again(written(cloud, PlyData::little_endian), PlyData::little_endian);
  require(split.size() == cloud.size(), "points are lost in PLY");
  require(content_of(read_again(written(split, PlyData::little_endian), PlyData::little_endian)) ==
              content_of(split),
          "a cloud changes through PLY");
  require(content_of(read_again(written(split, PlyData::ascii), PlyData::ascii)) ==
              content_of(as_text_has_it(split)),
          "a cloud changes through ascii PLY");
}

void write_and_read_again(const Raster& raster) {
  std::ostringstream out;
  write_png(out, raster);
  require(content_of(read_png(Input::view(out.str(), "written.png"))) == content_of(raster),
          "a picture changes through PNG");
}

void write_and_read_again(const segment::SceneTree& scene) {
  const std::string bytes = segment::tree_bytes(scene);
  require(segment::tree_bytes(segment::read_tree(Input::view(bytes, "written.tree"))) == bytes,
          "a tree changes when it is written and read");
}

}  // namespace ph::fuzz

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ostream>
#include <set>

#include "libph/src/io/bytes/field_access.hpp"
#include "libph/src/io/bytes/lzf.hpp"
#include "libph/src/io/bytes/readers.hpp"
#include "ph/io/cloud.hpp"

namespace ph {
namespace {

// The number of bytes of text written at once.
constexpr std::size_t kFlushAt = std::size_t{1} << 16;

void check_cloud(const Cloud& cloud) {
  cloud.check();
  if (cloud.fields.empty())
    throw Error(ErrorKind::bad_data, "cloud: found no fields, expected at least one");
}

void put(std::ostream& out, std::string_view text) {
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}
void put(std::ostream& out, std::span<const std::byte> bytes) {
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
}

// Writes all numbers of all points, one point per line.
void put_text(std::ostream& out, const Cloud& cloud) {
  std::string text;
  const auto points = static_cast<std::size_t>(cloud.size());
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t start = text.size();
    for (const CloudField& field : cloud.fields) {
      const std::byte* from = cloud.data.data() + i * cloud.stride + field.offset;
      detail::visit_type(field.type, [&]<class T>(T) {
        for (std::size_t k = 0; k < field.count; ++k) {
          if (text.size() != start) text += ' ';
          const T value = load<T>(from + k * sizeof(T), std::endian::native);
          if constexpr (std::is_floating_point_v<T>) {
            if (std::isnan(value)) {  // fmt would write "-nan" for some NaN
              text += "nan";
              continue;
            }
          }
          fmt::format_to(std::back_inserter(text), "{}", +value);
        }
      });
    }
    text += '\n';
    if (text.size() >= kFlushAt || i + 1 == points) {
      put(out, text);
      text.clear();
    }
  }
}

// The records without gaps between fields, in the order of the fields.
std::vector<std::byte> packed_records(const Cloud& cloud) {
  std::vector<std::byte> result;
  result.reserve(cloud.data.size());
  for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.size()); ++i) {
    for (const CloudField& field : cloud.fields) {
      const auto from =
          cloud.data.begin() + static_cast<std::ptrdiff_t>(i * cloud.stride + field.offset);
      result.insert(result.end(), from,
                    from + static_cast<std::ptrdiff_t>(field.count * size_of(field.type)));
    }
  }
  return result;
}

bool is_packed(const Cloud& cloud) {
  std::size_t offset = 0;
  for (const CloudField& field : cloud.fields) {
    if (field.offset != offset) return false;
    offset += field.count * size_of(field.type);
  }
  return offset == cloud.stride;
}

void put_records(std::ostream& out, const Cloud& cloud) {
  if (is_packed(cloud) && std::endian::native == std::endian::little) {
    put(out, std::span<const std::byte>(cloud.data));
    return;
  }
  Cloud copy = cloud;
  detail::to_native(copy);
  const std::vector<std::byte> records = packed_records(copy);
  put(out, std::span<const std::byte>(records));
}

void put_compressed(std::ostream& out, const Cloud& cloud) {
  Cloud swapped;
  const Cloud* source = &cloud;
  if constexpr (std::endian::native != std::endian::little) {
    swapped = cloud;
    detail::to_native(swapped);
    source = &swapped;
  }
  std::vector<std::byte> columns;
  columns.reserve(cloud.data.size());
  for (const CloudField& field : source->fields) {
    const std::size_t width = field.count * size_of(field.type);
    for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.size()); ++i) {
      const std::byte* from = source->data.data() + i * cloud.stride + field.offset;
      columns.insert(columns.end(), from, from + width);
    }
  }
  const std::vector<std::byte> packed = detail::lzf_compress(columns);
  if (columns.size() > UINT32_MAX || packed.size() > UINT32_MAX) {
    throw Error(ErrorKind::bad_data,
                "cloud: more than 4 GiB do not fit binary_compressed; write binary");
  }
  std::array<std::byte, 8> sizes;
  for (std::size_t k = 0; k < 4; ++k) {
    sizes[k] = static_cast<std::byte>(packed.size() >> (8 * k) & 0xFF);
    sizes[4 + k] = static_cast<std::byte>(columns.size() >> (8 * k) & 0xFF);
  }
  put(out, std::span<const std::byte>(sizes));
  put(out, std::span<const std::byte>(packed));
}

char pcd_type(FieldType type) {
  if (type == FieldType::float32 || type == FieldType::float64) return 'F';
  const bool is_signed = type == FieldType::int8 || type == FieldType::int16 ||
                         type == FieldType::int32 || type == FieldType::int64;
  return is_signed ? 'I' : 'U';
}

// The names of the fields, changed as a header needs them: each name is a single word, and no two
// names are equal.
// @param padding true if several fields may be named "_", as in PCD.
std::vector<std::string> header_words(const Cloud& cloud, bool padding) {
  std::vector<std::string> words;
  std::set<std::string> taken;
  for (const CloudField& field : cloud.fields) {
    std::string word = field.name.empty() ? "_" : field.name;
    for (char& c : word) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte <= ' ' || byte == 0x7F || c == '#' || c == ',' || c == ';') c = '_';
    }
    const std::string plain = word;
    for (int copy = 2; !(padding && word == "_") && !taken.insert(word).second; ++copy) {
      word = fmt::format("{}_{}", plain, copy);
    }
    words.push_back(std::move(word));
  }
  return words;
}

std::string_view ply_type(FieldType type) {
  switch (type) {
    case FieldType::int8:
      return "char";
    case FieldType::uint8:
      return "uchar";
    case FieldType::int16:
      return "short";
    case FieldType::uint16:
      return "ushort";
    case FieldType::int32:
      return "int";
    case FieldType::uint32:
      return "uint";
    case FieldType::float32:
      return "float";
    case FieldType::float64:
      return "double";
    case FieldType::int64:
    case FieldType::uint64:
      break;
  }
  throw Error(ErrorKind::bad_data, "cloud: PLY has no 64-bit integers; write PCD");
}

// The cloud in the form that PLY can express. Each field is a single number, and colours are
// separate channels.
Cloud ply_cloud(const Cloud& cloud) {
  Cloud result = cloud;
  result.fields.clear();
  for (const CloudField& field : cloud.fields) {
    const bool packed = (field.name == "rgb" || field.name == "rgba") && field.count == 1 &&
                        size_of(field.type) == 4;
    if (packed && cloud.find("red") == nullptr) {
      // The bytes are in little-endian order, with blue first and alpha last.
      const std::size_t blue = field.offset;
      constexpr bool kLittle = std::endian::native == std::endian::little;
      constexpr std::array<std::string_view, 4> kNames{"blue", "green", "red", "alpha"};
      for (const std::size_t k : {std::size_t{2}, std::size_t{1}, std::size_t{0}, std::size_t{3}}) {
        if (k == 3 && field.name == "rgb") continue;
        result.fields.push_back(
            {std::string(kNames[k]), FieldType::uint8, 1, blue + (kLittle ? k : 3 - k)});
      }
      continue;
    }
    for (std::size_t k = 0; k < field.count; ++k) {
      result.fields.push_back({field.count == 1 ? field.name : fmt::format("{}_{}", field.name, k),
                               field.type, 1, field.offset + k * size_of(field.type)});
    }
  }
  return result;
}

}  // namespace

void write_pcd(std::ostream& out, const Cloud& cloud, PcdData data) {
  check_cloud(cloud);
  std::string fields, sizes, types, counts, viewpoint;
  for (const std::string& word : header_words(cloud, true)) fields += ' ' + word;
  for (const CloudField& field : cloud.fields) {
    sizes += fmt::format(" {}", size_of(field.type));
    types += fmt::format(" {}", pcd_type(field.type));
    counts += fmt::format(" {}", field.count);
  }
  for (const double number : cloud.viewpoint) viewpoint += fmt::format(" {}", number);
  constexpr std::array<std::string_view, 3> kData{"ascii", "binary", "binary_compressed"};
  put(out, fmt::format("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS{}\nSIZE{}\n"
                       "TYPE{}\nCOUNT{}\nWIDTH {}\nHEIGHT {}\nVIEWPOINT{}\nPOINTS {}\nDATA {}\n",
                       fields, sizes, types, counts, cloud.width, cloud.height, viewpoint,
                       cloud.size(), kData[static_cast<std::size_t>(data)]));
  switch (data) {
    case PcdData::ascii:
      put_text(out, cloud);
      break;
    case PcdData::binary:
      put_records(out, cloud);
      break;
    case PcdData::binary_compressed:
      put_compressed(out, cloud);
      break;
  }
  if (!out) throw Error(ErrorKind::io, "cannot write the cloud");
}

void write_ply(std::ostream& out, const Cloud& cloud, PlyData data) {
  check_cloud(cloud);
  const Cloud split = ply_cloud(cloud);
  std::string header =
      fmt::format("ply\nformat {} 1.0\nelement vertex {}\n",
                  data == PlyData::ascii ? "ascii" : "binary_little_endian", split.size());
  const std::vector<std::string> words = header_words(split, false);
  for (std::size_t k = 0; k < words.size(); ++k) {
    header += fmt::format("property {} {}\n", ply_type(split.fields[k].type), words[k]);
  }
  put(out, header + "end_header\n");
  if (data == PlyData::ascii) {
    put_text(out, split);
  } else {
    put_records(out, split);
  }
  if (!out) throw Error(ErrorKind::io, "cannot write the cloud");
}

}  // namespace ph

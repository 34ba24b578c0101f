// SPDX-License-Identifier: MIT
#include "ph/io/write.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/barcode_formats.hpp"

namespace ph {
namespace {

constexpr std::array kFormats{
    BarcodeFormatInfo{BarcodeFormat::csv, "csv", "a header, then one bar per line", "1,0.5,2.25"},
    BarcodeFormatInfo{BarcodeFormat::json, "json",
                      "bars with their cells, representatives and origin",
                      "{\"dim\": 1, \"birth\": 0.5, \"death\": 2.25, …}"},
    BarcodeFormatInfo{BarcodeFormat::ripser, "ripser",
                      "Ripser's output: intervals by dimension, 6 digits", " [0.5,2.25)"},
    BarcodeFormatInfo{BarcodeFormat::pers, "pers", "GUDHI's dim birth death, one bar per line",
                      "1 0.5 2.25"},
    BarcodeFormatInfo{BarcodeFormat::dipha, "dipha", "DIPHA's persistence diagram, binary", ""},
    BarcodeFormatInfo{BarcodeFormat::npy, "npy", "a NumPy array of rows dim, birth, death", ""},
    BarcodeFormatInfo{BarcodeFormat::none, "none", "nothing", ""},
};

}  // namespace

std::span<const BarcodeFormatInfo> barcode_formats() { return kFormats; }

std::string_view barcode_format_name(BarcodeFormat format) {
  for (const BarcodeFormatInfo& info : kFormats)
    if (info.format == format) return info.name;
  return "";
}

std::optional<BarcodeFormat> barcode_format_named(std::string_view name) {
  for (const BarcodeFormatInfo& info : kFormats)
    if (info.name == name) return info.format;
  return std::nullopt;
}

std::optional<BarcodeFormat> barcode_format_of_path(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  const std::size_t slash = path.rfind('/');
  if (dot == std::string_view::npos || (slash != std::string_view::npos && dot < slash))
    return std::nullopt;
  const std::string extension = lower_case(path.substr(dot + 1));
  if (extension == "none") return std::nullopt;
  if (extension == "diagram") return BarcodeFormat::dipha;
  return barcode_format_named(extension);
}

void write_barcode(OutputFile& file, const Barcode& barcode, BarcodeFormat format,
                   const BarData& data) {
  const BarcodeInfo& info = data.info != nullptr ? *data.info : barcode.info();
  if (!data.p_values.empty() && data.p_values.size() != barcode.size())
    throw Error(ErrorKind::usage,
                fmt::format("p_values: found {}, expected one for each of {} bars, or none",
                            data.p_values.size(), barcode.size()));
  if (data.centroids.rows() != 0 && data.centroids.rows() != std::ssize(barcode))
    throw Error(ErrorKind::usage,
                fmt::format("centroids: found {}, expected one for each of {} bars, or none",
                            data.centroids.rows(), barcode.size()));
  switch (format) {
    case BarcodeFormat::csv:
      return write_barcode_csv(file, barcode, info, data);
    case BarcodeFormat::json:
      return write_barcode_json(file, barcode, info, data);
    case BarcodeFormat::ripser:
      return write_barcode_ripser(file, barcode, info.max_dim);
    case BarcodeFormat::pers:
      return write_barcode_pers(file, barcode);
    case BarcodeFormat::dipha:
      return write_barcode_dipha(file, barcode, info.threshold);
    case BarcodeFormat::npy:
      return write_barcode_npy(file, barcode);
    case BarcodeFormat::none:
      return;
  }
}

}  // namespace ph

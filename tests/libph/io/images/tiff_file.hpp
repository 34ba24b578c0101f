// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "ph/io/read.hpp"
#include "tests/libph/io/packed.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {

inline const std::vector<double> kSix{0, 5, 2, 4, 9, 1};

/// A page: the numbers of its fields and the bytes of its strips. A test may change both.
struct Page {
  std::map<int, std::vector<std::uint64_t>> fields{{256, {3}}, {257, {2}}, {258, {8}}, {259, {1}},
                                                   {262, {1}}, {277, {1}}, {278, {2}}, {339, {1}}};
  std::vector<std::string> strips;
  std::string description;
};

/// A TIFF file, which may be invalid.
struct Tiff {
  bool big_endian = false, bigtiff = false;
  std::vector<Page> pages;
  std::size_t last_link = 0;  // the place of the directory after the last one

  std::string number(std::uint64_t value, std::size_t bytes) const {
    std::string raw = le(value).substr(0, bytes);
    if (big_endian) std::reverse(raw.begin(), raw.end());
    return raw;
  }
  std::string bytes() const {
    const std::size_t offset = bigtiff ? 8 : 4;
    std::string file(big_endian ? "MM" : "II");
    file += number(bigtiff ? 43 : 42, 2);
    if (bigtiff) file += number(8, 2) + number(0, 2);
    std::size_t link = file.size();
    file += number(0, offset);
    for (const Page& page : pages) {
      auto fields = page.fields;
      const bool is_tiled = fields.contains(322);
      for (const std::string& strip : page.strips) {
        fields[is_tiled ? 324 : 273].push_back(file.size());
        fields[is_tiled ? 325 : 279].push_back(strip.size());
        file += strip;
      }
      std::map<int, std::size_t> places;
      for (const auto& [tag, values] : fields) {
        places[tag] = file.size();
        if (values.size() * 4 > offset)
          for (const std::uint64_t value : values) file += number(value, 4);
      }
      const std::size_t text = file.size();
      file += page.description;
      const std::size_t begin = file.size();
      file.replace(link, offset, number(begin, offset));
      const std::size_t count = fields.size() + (page.description.empty() ? 0 : 1);
      file += number(count, bigtiff ? 8 : 2);
      for (const auto& [tag, values] : fields) {
        file += number(static_cast<std::uint64_t>(tag), 2) + number(4, 2) +
                number(values.size(), offset);
        std::string inside;
        if (values.size() * 4 <= offset)
          for (const std::uint64_t value : values) inside += number(value, 4);
        if (values.size() * 4 > offset) inside = number(places[tag], offset);
        inside.resize(offset, '\0');
        file += inside;
      }
      if (!page.description.empty())
        file += number(270, 2) + number(2, 2) + number(page.description.size(), offset) +
                number(text, offset);
      link = file.size();
      file += number(last_link, offset);
    }
    return file;
  }
};

/// The numbers as the pixels of a strip.
template <class T>
std::string strip(const std::vector<double>& numbers, bool big) {
  std::string bytes;
  for (const double number : numbers) {
    std::string raw = le(static_cast<T>(number));
    if (big) std::reverse(raw.begin(), raw.end());
    bytes += raw;
  }
  return bytes;
}

inline Page page_of_bytes(const std::vector<double>& numbers = kSix) {
  return {.strips = {strip<std::uint8_t>(numbers, false)}, .description = {}};
}

inline std::string bytes_of(Page page) { return Tiff{.pages = {std::move(page)}}.bytes(); }

/// A file of one page that a function changes.
template <class Change>
std::string changed(const Change& change) {
  Page page = page_of_bytes();
  change(page);
  return bytes_of(std::move(page));
}

inline ReadResult read_tiff(const std::string& bytes, const ReadOptions& options = {}) {
  return read_any(Input::hold({bytes.begin(), bytes.end()}, "a.tif"), Format::automatic, options);
}
inline Image image_in(const std::string& bytes, const ReadOptions& options = {}) {
  return std::get<Image>(read_tiff(bytes, options).data);
}

}  // namespace ph::test

// SPDX-License-Identifier: MIT
// Tests every proper prefix of every sample. If a format states its length, the reader must reject
// the prefix. For any other format, the reader must reject it or return the data that are present.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

#include "tests/fuzz/readers.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::fuzz {
namespace {

namespace fs = std::filesystem;

struct Sample {
  std::string reader, name;
  bool sized = false;  // the format states the size of the data
  std::string bytes;
  /// The path to open. For an archive of several arrays, it ends in the name of one of them.
  std::string opened(const fs::path& path) const {
    return path.string() + (name == "two.npz" ? ":points" : "");
  }
};

std::vector<Sample> samples() {
  std::vector<Sample> all;
  std::ifstream manifest(fs::path(PH_SAMPLES) / "manifest.txt");
  std::string length;
  for (Sample sample; manifest >> sample.reader >> sample.name >> length;) {
    sample.sized = length == "sized";
    std::ostringstream bytes;
    bytes << std::ifstream(fs::path(PH_SAMPLES) / sample.reader / sample.name, std::ios::binary)
                 .rdbuf();
    sample.bytes = bytes.str();
    all.push_back(sample);
  }
  return all;
}

// ---- the data present, read as plain numbers without any format

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The numbers in a text, without comments and header lines. Empty if a line contains both numbers
/// and other words.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.find('#'), line.size()));
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    std::istringstream cells(line);
    std::size_t names = 0, cells_in_line = 0;
    for (std::string cell; cells >> cell; ++cells_in_line) {
      const auto number = number_of(cell);
      number ? numbers.push_back(*number) : static_cast<void>(++names);
    }
    if (names != 0 && names != cells_in_line) return std::nullopt;
  }
  return numbers;
}

/// The n for which `count` is n (n - 1) / 2 or, for square matrices, n².
std::optional<std::size_t> size_for(std::size_t count, bool square) {
  for (std::size_t n = 1; n * (n - 1) / 2 <= count; ++n)
    if ((square ? n * n : n * (n - 1) / 2) == count) return n;
  return std::nullopt;
}

/// The lower triangle of the matrix in a file, as values in row order; nothing if numbers are
/// missing.
std::optional<std::vector<double>> triangle_of(const std::string& reader, std::string_view bytes) {
  std::optional<std::vector<double>> numbers;
  if (reader == "binary_distances") {
    if (bytes.size() % sizeof(float) != 0) return std::nullopt;
    numbers.emplace();
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(float)) {
      float value;
      std::memcpy(&value, bytes.data() + at, sizeof value);
      numbers->push_back(double{value});
    }
  } else {
    numbers = numbers_of(bytes);
  }
  const bool square = reader == "distances" || reader == "correlations";
  const auto n = numbers ? size_for(numbers->size(), square) : std::nullopt;
  if (!n) return std::nullopt;
  std::vector<double> lower;
  for (std::size_t i = 0; i < *n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      // Start of row j in the upper triangle.
      const std::size_t upper_row = j * *n - j * (j + 1) / 2;
      const double value = square                        ? (*numbers)[i * *n + j]
                           : reader == "upper_distances" ? (*numbers)[upper_row + i - j - 1]
                                                         : (*numbers)[lower.size()];
      lower.push_back(reader == "correlations" ? 1 - value : value);
    }
  }
  return lower;
}

bool is_triangle(const std::string& reader) {
  return reader.ends_with("distances") || reader == "correlations";
}

// ---- rows

using Rows = std::multiset<std::vector<double>>;

Rows rows_of(const Content& content) {
  Rows rows;
  for (std::size_t i = 0; i < content.rows(); ++i) {
    std::vector<double> row(content.row(i).begin(), content.row(i).end());
    for (double& x : row)
      if (std::isnan(x)) x = -1e300;  // NaN has no place in an order
    rows.insert(row);
  }
  return rows;
}

Rows without(const Rows& all, const Rows& some) {
  Rows left;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(),
                      std::inserter(left, left.begin()));
  return left;
}

/// True if the row ends in this number, either as its last entry or as the eight bytes of the
/// number.
bool ends_in(const std::vector<double>& row, double number) {
  if (row.back() == number) return true;
  unsigned char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  return row.size() >= sizeof number &&
         std::equal(std::begin(bytes), std::end(bytes), row.end() - sizeof number);
}

/// The number at the end of the last line.
std::optional<double> last_number(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  text.remove_prefix(text.rfind('\n') + 1);
  text = text.substr(0, text.find('#'));
  text = text.substr(0, text.find_last_not_of(" \t\r,;") + 1);
  return number_of(text.substr(text.find_last_of(" \t,;:") + 1));
}

// ---- the test

/// A file whose contents grow byte by byte.
class GrowingFile {
 public:
  explicit GrowingFile(const std::string& name) {
    std::string folder = (fs::temp_directory_path() / "ph-test-XXXXXX").string();
    folder_ = mkdtemp(folder.data());
    path_ = folder_ / name;
    file_.open(path_, std::ios::binary);
  }
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  ~GrowingFile() { fs::remove_all(folder_); }
  const fs::path& path() const { return path_; }
  void append(char byte) { file_.put(byte).flush(); }

 private:
  fs::path folder_, path_;
  std::ofstream file_;
};

struct Counts {
  int prefixes = 0, rejected = 0, complete = 0, shorter = 0;
};

class Prefixes {
 public:
  Prefixes(const Sample& sample, Counts& counts) : sample_(sample), counts_(counts) {}

  void check() {
    const NamedReader* reader = find_reader(sample_.reader);
    ASSERT_NE(reader, nullptr) << sample_.reader;
    GrowingFile file(sample_.name);
    for (std::size_t length = 0; length <= sample_.bytes.size(); ++length) {
      if (length > 0) file.append(sample_.bytes[length - 1]);
      SCOPED_TRACE(std::to_string(length) + " bytes");
      std::optional<Content> content;
      ph::test::fails_with(ErrorKind::bad_data, [&] {
        content = reader->read(Input::open(sample_.opened(file.path())), {});
      });
      contents_.push_back(content);
    }
    ASSERT_TRUE(contents_.back()) << "the whole is rejected";
    for (std::size_t length = 0; length < sample_.bytes.size(); ++length) {
      SCOPED_TRACE(std::to_string(length) + " bytes");
      ++counts_.prefixes;
      check_prefix(std::string_view(sample_.bytes).substr(0, length));
    }
  }

 private:
  void check_prefix(std::string_view prefix) {
    const auto& content = contents_[prefix.size()];
    const std::string_view missing = std::string_view(sample_.bytes).substr(prefix.size());
    if (missing.find_first_not_of(" \t\r\n") == missing.npos && content) {
      EXPECT_EQ(*content, *contents_.back()) << "it lacks nothing";
      ++counts_.complete;
    } else if (!content) {
      ++counts_.rejected;
    } else if (sample_.name == "two_members.txt.gz") {
      check_members(*content);
    } else {
      ++counts_.shorter;
      EXPECT_FALSE(sample_.sized) << "accepted";
      is_triangle(sample_.reader) ? check_triangle(prefix, *content) : check_rows(prefix, *content);
    }
    if (prefix.empty() || prefix.back() == '\n') {
      if (content) lines_ = rows_of(*content);
    }
  }

  /// Checks that all numbers that are present form a triangle.
  void check_triangle(std::string_view prefix, const Content& content) {
    const auto expected = triangle_of(sample_.reader, prefix);
    ASSERT_TRUE(expected) << "accepted, but no triangle";
    ASSERT_EQ(content.numbers.size(), expected->size());
    for (std::size_t k = 0; k < expected->size(); ++k) {
      const double a = content.numbers[k], b = (*expected)[k];
      EXPECT_TRUE(a == b || std::abs(a - b) <= 1e-6 * std::abs(b)) << a << " and " << b;
    }
  }

  /// Checks that the result has the rows of the complete lines and at most one more row. This row
  /// must be a row of the whole file or, for a truncated line, end in the truncated number.
  void check_rows(std::string_view prefix, const Content& content) {
    const Rows rows = rows_of(content);
    EXPECT_TRUE(without(lines_, rows).empty()) << "a line is lost";
    const Rows more = without(rows, lines_);
    ASSERT_LE(more.size(), 1U) << "a line gives two rows";
    if (more.empty() || without(more, rows_of(*contents_.back())).empty()) return;
    EXPECT_NE(prefix.back(), '\n') << "another row";
    const auto number = last_number(prefix);
    ASSERT_TRUE(number) << "a row of a line without a number at its end";
    EXPECT_TRUE(ends_in(*more.begin(), *number)) << *number;
  }

  /// Checks a prefix that ends after a gzip member, and is therefore a valid file with fewer
  /// members.
  void check_members(const Content& content) {
    ++members_;
    EXPECT_EQ(members_, 1) << "the file has two";
    EXPECT_TRUE(without(rows_of(content), rows_of(*contents_.back())).empty());
  }

  const Sample& sample_;
  Counts& counts_;
  std::vector<std::optional<Content>> contents_;  // for each length
  Rows lines_;                                    // the rows of the complete lines so far
  int members_ = 0;
};

TEST(Truncation, EveryProperPrefixOfEverySample) {
  Counts counts;
  const std::vector<Sample> all = samples();
  for (const Sample& sample : all) {
    SCOPED_TRACE(sample.reader + "/" + sample.name);
    Prefixes(sample, counts).check();
  }
  std::cout << counts.prefixes << " prefixes of " << all.size() << " samples: " << counts.rejected
            << " rejected, " << counts.complete << " lack a line end only, " << counts.shorter
            << " of formats without a length give what is there\n";
  EXPECT_GE(counts.prefixes, 20000);
}

}  // namespace
}  // namespace ph::fuzz

// SPDX-License-Identifier: MIT
// An image that exceeds the memory limit stays in its file or is stored in a temporary file. Its
// numbers are the same as in memory.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>
#include <random>

#include "ph/io/read.hpp"
#include "tests/libph/io/images/nifti_file.hpp"
#include "tests/libph/io/packed.hpp"
#include "tests/libph/io/read_support.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

using Excess = Input::Excess;

constexpr Index kDepth = 80, kHeight = 250, kWidth = 260;  // 20 MiB of float32
constexpr std::size_t kCount = kDepth * kHeight * kWidth;

template <class T>
std::vector<T> numbers() {
  std::vector<T> values(kCount);
  std::uint32_t state = 1;
  for (T& value : values) value = static_cast<T>((state = 1664525 * state + 1013904223) >> 24);
  return values;
}

template <class T>
std::string npy(const std::string& type, const std::vector<T>& values, bool fortran = false,
                const std::string& shape = "80, 250, 260") {
  std::string header = "{'descr': '" + type +
                       "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (" +
                       shape + "), }";
  header.resize(117, ' ');
  header += '\n';
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8) + le(std::uint16_t{118}) + header;
  const auto* raw = reinterpret_cast<const char*>(values.data());
  return bytes.append(raw, values.size() * sizeof(T));
}

// Reads the image with a high memory limit and with a low one, and compares the results.
void expect_same_in_file(const std::string& name, const std::string& bytes,
                         ReadOptions options = {}) {
  SCOPED_TRACE(name);
  const TempDir dir;
  const std::filesystem::path path = dir.write(name, bytes);
  const Image expected = read_image(path, options);
  EXPECT_FALSE(expected.values.is_in_file());
  LimitedContext context(3'000'000);
  options.context = &context;
  const Image found = read_image(path, options);
  EXPECT_TRUE(found.values.is_in_file());
  EXPECT_EQ(found.extents, expected.extents);
  EXPECT_EQ(found.values.type(), expected.values.type());
  EXPECT_TRUE(marked(found.values) == marked(expected.values));
  EXPECT_EQ(found.values.bytes(), 0U);
  EXPECT_LE(context.memory.peak(), context.memory.limit());
}

TEST(ImagesInFiles, AreTheSameAsInMemory) {
  expect_same_in_file("c.npy", npy("<f4", numbers<float>()));
  expect_same_in_file("fortran.npy", npy("<f4", numbers<float>(), true));
  expect_same_in_file("bytes.npy", npy("|u1", numbers<std::uint8_t>()));
  expect_same_in_file("converted.npy", npy("<i4", numbers<std::int32_t>()));
  std::vector<float> turned = numbers<float>();
  for (float& value : turned) {
    std::array<char, 4> raw{};
    std::memcpy(raw.data(), &value, 4);
    std::ranges::reverse(raw);
    std::memcpy(&value, raw.data(), 4);
  }
  expect_same_in_file("big-endian.npy", npy(">f4", turned));
  expect_same_in_file("packed.npy.gz", gzipped(npy("<f4", numbers<float>()), 1));
}

TEST(ImagesInFiles, MaskNan) {
  std::vector<double> values = numbers<double>();
  values[5] = values[kCount - 1] = std::numeric_limits<double>::quiet_NaN();
  const std::string bytes = npy("<f8", values);
  expect_same_in_file("nan.npy", bytes, {.nan = NanPolicy::drop});
  const TempDir dir;
  const std::filesystem::path path = dir.write("nan.npy", bytes);
  LimitedContext context(3'000'000);
  EXPECT_TRUE(contains(bad_data([&] { read_image(path, {.context = &context}); }), "[0, 0, 5]"));
}

// A raw image that begins at an odd byte cannot be used in place.
TEST(ImagesInFiles, OfAnyAlignment) {
  const std::vector<float> values = numbers<float>();
  std::string bytes(3, 'x');
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  const TempDir dir;
  const std::filesystem::path path = dir.write("volume.raw", bytes);
  const RawLayout layout{.extents = {kDepth, kHeight, kWidth}, .type = "f4", .skip = 3};
  LimitedContext context(3'000'000);
  const Image image =
      read_raw(Input::open(path, &context, Excess::stays_in_file), layout, {.context = &context});
  EXPECT_TRUE(image.values.is_in_file());
  EXPECT_TRUE(image.values == Voxels(values));
}

TEST(ImagesInFiles, ChangeInMemory) {
  const TempDir dir;
  const std::filesystem::path path = dir.write("c.npy", npy("<f4", numbers<float>()));
  LimitedContext context(3'000'000);
  const Image image = read_image(path, {.context = &context});
  Voxels changed = image.values;
  const double before = changed[7];
  changed.change([](auto& all) { all[7] = 99; });
  EXPECT_FALSE(changed.is_in_file());
  EXPECT_EQ(changed[7], 99);
  EXPECT_EQ(image.values[7], before);
}

/// Files of a few megabytes. About half of the files have a random fault.
class RandomFiles {
 public:
  struct File {
    std::string name, bytes;
    NanPolicy nan;
  };
  File next() {
    const bool is_nifti = coin(), is_packed = below(4) == 0;
    std::string bytes = is_nifti ? nifti() : array();
    const std::size_t header = is_nifti ? 352 : 128;
    switch (below(8)) {
      case 0:
        bytes.resize(bytes.size() - 1 - below(100));
        break;
      case 1:
        bytes += 'x';
        break;
      case 2:
        bytes[below(header)] ^= static_cast<char>(1 << below(8));
        break;
    }
    if (is_packed) {
      bytes = gzipped(bytes, 1);
      if (below(3) == 0) bytes[below(bytes.size())] ^= 1;
    }
    return {std::string(is_nifti ? "a.nii" : "a.npy") + (is_packed ? ".gz" : ""), std::move(bytes),
            coin() ? NanPolicy::error : NanPolicy::drop};
  }

 private:
  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }
  bool coin() { return below(2) == 0; }
  /// Up to four extents whose product is about a million.
  std::vector<std::size_t> extents() {
    std::vector<std::size_t> result;
    std::size_t left = 1'100'000 + below(500'000);
    for (std::size_t axes = 1 + below(4); axes > 1; --axes) {
      result.push_back(1 + below(60));
      left /= result.back();
    }
    result.insert(result.begin() + static_cast<std::ptrdiff_t>(below(result.size() + 1)), left + 1);
    return result;
  }
  /// Random elements: arbitrary bits, or whole numbers that every type can represent.
  std::string elements(std::size_t count, std::size_t size, bool any_bits) {
    std::string bytes(count * size, '\0');
    const std::size_t step = any_bits ? 1 : size;
    for (std::size_t at = 0; at < bytes.size(); at += step)
      bytes[at] = static_cast<char>(random_() & 0x7F);
    return bytes;
  }
  std::string array() {
    constexpr std::array<const char*, 12> types{"|b1", "|u1", "<u2", ">u2", "<u4", ">i4",
                                                "|i1", "<i2", "<i8", "<f2", "<f4", ">f8"};
    const std::string type = types[below(types.size())];
    std::string shape;
    std::size_t count = 1;
    for (const std::size_t n : extents()) {
      shape += std::to_string(n) + ", ";
      count *= n;
    }
    const std::string raw = elements(count, static_cast<std::size_t>(type[2] - '0'), below(4) == 0);
    return npy(type, std::vector<char>(raw.begin(), raw.end()), coin(), shape);
  }
  std::string nifti() {
    constexpr std::array<std::array<std::int16_t, 2>, 8> types{
        {{2, 8}, {4, 16}, {8, 32}, {16, 32}, {64, 64}, {256, 8}, {512, 16}, {768, 32}}};
    const auto [code, bits] = types[below(types.size())];
    Nifti file{.dim = {}, .datatype = code, .bitpix = bits, .big = coin()};
    std::size_t count = 1;
    for (const std::size_t n : extents()) {
      const std::size_t fits = std::min<std::size_t>(n, 32'000);
      file.dim.push_back(static_cast<std::int16_t>(fits));
      count *= fits;
    }
    if (const std::size_t more = (1'100'000 + count - 1) / count; more > 1) {
      file.dim.push_back(static_cast<std::int16_t>(more));
      count *= more;
    }
    file.dim.insert(file.dim.begin(), static_cast<std::int16_t>(file.dim.size()));
    if (coin()) file.slope = coin() ? 0.5F : -3;
    if (coin()) file.intercept = 7;
    return file.header() + elements(count, static_cast<std::size_t>(bits / 8), below(4) == 0);
  }

  std::mt19937 random_{3};
};

// Whatever a file contains, a reader gives the same numbers or the same message with little memory
// as with much memory.
TEST(ImagesInFiles, RandomFilesAndFaults) {
  struct Outcome {
    std::optional<Image> image;
    std::string message;
    bool is_refused = false;
  };
  const TempDir dir;
  const auto outcome = [](const std::filesystem::path& path, ReadOptions options) {
    Outcome result;
    try {
      result.image = read_image(path, options);
    } catch (const Error& error) {
      result.message = error.what();
      result.is_refused = error.kind() == ErrorKind::resource;
    }
    return result;
  };
  RandomFiles files;
  int in_file = 0, faults = 0, refused = 0;
  for (int round = 0; round < 100; ++round) {
    const auto [name, bytes, nan] = files.next();
    SCOPED_TRACE(fmt::format("round {}, {}", round, name));
    const std::filesystem::path path = dir.write(name, bytes);
    const Outcome expected = outcome(path, {.nan = nan});
    LimitedContext context(3'000'000);
    const Outcome found = outcome(path, {.nan = nan, .context = &context});
    ASSERT_LE(context.memory.peak(), context.memory.limit());
    if (found.is_refused) {
      ++refused;
      continue;
    }
    ASSERT_EQ(found.message, expected.message);
    ASSERT_EQ(found.image.has_value(), expected.image.has_value());
    if (!found.image) {
      ++faults;
      continue;
    }
    in_file += found.image->values.is_in_file() ? 1 : 0;
    ASSERT_EQ(found.image->extents, expected.image->extents);
    ASSERT_TRUE(marked(found.image->values) == marked(expected.image->values));
  }
  EXPECT_GT(in_file, 30);
  EXPECT_GT(faults, 15);
  EXPECT_LT(refused, 10);
}

// Points must fit into memory: an array of points that is too large is refused.
TEST(ImagesInFiles, OtherInputsDoNot) {
  const TempDir dir;
  const std::filesystem::path path = dir.write("c.npy", npy("<f4", numbers<float>()));
  LimitedContext context(3'000'000);
  const ReadOptions options{.array = ArrayMeaning::points, .context = &context};
  for (const Format format : {Format::npy, Format::points}) {
    EXPECT_TRUE(fails_with(ErrorKind::resource, [&] { read_any(path, format, options); }));
  }
}

// An input that takes more than a third of the remaining memory stays in its file until it is read
// as points. Its bytes then count towards the limit.
TEST(ImagesInFiles, OtherInputsAreCounted) {
  std::string text;
  while (text.size() < 600'000) text += "0.25 0.5 0.75\n";
  const TempDir dir;
  const std::filesystem::path path = dir.write("points.txt", text);
  LimitedContext context(1'000'000);
  const Input input = Input::open(path, &context, Excess::stays_in_file);
  EXPECT_TRUE(input.stays_in_file());
  EXPECT_LT(context.memory.used(), text.size());
  fails_with(ErrorKind::resource, [&] { read_any(input, Format::points, {.context = &context}); });
  EXPECT_FALSE(input.stays_in_file());
  EXPECT_GE(context.memory.used(), text.size());
}

}  // namespace
}  // namespace ph::test

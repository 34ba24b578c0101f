// SPDX-License-Identifier: MIT
// Images that exceed the memory limit stay in their file, or in a temporary one: with the same
// numbers as in memory.
#include <zlib.h>

#include <limits>

#include "ph/io/formats.hpp"
#include "ph/io/read.hpp"
#include "read_support.hpp"

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
std::string npy(const std::string& type, const std::vector<T>& values, bool fortran = false) {
  std::string header = "{'descr': '" + type +
                       "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': (80, 250, 260), }";
  header.resize(117, ' ');
  header += '\n';
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8) + le(std::uint16_t{118}) + header;
  const auto* raw = reinterpret_cast<const char*>(values.data());
  return bytes.append(raw, values.size() * sizeof(T));
}

std::string gzipped(const std::string& bytes) {
  std::string packed(compressBound(bytes.size()) + 64, '\0');
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 1, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// Reads it with much memory, then with little.
void expect_same_in_file(const std::string& name, const std::string& bytes,
                         ReadOptions options = {}) {
  SCOPED_TRACE(name);
  const TempDir dir;
  const std::filesystem::path path = dir.write(name, bytes);
  const Image expected = read_image(path, options);
  EXPECT_FALSE(expected.values.is_in_file());
  RunContext context;
  context.memory.set_limit(3'000'000);
  options.context = &context;
  const Image found = read_image(path, options);
  EXPECT_TRUE(found.values.is_in_file());
  EXPECT_EQ(found.extents, expected.extents);
  EXPECT_EQ(found.values.type(), expected.values.type());
  EXPECT_TRUE(found.values == expected.values);
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
  expect_same_in_file("packed.npy.gz", gzipped(npy("<f4", numbers<float>())));
}

TEST(ImagesInFiles, MaskNan) {
  std::vector<double> values = numbers<double>();
  values[5] = values[kCount - 1] = std::numeric_limits<double>::quiet_NaN();
  const std::string bytes = npy("<f8", values);
  expect_same_in_file("nan.npy", bytes, {.nan = NanPolicy::drop});
  const TempDir dir;
  const std::filesystem::path path = dir.write("nan.npy", bytes);
  RunContext context;
  context.memory.set_limit(3'000'000);
  EXPECT_TRUE(contains(bad_data([&] { read_image(path, {.context = &context}); }), "[0, 0, 5]"));
}

// A raw image that begins at an odd byte cannot be looked at where it is.
TEST(ImagesInFiles, OfAnyAlignment) {
  const std::vector<float> values = numbers<float>();
  std::string bytes(3, 'x');
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  const TempDir dir;
  const std::filesystem::path path = dir.write("volume.raw", bytes);
  const RawLayout layout{.extents = {kDepth, kHeight, kWidth}, .type = "f4", .skip = 3};
  RunContext context;
  context.memory.set_limit(3'000'000);
  const Image image =
      read_raw(Input::open(path, &context, Excess::stays_in_file), layout, {.context = &context});
  EXPECT_TRUE(image.values.is_in_file());
  EXPECT_TRUE(image.values == Voxels(values));
}

TEST(ImagesInFiles, ChangeInMemory) {
  const TempDir dir;
  const std::filesystem::path path = dir.write("c.npy", npy("<f4", numbers<float>()));
  RunContext context;
  context.memory.set_limit(3'000'000);
  const Image image = read_image(path, {.context = &context});
  Voxels changed = image.values;
  const double before = changed[7];
  changed.change([](auto& all) { all[7] = 99; });
  EXPECT_FALSE(changed.is_in_file());
  EXPECT_EQ(changed[7], 99);
  EXPECT_EQ(image.values[7], before);
}

// What must be in memory as a whole is refused as before.
TEST(ImagesInFiles, OtherInputsDoNot) {
  const TempDir dir;
  const std::filesystem::path path = dir.write("c.npy", npy("<f4", numbers<float>()));
  RunContext context;
  context.memory.set_limit(3'000'000);
  const ReadOptions options{.array = ArrayMeaning::points, .context = &context};
  for (const Format format : {Format::npy, Format::points}) {
    try {
      read_any(path, format, options);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::resource) << error.what();
    }
  }
}

// Between a third of what is left and all of it they are read, and counted.
TEST(ImagesInFiles, OtherInputsAreCounted) {
  std::string text;
  while (text.size() < 600'000) text += "0.25 0.5 0.75\n";
  const TempDir dir;
  const std::filesystem::path path = dir.write("points.txt", text);
  RunContext context;
  context.memory.set_limit(1'000'000);
  const Input input = Input::open(path, &context, Excess::stays_in_file);
  EXPECT_TRUE(input.stays_in_file());
  EXPECT_LT(context.memory.used(), text.size());
  try {
    read_any(input, Format::points, {.context = &context});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::resource) << error.what();
  }
  EXPECT_FALSE(input.stays_in_file());
  EXPECT_GE(context.memory.used(), text.size());
}

}  // namespace
}  // namespace ph::test

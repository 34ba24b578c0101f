// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory_resource>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "ph/detail/io/reader.hpp"
#include "ph/error.hpp"
#include "ph/image.hpp"
#include "ph/io/read.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::test {

/// Stands for an absent voxel. NaN cannot be used in comparisons, because it equals nothing.
inline constexpr double kMark = -987654321;

/// The numbers of an image, with kMark for absent voxels.
inline std::vector<double> marked(const Voxels& voxels) {
  std::vector<double> numbers = voxels.doubles();
  for (double& number : numbers)
    if (std::isnan(number)) number = kMark;
  return numbers;
}

/// The message of the bad_data error that `f` throws. The test fails if `f` throws another error or
/// no error.
template <class F>
std::string bad_data(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_data) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

/// Calls `read(Input)` on every proper prefix of `bytes`. `read` must throw bad_data. It may
/// succeed only if `complete(length)` says that the prefix is a complete input.
template <class Read, class Complete>
void check_prefixes(const std::string& bytes, const std::string& name, Read read,
                    Complete complete) {
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string prefix = bytes.substr(0, length);
    try {
      read(Input::view(prefix, name));
      EXPECT_TRUE(complete(length)) << name << ": a prefix of " << length << " bytes was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_data) << length << ": " << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

inline auto never() {
  return [](std::size_t) { return false; };
}

/// A temporary folder, which is removed with all its files.
class TempDir {
 public:
  TempDir() {
    std::random_device random;
    do {
      path_ = std::filesystem::temp_directory_path() / ("ph-test-" + std::to_string(random()));
    } while (!std::filesystem::create_directory(path_));
  }
  ~TempDir() { std::filesystem::remove_all(path_); }
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

/// An input whose bytes count towards the run's memory budget, like the bytes of an opened file.
inline Input held(const std::string& bytes, const std::string& name, const RunContext& context) {
  return Input::hold(std::pmr::vector<char>(bytes.begin(), bytes.end(), &context.memory), name,
                     &context);
}

/// The bytes of a number in little-endian order.
template <class T>
std::string le(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The image that is read from the bytes, as if they were the content of a file with this name.
inline Image image_of(const std::string& bytes, const std::string& name,
                      const ReadOptions& options = {}) {
  ReadResult result = read_any(Input::view(bytes, name), Format::automatic, options);
  return std::get<Image>(std::move(result.data));
}

/// Checks that each of these contents is refused as bad data, with a message that names the file.
inline void expect_refused(const std::string& name, const std::vector<std::string>& cases) {
  for (const std::string& bytes : cases) {
    const std::string message = bad_data([&] { read_any(Input::view(bytes, name)); });
    EXPECT_TRUE(contains(message, name)) << message;
  }
}

}  // namespace ph::test

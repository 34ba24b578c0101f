// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>
#include <vector>

#include "tests/libph/io/images/tiff_file.hpp"

namespace ph::test {
namespace {

// A picture of 2 x 1 pixels.
std::string pgm(int first) {
  return "P2 2 1 255\n" + std::to_string(first) + ' ' + std::to_string(first + 1) + '\n';
}

ReadResult read_folder(const TempDir& dir, Format format = Format::automatic,
                       ReadOptions options = {}) {
  options.stack = true;
  return read_any(dir.file("."), format, options);
}

bool has_note(const ReadResult& result, const std::string& part) {
  for (const Message& note : result.notes)
    if (contains(note.str(), part)) return true;
  return false;
}

TEST(ReadStack, SlicesComeInTheOrderOfTheirNumbers) {
  const TempDir dir;
  for (const int k : {10, 2, 9, 1}) dir.write("slice" + std::to_string(k) + ".pgm", pgm(10 * k));
  const ReadResult result = read_folder(dir);
  const Image& volume = std::get<Image>(result.data);
  EXPECT_EQ(volume.extents, (std::vector<Index>{4, 1, 2}));
  EXPECT_EQ(volume.values, (std::vector<double>{10, 11, 20, 21, 90, 91, 100, 101}));
  EXPECT_EQ(result.format, Format::pgm);
  EXPECT_EQ(result.description, "image of 4 x 1 x 2 voxels, 4 PGM files");
  EXPECT_TRUE(has_note(result, "4 slices, from slice1.pgm to slice10.pgm"));
  EXPECT_TRUE(has_note(result, "not evenly spaced: slice2.pgm is followed by slice9.pgm"));
  EXPECT_EQ(read_image(dir.file("."), {.stack = true}).values, volume.values);
}

TEST(ReadStack, EvenNumbersAreNoGap) {
  const TempDir dir;
  for (const char* name : {"b_000.pgm", "b_005.pgm", "b_010.pgm"}) dir.write(name, pgm(1));
  EXPECT_EQ(read_folder(dir).notes.size(), 1U);
  dir.write("b_5.pgm", pgm(1));  // the number 5 for the second time
  EXPECT_TRUE(has_note(read_folder(dir), "not evenly spaced"));
}

TEST(ReadStack, OtherFilesAreNoted) {
  const TempDir dir;
  dir.write("1.pgm", pgm(1));
  dir.write("2.PGM", pgm(2));
  dir.write("notes.txt", "by hand");
  std::filesystem::create_directory(dir.file("folder.pgm"));
  const ReadResult result = read_folder(dir);
  EXPECT_EQ(std::get<Image>(result.data).extents[0], 2);
  EXPECT_TRUE(has_note(result, "2 other files or folders are not read, such as folder.pgm"));
  // Two formats need a choice.
  dir.write("3.tif", bytes_of(page_of_bytes()));
  EXPECT_TRUE(contains(bad_data([&] { read_folder(dir); }), "slices of two formats"));
  EXPECT_EQ(std::get<Image>(read_folder(dir, Format::pgm).data).extents[0], 2);
  EXPECT_EQ(std::get<Image>(read_folder(dir, Format::tiff).data).extents,
            (std::vector<Index>{1, 2, 3}));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { read_folder(dir, Format::npy); }));
}

TEST(ReadStack, SlicesThatDifferAreNamed) {
  const TempDir dir;
  dir.write("1.pgm", pgm(1));
  dir.write("2.pgm", "P2 1 2 255\n1 2\n");
  EXPECT_TRUE(contains(bad_data([&] { read_folder(dir); }),
                       "2.pgm: a slice of another kind, found 1 x 2 pixels of uint8, expected 2 x "
                       "1 pixels of uint8, as in 1.pgm"));
  dir.write("2.pgm", "P2 2 1 256\n1 2\n");
  EXPECT_TRUE(contains(bad_data([&] { read_folder(dir); }), "found 2 x 1 pixels of uint16"));
  const TempDir pages;
  pages.write("1.tif", Tiff{.pages = {page_of_bytes(), page_of_bytes()}}.bytes());
  EXPECT_TRUE(contains(bad_data([&] { read_folder(pages); }), "a slice with several pages"));
  EXPECT_TRUE(contains(bad_data([] { read_folder(TempDir()); }), "no slices"));
}

TEST(ReadStack, OnlyAFolderIsAStack) {
  const TempDir dir;
  const auto file = dir.write("1.pgm", pgm(1));
  EXPECT_TRUE(
      fails_with(ErrorKind::usage, [&] { read_any(file, Format::automatic, {.stack = true}); }));
  EXPECT_TRUE(fails_with(ErrorKind::no_input,
                         [&] { read_any(dir.file("no"), Format::automatic, {.stack = true}); }));
  try {
    read_any(dir.file("."));
    ADD_FAILURE() << "a folder was read as a file";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::no_input);
    EXPECT_TRUE(contains(error.what(), "stack reads the pictures in it as one volume"));
  }
}

TEST(ReadStack, KeepsToTheBudget) {
  const TempDir dir;
  const std::string rows(1'000'000, '\1');
  for (int k = 0; k < 6; ++k) dir.write(std::to_string(k) + ".pgm", "P5 1000 1000 255\n" + rows);
  RunContext context;
  context.memory.set_limit(std::size_t{5} << 20);
  const ReadResult result = read_folder(dir, Format::automatic, {.context = &context});
  const Image& volume = std::get<Image>(result.data);
  EXPECT_TRUE(volume.values.is_in_file());
  EXPECT_EQ(volume.values[5'999'999], 1);
}

}  // namespace
}  // namespace ph::test

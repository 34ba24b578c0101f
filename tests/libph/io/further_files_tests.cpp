// SPDX-License-Identifier: MIT
#include "ph/detail/io/further_files.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include "tests/libph/io/packed.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

using Paths = std::vector<std::filesystem::path>;

const std::string kMeta = "NDims = 2\nDimSize = 2 3\nElementType = MET_UCHAR\nElementDataFile = ";
const std::string kNrrd = "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 2 3\nencoding: raw\n";

TEST(FurtherFiles, DataFilesOfHeaders) {
  const TempDir dir;
  std::filesystem::create_directory(dir.file("in"));
  const auto files_of = [&](const std::string& name, const std::string& bytes,
                            Format format = Format::automatic) {
    return detail::further_files(dir.write(name, bytes), format);
  };
  const Paths data{dir.file("x.raw")};
  EXPECT_EQ(files_of("a.mhd", kMeta + "x.raw\n"), data);
  EXPECT_EQ(files_of("a.nhdr", kNrrd + "data file: x.raw\n"), data);
  EXPECT_EQ(files_of("a.txt", kNrrd + "data file: x.raw\n"), data) << "by its first bytes";
  EXPECT_EQ(files_of("in/a.mhd", kMeta + "../x.raw\n"), Paths{dir.file("in/../x.raw")});
  // The format follows from the extension.
  EXPECT_EQ(files_of("b.mhd", "Comment = none\n" + kMeta + "x.raw\n"), data);
  EXPECT_EQ(files_of("b.mhd.gz", gzipped("Comment = none\n" + kMeta + "x.raw\n")), data);
  EXPECT_EQ(files_of("b.txt", "Comment = none\n" + kMeta + "x.raw\n"), Paths());
  EXPECT_EQ(files_of("b.txt", "Comment = none\n" + kMeta + "x.raw\n", Format::metaimage), data);
  EXPECT_EQ(files_of("a.mhd", kMeta + "x.raw\n", Format::raw), Paths());
  // A compressed header may be longer than the part that decides on the format.
  std::string comments;
  for (int k = 0; k < 20'000; ++k) comments += "# comment " + std::to_string(k) + '\n';
  EXPECT_EQ(files_of("a.nhdr.gz", gzipped(kNrrd + comments + "data file: x.raw\n")), data);
}

TEST(FurtherFiles, OtherFilesHaveNone) {
  const TempDir dir;
  const auto files_of = [&](const std::string& name, const std::string& bytes) {
    return detail::further_files(dir.write(name, bytes));
  };
  EXPECT_EQ(files_of("a.mha", kMeta + "LOCAL\n123456"), Paths());
  EXPECT_EQ(files_of("a.nrrd", kNrrd + "\n123456"), Paths());
  EXPECT_EQ(files_of("a.mhd", kMeta + "LIST\n"), Paths()) << "a header that is refused";
  EXPECT_EQ(files_of("a.csv", "0 0\n1 0\n"), Paths());
  EXPECT_EQ(files_of("a.gz", "\x1F\x8B damaged"), Paths());
  EXPECT_EQ(files_of("a.csv", ""), Paths());
  EXPECT_EQ(detail::further_files(dir.file("missing.mhd")), Paths());
  EXPECT_EQ(detail::further_files("-"), Paths());
  EXPECT_EQ(detail::further_files({}), Paths());
}

TEST(FurtherFiles, SlicesInTheirOrder) {
  const TempDir dir;
  for (const char* name : {"s10.pgm", "s9.pgm", "s1.txt", "s2.pgm"})
    dir.write(name, "P2 1 1 1\n0\n");
  const Paths slices{dir.file("s2.pgm"), dir.file("s9.pgm"), dir.file("s10.pgm")};
  EXPECT_EQ(detail::further_files(dir.file("")), slices);
  dir.write("s3.png", "");
  EXPECT_EQ(detail::further_files(dir.file("")), Paths()) << "two formats are refused";
  EXPECT_EQ(detail::further_files(dir.file(""), Format::pgm), slices);
  EXPECT_EQ(detail::further_files(dir.file(""), Format::png), Paths{dir.file("s3.png")});
  EXPECT_EQ(detail::further_files(dir.file(""), Format::off), Paths());
}

}  // namespace
}  // namespace ph::test

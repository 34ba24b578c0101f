// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "tests/libph/io/images/tiff_file.hpp"

namespace ph::test {
namespace {

TEST(ReadTiff, PagesBecomeAVolume) {
  const std::vector<double> others{1, 1, 2, 3, 5, 8};
  std::vector<double> both = kSix;
  both.insert(both.end(), others.begin(), others.end());
  Tiff tiff{.pages = {page_of_bytes(), page_of_bytes(others)}};
  for (const std::uint64_t compression : {1, 8}) {
    tiff.pages[1].fields[259] = {compression};
    if (compression == 8) tiff.pages[1].strips[0] = zipped(tiff.pages[1].strips[0]);
    const Image image = image_in(tiff.bytes());
    EXPECT_EQ(image.extents, (std::vector<Index>{2, 2, 3}));
    EXPECT_EQ(image.values, both);
  }
  // A page of reduced resolution and a mask are not read, whatever they hold.
  Page small = page_of_bytes(), mask = page_of_bytes();
  small.fields[254] = {1};
  small.fields[259] = {7};
  mask.fields[254] = {4};
  tiff.pages = {page_of_bytes(), small, page_of_bytes(others), mask};
  const ReadResult result = read_tiff(tiff.bytes());
  EXPECT_EQ(std::get<Image>(result.data).values, both);
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_TRUE(contains(result.notes[0].str(), "2 of 4 pages"));
  tiff.pages = {small};
  EXPECT_TRUE(contains(bad_data([&] { image_in(tiff.bytes()); }), "no page of full resolution"));
  // Pages that differ are named.
  tiff.pages = {page_of_bytes(), page_of_bytes()};
  tiff.pages[1].fields[256] = {2};
  tiff.pages[1].fields[257] = {3};
  tiff.pages[1].fields[278] = {3};
  EXPECT_TRUE(contains(bad_data([&] { image_in(tiff.bytes()); }),
                       "page 2, found 2 x 3 pixels of uint8, expected 3 x 2 pixels of uint8, as"));
  tiff.pages[1] = page_of_bytes();
  tiff.pages[1].fields[262] = {0};
  EXPECT_TRUE(contains(bad_data([&] { image_in(tiff.bytes()); }), "another meaning"));
}

TEST(ReadTiff, DescriptionsOfPages) {
  const auto described = [](std::size_t pages, const std::string& text) {
    Tiff tiff;
    for (std::size_t k = 0; k < pages; ++k) tiff.pages.push_back(page_of_bytes());
    tiff.pages[0].description = text;
    return tiff.bytes();
  };
  const auto shape = [&](std::size_t pages, const std::string& text) {
    return image_in(described(pages, text)).extents;
  };
  using Shape = std::vector<Index>;
  EXPECT_EQ(shape(6, "ImageJ=1.53\nimages=6\nslices=6\n"), (Shape{6, 2, 3}));
  EXPECT_EQ(shape(6, "ImageJ=1.53\nimages=6\n"), (Shape{6, 2, 3}));
  EXPECT_EQ(shape(6, "ImageJ=1.53\nimages=6\nslices=3\nframes=2\nhyperstack=true\n"),
            (Shape{2, 3, 2, 3}));
  EXPECT_EQ(shape(6,
                  "<?xml?><OME><Pixels DimensionOrder=\"XYZCT\" SizeC=\"1\" SizeT=\"2\" "
                  "SizeZ=\"3\"/></OME>"),
            (Shape{2, 3, 2, 3}));
  for (const char* text : {"ImageJ=1.53\nimages=6\nchannels=2\nslices=3\n",
                           "<OME SizeC=\"2\" SizeT=\"1\" SizeZ=\"3\""})
    EXPECT_TRUE(contains(bad_data([&] { shape(6, text); }), "save each channel")) << text;
  for (const char* text :
       {"ImageJ=1.53\nimages=7\nslices=7\n", "<OME SizeC=\"1\" SizeT=\"1\" SizeZ=\"7\"",
        "ImageJ=1.53\nimages=6\nslices=4294967296\nframes=4294967296\n"})
    EXPECT_TRUE(contains(bad_data([&] { shape(6, text); }), "number of images, found 6")) << text;
  EXPECT_TRUE(contains(bad_data([&] {
                         shape(6,
                               "<OME DimensionOrder=\"XYTZC\" SizeC=\"1\" SizeT=\"2\" SizeZ=\"3\"");
                       }),
                       "order of the pages"));
  // ImageJ writes large stacks as one page, behind which all images follow.
  std::string three = strip<std::uint8_t>(kSix, false);
  three += three + three;
  const auto long_file = [&](const std::string& text, std::uint64_t compression) {
    return changed([&](Page& page) {
      page.description = text;
      page.fields[259] = {compression};
      page.strips = {three};
    });
  };
  const Image image = image_in(long_file("ImageJ=1.53\nimages=3\nslices=3\n", 1));
  EXPECT_EQ(image.extents, (Shape{3, 2, 3}));
  EXPECT_EQ(image.values[17], 1);
  EXPECT_TRUE(contains(bad_data([&] { image_in(long_file("ImageJ=1.53\nimages=99\n", 1)); }),
                       "is the file truncated?"));
  EXPECT_TRUE(contains(bad_data([&] { image_in(long_file("ImageJ=1.53\nimages=3\n", 32773)); }),
                       "without compression"));
}

TEST(ReadTiff, ChannelsOfColours) {
  const auto colours = [](std::uint64_t samples, const std::string& pixels) {
    return changed([&](Page& page) {
      page.fields[256] = {2};
      page.fields[257] = {1};
      page.fields[258] = std::vector<std::uint64_t>(samples, 8);
      page.fields[262] = {samples < 3 ? 1U : 2U};
      page.fields[277] = {samples};
      page.fields[339] = std::vector<std::uint64_t>(samples, 1);
      page.strips = {pixels};
    });
  };
  const std::string rgb = colours(3, "\1\2\3\4\5\6");
  EXPECT_TRUE(
      contains(bad_data([&] { image_in(rgb); }), "channel grey, red, green or blue takes one"));
  EXPECT_EQ(image_in(rgb, {.channel = Channel::green}).values, (std::vector<double>{2, 5}));
  EXPECT_EQ(image_in(rgb, {.channel = Channel::green}).extents, (std::vector<Index>{1, 2}));
  EXPECT_EQ(image_in(colours(4, "\1\2\3\4\5\6\7\x8"), {.channel = Channel::alpha}).values,
            (std::vector<double>{4, 8}));
  EXPECT_EQ(image_in(colours(3, "\1\1\1\4\4\4")).values, (std::vector<double>{1, 4}));
  EXPECT_EQ(image_in(colours(2, "\1\xFF\4\xFF")).values, (std::vector<double>{1, 4}));
  EXPECT_EQ(image_in(bytes_of(page_of_bytes()), {.channel = Channel::grey}).values, kSix);
  EXPECT_TRUE(
      contains(bad_data([] { image_in(bytes_of(page_of_bytes()), {.channel = Channel::red}); }),
               "no channel red"));
  Tiff tiff{.pages = {page_of_bytes(), page_of_bytes()}};
  for (Page& page : tiff.pages) {
    page.fields[256] = {1};
    page.fields[258] = page.fields[339] = {};
    page.fields.erase(258);
    page.fields.erase(339);
    page.fields[258] = {8, 8, 8};
    page.fields[262] = {2};
    page.fields[277] = {3};
  }
  const Image volume = image_in(tiff.bytes(), {.channel = Channel::blue});
  EXPECT_EQ(volume.extents, (std::vector<Index>{2, 2, 1}));
  EXPECT_EQ(volume.values, (std::vector<double>{2, 1, 2, 1}));
}

TEST(ReadTiff, WhiteIsZeroIsNoted) {
  const ReadResult result = read_tiff(changed([](Page& page) { page.fields[262] = {0}; }));
  EXPECT_EQ(std::get<Image>(result.data).values, kSix);
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_TRUE(contains(result.notes[0].str(), "0 is white"));
}

}  // namespace
}  // namespace ph::test

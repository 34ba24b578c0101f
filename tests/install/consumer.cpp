// SPDX-License-Identifier: MIT
// A program like a user's, with the includes that users write. It calls a function of each library.
#include <ph/ph.hpp>
#ifndef CORE_ALONE
#include <ph/io/read.hpp>
#endif
#ifdef WITH_SEGMENT
#include <ph/segment.hpp>
#endif
#ifdef WITH_REPORT
#include <ph/report.hpp>
#include <ph/scene_report.hpp>
#endif
#ifdef WITH_ALPHA
#include <ph/alpha.hpp>
#endif
#ifdef WITH_PCL
#include <ph/pcl.hpp>
#endif

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

int main(int argc, char** argv) try {
  // Users choose their own warnings. In libph's own build, this conversion would be an error.
  const int three = 3.5;
#ifdef CORE_ALONE
  const ph::Points points{{0, 0}, {1, 0}, {1, 1}, {0, 1.25}};
#else
  const ph::Points points = ph::read_points(argc > 1 ? argv[1] : "-");
#endif
  const ph::Barcode bars = ph::persistence(ph::Rips(points));
  std::printf("%d points, %d loops\n", static_cast<int>(points.rows()),
              static_cast<int>(bars.bars(1).size()));
#ifdef WITH_ALPHA
  const ph::Alpha alpha(points);
  std::printf("%d loops of balls\n", static_cast<int>(ph::persistence(alpha).bars(1).size()));
#endif
#ifdef WITH_SEGMENT
  const float xyz[] = {0, 0, 1, 0, 0, 1.001F, 0, 0, 1.002F};
  const auto parts = ph::segment::segment({xyz, {}}, {.min_size = 1, .plane = false});
  std::printf("%d segment\n", static_cast<int>(parts.cut.segments.size()));
#endif
#ifdef WITH_REPORT
  const auto is_whole = [](const auto& page) {
    std::string text;
    ph::report::write_page([&](std::string_view part) { text += part; }, page,
                           ph::default_context());
    return text.starts_with("<!DOCTYPE html>") && text.ends_with("</html>\n");
  };
  try {
    std::printf("%d pages\n", is_whole(ph::report::BarcodePage{"bars", bars}) +
                                  is_whole(ph::report::ScenePage{"parts", parts}));
  } catch (const ph::Error& error) {  // libph was built without npm
    if (error.kind() != ph::ErrorKind::not_built_in) throw;
    std::puts("0 pages are built in");
  }
#endif
#ifdef WITH_PCL
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int i = 0; i < three; ++i) cloud.emplace_back(0.001F * static_cast<float>(i), 0.F, 1.F);
  const auto same = ph::pcl::segment_cloud(cloud, {.min_size = 1, .plane = false});
  std::printf("%d segment of a PCL cloud\n", static_cast<int>(same.cut.segments.size()));
#endif
  return argc > three;
} catch (const std::exception& error) {
  std::puts(error.what());
  return 1;
}

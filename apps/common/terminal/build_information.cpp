// SPDX-License-Identifier: MIT
#include "apps/common/terminal/build_information.hpp"

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <Eigen/src/Core/util/Macros.h>  // all of Eigen takes seconds to compile
#include <CLI/Version.hpp>
#include <string_view>

#include "ph/detail/report/page_template.hpp"
#include "ph/io/plot.hpp"

namespace ph::app {
namespace {

constexpr std::string_view compiler_name() {
#ifdef __clang__
  return "clang++";
#else
  return "g++";
#endif
}

constexpr std::string_view assertions() {
#ifdef NDEBUG
  return "off";
#else
  return "on";
#endif
}

std::string_view yes_or_no(bool built_in) { return built_in ? "built in" : "not built in"; }

std::string fmt_version() {
  return fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
}

std::string eigen_version() {
  return fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
}

}  // namespace

std::string build_information() {
  const std::string_view flags = PH_CXX_FLAGS;
  std::string text;
  const auto line = [&](std::string_view name, std::string_view value) {
    text += fmt::format("{:<11} {}\n", name, value);
  };
  line("compiler", fmt::format("{} {}", compiler_name(), __VERSION__));
  line("C++", fmt::format("{}", __cplusplus));
  line("build type", PH_BUILD_TYPE);
  if (!flags.empty()) line("flags", flags);
  line("assertions", assertions());
  line("Eigen", eigen_version());
  line("fmt", fmt_version());
  line("CLI11", CLI11_VERSION);
  line("linked", PH_IS_STATIC ? "statically" : "dynamically");
  // This is the version of the library in use. A shared library may be newer than its headers.
  line("libpng", png_get_libpng_ver(nullptr));
  line("PNG plots", png_plot_support().empty() ? "no" : png_plot_support());
  line("zlib", zlibVersion());
  line("PCL", fmt::format("{} (ph::pcl; the programs do without)", yes_or_no(PH_WITH_PCL)));
  line("reports", yes_or_no(!report::page_template().empty()));
  return text;
}

std::string program_and_version(const std::string& program) {
  return fmt::format("{} {}", program, PH_VERSION);
}

}  // namespace ph::app

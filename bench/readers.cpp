// SPDX-License-Identifier: MIT
// Compares readers with PCL's, if PCL is built in: bench_readers [FILE.pcd…] [--benchmark_…].
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"
#ifdef PH_WITH_PCL
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>
#endif

namespace {

std::filesystem::path write_csv(int rows) {
  const auto path = std::filesystem::temp_directory_path() / "ph_bench_points.csv";
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::ofstream out(path);
  for (int i = 0; i < rows; ++i)
    out << fmt::format("{},{},{}\n", uniform(random), uniform(random), uniform(random));
  return path;
}

void count_bytes(benchmark::State& state, const std::filesystem::path& path) {
  state.SetBytesProcessed(static_cast<std::int64_t>(std::filesystem::file_size(path)) *
                          static_cast<std::int64_t>(state.iterations()));
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const auto csv = write_csv(300000);
  benchmark::RegisterBenchmark("csv_points", [&](auto& state) {
    for (auto _ : state) benchmark::DoNotOptimize(ph::read_points(csv).size());
    count_bytes(state, csv);
  })->Unit(benchmark::kMillisecond);
  for (int i = 1; i < argc; ++i) {
    const std::filesystem::path path = argv[i];
    const std::string name = path.stem().string();
    benchmark::RegisterBenchmark((name + "/libph").c_str(), [=](auto& state) {
      for (auto _ : state) benchmark::DoNotOptimize(ph::read_cloud(path).size());
      count_bytes(state, path);
    })->Unit(benchmark::kMillisecond);
#ifdef PH_WITH_PCL
    benchmark::RegisterBenchmark((name + "/pcl").c_str(), [=](auto& state) {
      for (auto _ : state) {
        pcl::PCLPointCloud2 cloud;
        benchmark::DoNotOptimize(pcl::io::loadPCDFile(path.string(), cloud));
      }
      count_bytes(state, path);
    })->Unit(benchmark::kMillisecond);
#endif
  }
  benchmark::RunSpecifiedBenchmarks();
  std::filesystem::remove(csv);
}

// SPDX-License-Identifier: MIT
// Tests what the library does if memory runs out at any moment: it throws std::bad_alloc or Error
// (resource), leaks nothing, and leaves no incomplete file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <new>
#include <sstream>

#include "ph/io/cloud.hpp"
#include "ph/io/plot.hpp"
#include "ph/io/read.hpp"
#include "ph/io/write.hpp"
#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "ph/segment.hpp"

namespace {

// Allocations are counted while `armed` is true. Allocation number `fail_at` fails, and so does
// each allocation from number `fail_from` onwards.
std::atomic<bool> armed = false;
std::atomic<long> calls = 0, live = 0;
long fail_at = 0, fail_from = 0;

bool fails() {
  if (!armed) return false;
  const long call = ++calls;
  return call == fail_at || (fail_from != 0 && call >= fail_from);
}

void* allocate(std::size_t size, std::size_t alignment) {
  if (fails()) throw std::bad_alloc();
  const std::size_t rounded = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment;
  void* const memory = alignment <= alignof(std::max_align_t)
                           ? std::malloc(rounded * alignment)
                           : std::aligned_alloc(alignment, rounded * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  ++live;
  return memory;
}

void release(void* memory) noexcept {
  if (memory != nullptr) --live;
  std::free(memory);
}

void* allocate_or_null(std::size_t size) noexcept {
  try {
    return allocate(size, 1);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

}  // namespace

// Replaces all forms of new and delete. Otherwise a sanitizer would supply the missing forms, and
// these would bypass the counters.
using Align = std::align_val_t;
using NoThrow = std::nothrow_t;
void* operator new(std::size_t size) { return allocate(size, 1); }
void* operator new[](std::size_t size) { return allocate(size, 1); }
void* operator new(std::size_t size, Align a) { return allocate(size, std::size_t(a)); }
void* operator new[](std::size_t size, Align a) { return allocate(size, std::size_t(a)); }
void* operator new(std::size_t size, const NoThrow&) noexcept { return allocate_or_null(size); }
void* operator new[](std::size_t size, const NoThrow&) noexcept { return allocate_or_null(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, Align) noexcept { release(memory); }
void operator delete[](void* memory, Align) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, Align) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, Align) noexcept { release(memory); }
void operator delete(void* memory, const NoThrow&) noexcept { release(memory); }
void operator delete[](void* memory, const NoThrow&) noexcept { release(memory); }

namespace ph {
namespace {

namespace fs = std::filesystem;

/// Creates a folder with small inputs. Its folder "out" has the files of the last run.
class Allocation : public testing::Test {
 protected:
  using Files = std::map<std::string, std::string>;

  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "ph-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    fs::create_directory(folder_ / "out");
    put("square.csv", "0,0\n1,0\n1,1\n0,1.25\n0.5,2\n");
    put("lower.txt", "1\n3 2\n2 2 2\n");
    put("sparse.txt", "0 1 1\n1 2 2\n0 2 2.5\n");
    put("triangle.txt", "0 : 0\n1 : 0\n2 : 0\n0 1 : 1\n1 2 : 2\n0 2 : 3\n0 1 2 : 4\n");
    put("triangle.phat", "0\n0\n0\n1 0 1\n1 1 2\n1 0 2\n2 3 4 5\n");
    put("ring.pgm", "P2\n3 3\n9\n0 1 2\n1 9 3\n2 3 4\n");
    put("mesh.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string out(const std::string& name) const { return (folder_ / "out" / name).string(); }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(in(name), std::ios::binary) << text;
  }
  /// Returns the contents of the files that a run has left behind, and removes the files.
  Files outputs() const {
    Files files;
    for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
      std::ostringstream text;
      text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      files[entry.path().filename()] = text.str();
      fs::remove(entry.path());
    }
    return files;
  }

  /// Runs while some allocations fail.
  /// @param at the number of a single allocation that fails; 0 for none.
  /// @param from all allocations from this number on fail; 0 for none.
  /// @return true if the run finished.
  static bool survives(const std::function<void()>& run, long at, long from) {
    fail_at = at;
    fail_from = from;
    calls = 0;
    bool done = false;
    std::string wrong;
    armed = true;
    try {
      run();
      done = true;
    } catch (const std::bad_alloc&) {
    } catch (const Error& error) {
      armed = false;
      if (error.kind() != ErrorKind::resource) wrong = error.what();
    } catch (const std::exception& error) {
      armed = false;
      wrong = error.what();
    }
    armed = false;
    EXPECT_EQ(wrong, "");
    return done;
  }

  /// Makes allocations of a run fail, each of them once alone and once together with all later
  /// allocations.
  void check(const std::function<void()>& run) {
    run();  // creates the objects that exist once per process
    outputs();
    ASSERT_TRUE(survives(run, 0, 0));
    const long total = calls;
    const Files want = outputs();
    ASSERT_GT(total, 10) << "the library allocates elsewhere";
    RecordProperty("allocations", static_cast<int>(total));
    // If there are few allocations, tests all of them. Otherwise the step is odd: if a loop makes
    // an even number of allocations, an even step could miss the same allocations in every round.
    const long step = total <= 4000 ? 1 : total / 2000 | 1;
    for (const bool once : {true, false}) {
      for (long n = 1; n <= total; n += step) {
        SCOPED_TRACE((once ? "allocation " : "from allocation ") + std::to_string(n) + " of " +
                     std::to_string(total));
        const long before = live;
        const bool done = survives(run, once ? n : 0, once ? 0 : n);
        EXPECT_EQ(live - before, 0) << "leaked";
        const Files left = outputs();
        if (done) {
          EXPECT_EQ(left.size(), want.size()) << "it claims to have come to its end";
        }
        for (const auto& [name, text] : left)
          EXPECT_TRUE(want.contains(name) && text == want.at(name)) << name << " is not complete";
        if (HasFailure()) return;
      }
    }
  }

  void write(const Barcode& bars, BarcodeFormat format) const {
    OutputFile file(out(std::string(barcode_format_name(format))));
    BarcodeInfo info;
    info.program = "a name that is too long for a small string";
    info.timings = {{"read", 0.5}};
    write_barcode(file, bars, format, {.info = &info});
    file.commit();
  }
  void write_text(const std::string& name, const std::function<void(std::ostream&)>& put_to) const {
    OutputFile file(out(name));
    OutputStream stream(file);
    put_to(stream);
    file.commit();
  }

 private:
  fs::path folder_;
};

TEST_F(Allocation, PointsToRipsByEachEngine) {
  for (const Engine engine : {Engine::standard, Engine::twist, Engine::cohomology}) {
    SCOPED_TRACE(engine.name());
    check([&] {
      const RunContext context;
      const Points points = read_points(in("square.csv"), {.context = &context});
      const Rips rips(points, {}, context);
      const Barcode bars = persistence(rips, {.max_dim = 2, .field = 3, .engine = engine}, context);
      write(bars, BarcodeFormat::csv);
      write(bars, BarcodeFormat::json);
    });
  }
}

TEST_F(Allocation, ComponentsByUnionFind) {
  check([&] {
    const Points points = read_points(in("square.csv"));
    write(persistence(Rips(points), {.max_dim = 0, .engine = Engine::union_find}),
          BarcodeFormat::npy);
  });
}

TEST_F(Allocation, Representatives) {
  for (const auto wanted : {Representatives::cycles, Representatives::cocycles}) {
    check([&] {
      const Points points = read_points(in("square.csv"));
      write(persistence(Rips(points), {.representatives = wanted}), BarcodeFormat::json);
    });
  }
}

TEST_F(Allocation, Distances) {
  check([&] {
    write(persistence(Rips(read_lower_distances(in("lower.txt")))), BarcodeFormat::ripser);
    write(persistence(Rips(read_sparse(in("sparse.txt")))), BarcodeFormat::pers);
  });
}

TEST_F(Allocation, Images) {
  for (const Engine engine : {Engine::standard, Engine::twist, Engine::cohomology}) {
    check([&] {
      write(persistence(Cubical(read_image(in("ring.pgm"))), {.engine = engine}),
            BarcodeFormat::dipha);
    });
  }
}

TEST_F(Allocation, SimplicesMatricesAndMeshes) {
  check([&] {
    const SimplicesInput input = read_simplices(in("triangle.txt"));
    write(persistence(ExplicitComplex::from_simplices(input.simplices, input.namer())),
          BarcodeFormat::csv);
  });
  check([&] {
    const BoundaryInput input = read_phat(in("triangle.phat"));
    write(persistence(ExplicitComplex::from_boundary(input.matrix, input.namer())),
          BarcodeFormat::csv);
  });
  check([&] {
    const ReadResult result = read_any(in("mesh.off"));
    write(persistence(Rips(std::get<Mesh>(result.data).vertices)), BarcodeFormat::csv);
  });
}

TEST_F(Allocation, Plots) {
  const Barcode bars = persistence(Rips(read_points(in("square.csv"))));
  for (const PlotKind kind : {PlotKind::barcode, PlotKind::diagram, PlotKind::betti}) {
    PlotOptions options;
    options.kind = kind;
    check([&] { write_file(out("plot.svg"), svg_plot(bars, options)); });
  }
  if (!png_plot_support().empty()) check([&] { write_file(out("plot.png"), png_plot(bars)); });
  const MergeTree tree = merge_tree(Rips(read_points(in("square.csv"))));
  check([&] { write_file(out("plot.svg"), svg_plot(tree.branches())); });
}

/// A cloud of 12 x 12 points: a table with a box on it.
Cloud table() {
  Cloud cloud;
  cloud.width = cloud.height = 12;
  for (const char* name : {"x", "y", "z"}) cloud.add_field(name, FieldType::float32);
  std::vector<float> xyz;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) {
      const bool box = x >= 4 && x < 8 && y >= 4 && y < 8;
      for (const float v :
           {0.01F * static_cast<float>(x), 0.01F * static_cast<float>(y), box ? 0.9F : 1.0F})
        xyz.push_back(v);
    }
  cloud.data.resize(xyz.size() * sizeof(float));
  std::copy_n(reinterpret_cast<const std::byte*>(xyz.data()), cloud.data.size(),
              cloud.data.begin());
  return cloud;
}

TEST_F(Allocation, Segmentation) {
  const Cloud scene = table();
  for (const PcdData data : {PcdData::ascii, PcdData::binary, PcdData::binary_compressed}) {
    {
      std::ofstream file(in("table.pcd"), std::ios::binary);
      write_pcd(file, scene, data);
    }
    check([&] {
      const Cloud cloud = segment::read_cloud(in("table.pcd"));
      const auto result = segment::segment(cloud, {.min_size = 1});
      segment::write_cloud(out("labels.pcd"), cloud, result.cut.labels);
    });
  }
}

TEST_F(Allocation, CloudsInOtherFormats) {
  const Cloud scene = table();
  check([&] { write_text("ascii.ply", [&](auto& to) { write_ply(to, scene, PlyData::ascii); }); });
  check([&] {
    write_text("table.ply", [&](auto& to) { write_ply(to, scene, PlyData::little_endian); });
    write_text("table.pcd", [&](auto& to) { write_pcd(to, scene, PcdData::ascii); });
  });
  {
    std::ofstream file(in("table.ply"), std::ios::binary);
    write_ply(file, scene);
  }
  put("table.xyz", "0 0 1\n0 0.01 1\n0.01 0 1\n");
  check([&] {
    read_cloud(in("table.ply"));
    read_cloud(in("table.xyz"));
  });
}

}  // namespace
}  // namespace ph

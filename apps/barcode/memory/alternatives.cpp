// SPDX-License-Identifier: MIT
#include "barcode/memory/alternatives.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <new>
#include <optional>
#include <random>
#include <stop_token>
#include <utility>
#include <vector>

#include "barcode/complex/build_complex.hpp"
#include "barcode/complex/read_input.hpp"
#include "common/arguments/numbers.hpp"
#include "core/format_size.hpp"
#include "core/system/files.hpp"
#include "ph/estimate.hpp"

namespace ph::barcode {
namespace {

constexpr std::size_t kMostAlternatives = 3;
// An estimate counts the pages of the code and small containers; the limit does not.
constexpr double kBesideLimit = 4 << 20;
// CPU time after which no trial begins, and after twice of which none goes on: who waits for an
// error should not wait long.
constexpr double kPatience = 3;  // s
// Of what is left of the memory limit, for a trial: the heap is in pieces by now.
constexpr double kTrialShare = 0.75;
constexpr double kBytesPerEdge = 16;
constexpr double kFewestPairs = 100;  // of a sample, within the threshold
// A sample of fewer points says little; one for which more distances are evaluated takes too long.
constexpr Index kFewestPoints = 20;
constexpr double kMostDistances = 2e8;

/// Distances of pairs taken at random, ascending: how many edges a threshold leaves.
template <Metric M>
std::vector<double> sample_of(const M& metric) {
  constexpr int count = 20000;
  std::vector<double> sample;
  if (metric.size() < 2) return sample;
  std::mt19937_64 random(1);
  const auto point = [&] {
    return static_cast<Index>(random() % static_cast<std::uint64_t>(metric.size()));
  };
  for (int i = 0; i < count; ++i)
    if (const Index a = point(), b = point(); a != b) sample.push_back(metric(a, b));
  std::ranges::sort(sample);
  return sample;
}
std::vector<double> sample_of(const SparseDistances& distances) {
  std::vector<double> sample;
  for (const WeightedEdge& e : distances.edges()) sample.push_back(e.value);
  std::ranges::sort(sample);
  return sample;
}

bool is_image(const NamedData& data) { return std::holds_alternative<Image>(data.read.data); }

class Alternatives {
 public:
  Alternatives(const NamedData& data, const Arguments& arguments, const RunContext& context)
      : data_(data), arguments_(arguments), context_(context) {}

  std::vector<std::string> find() {
    const bool is_rips =
        !arguments_.voxel &&
        (arguments_.complex == ComplexKind::automatic || arguments_.complex == ComplexKind::rips) &&
        std::visit([&](const auto& data) { return sample(data); }, data_.read.data);
    if (arguments_.options.engine != Engine::automatic) change_engine();
    if (arguments_.options.representatives != Representatives::none) drop_representatives();
    // What is quick to try comes first: patience ends.
    lower_dimension(arguments_);
    if (arguments_.voxel) larger_voxel();
    if (is_rips) {
      subsample();
      lower_threshold();
      if (arguments_.options.collapse != Collapse::on) collapse();
    }
    return std::move(found_);
  }

 private:
  // What becomes a Rips complex has distances to sample.
  bool sample(const Points& points) {
    points_ = points.rows();
    sample_ = sample_of(PointMetric(points, arguments_.rips.distance, arguments_.rips.minkowski_p));
    pairs_ = pairs_of(points.rows());
    return true;
  }
  bool sample(const DistanceMatrix& distances) {
    points_ = distances.size();
    sample_ = sample_of(distances);
    pairs_ = pairs_of(distances.size());
    return true;
  }
  bool sample(const SparseDistances& distances) {
    sample_ = sample_of(distances);
    pairs_ = static_cast<double>(sample_.size());
    return true;
  }
  bool sample(const Mesh& mesh) { return mesh.values.empty() && sample(mesh.vertices); }
  template <class Other>
  bool sample(const Other&) {
    return false;
  }

  static double pairs_of(Index points) {
    return static_cast<double>(points) * static_cast<double>(points - 1) / 2;
  }

  static double seconds_since(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  bool is_enough() const {
    return found_.size() == kMostAlternatives || seconds_since(start_) > kPatience;
  }

  /// Keeps a change of the command line if the run fits with it. @return whether it does.
  bool try_out(const std::string& change, const Arguments& arguments) {
    if (is_enough()) return false;
    // A trial ends when patience does.
    std::stop_source stop;
    const std::stop_callback stop_with_all(context_.stop, [&] { stop.request_stop(); });
    RunContext trial;
    trial.stop = stop.get_token();
    trial.threads = context_.threads;
    trial.memory.set_limit(static_cast<std::size_t>(
        kTrialShare * static_cast<double>(context_.memory.limit() - context_.memory.used())));
    trial.on_progress = [&](const Progress& progress) {
      if (seconds_since(start_) > 2 * kPatience) stop.request_stop();
      if (context_.on_progress) context_.on_progress(progress);
    };
    try {
      const BuiltComplex built =
          build_complex(data_.read, data_.name, data_.dropped, arguments, trial);
      const Estimate e = estimate(built.complex, arguments.options, trial);
      const auto limit = static_cast<double>(context_.memory.limit());
      // Images in slabs fit themselves to the limit: beside a small one that would be all.
      const double beside = is_image(data_) ? std::min(kBesideLimit, limit / 4) : kBesideLimit;
      if (e.bytes_high > limit + beside) return false;
      found_.push_back(fmt::format("{} ({} to {})", change, format_size(e.bytes_low),
                                   format_size(e.bytes_high)));
      return true;
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::cancelled) context_.poll();  // who stopped it?
      return false;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

  void change_engine() {
    Arguments changed = arguments_;
    changed.options.engine = Engine::automatic;
    try_out("--engine auto", changed);
  }

  /// Where there can be no loops --loops is refused.
  static std::string without_loops(const std::string& change, Arguments& changed) {
    return std::exchange(changed.loops, std::nullopt) ? change + " without --loops" : change;
  }

  /// If that is not enough, in lower dimensions.
  void drop_representatives() {
    Arguments changed = arguments_;
    changed.options.representatives = Representatives::none;
    const std::string text = without_loops("--representatives none", changed);
    if (!try_out(text, changed)) lower_dimension(changed, text + " ");
  }

  /// Keeps a threshold that fits. @return whether it does.
  bool try_threshold(double threshold) {
    Arguments changed = arguments_;
    const std::string text = fmt::format("{:.3g}", threshold);
    changed.threshold = app::parse_number("--threshold", text);
    return std::isfinite(*changed.threshold) && try_out("--threshold " + text, changed);
  }

  /// The largest of a few thresholds: they leave a half of the edges, a fifth, … or, where so few
  /// pairs are edges that the sample does not say how many, three quarters of the threshold, a
  /// half, …
  void lower_threshold() {
    const double highest = arguments_.threshold.value_or(std::numeric_limits<double>::infinity());
    const auto within =
        static_cast<double>(std::ranges::upper_bound(sample_, highest) - sample_.begin());
    if (arguments_.threshold && within < kFewestPairs) {
      for (const double share : {0.75, 0.5, 0.25, 0.1})
        if (try_threshold(share * highest)) return;
      return;
    }
    for (const double share : {0.5, 0.2, 0.05, 0.01, 0.002, 0.0005}) {
      const auto place = static_cast<std::size_t>(share * within);
      if (place < 4) return;  // the sample is too small to say
      const double edges =
          pairs_ * static_cast<double>(place) / static_cast<double>(sample_.size());
      if (kBytesPerEdge * edges > static_cast<double>(context_.memory.limit())) continue;
      if (try_threshold(sample_[place])) return;
    }
  }

  /// The highest of the lower dimensions. @param others what else is changed.
  void lower_dimension(Arguments changed, std::string_view others = "") {
    const int highest = arguments_.options.max_dim.value_or(default_max_dim());
    for (int dim = highest - 1; dim >= arguments_.options.min_dim; --dim) {
      changed.options.max_dim = dim;
      std::string text = fmt::format("{}--max-dim {}", others, dim);
      if (dim == 0) text = without_loops(text, changed);
      if (try_out(text, changed)) return;
    }
  }

  /// The smallest of a few larger voxels.
  void larger_voxel() {
    for (const double times : {1.5, 2.0, 4.0, 8.0, 16.0}) {
      Arguments changed = arguments_;
      const std::string text = fmt::format("{:.3g}", times * *arguments_.voxel);
      changed.voxel = app::parse_number("--voxel", text);
      if (try_out("--voxel " + text, changed)) return;
    }
  }

  void collapse() {
    Arguments changed = arguments_;
    changed.options.collapse = Collapse::on;
    try_out("--collapse on", changed);
  }

  /// The largest of a few samples of the points.
  void subsample() {
    const bool is_weighted = arguments_.dtm || !arguments_.vertex_weights.empty() ||
                             arguments_.read.diagonal == Diagonal::births;
    if (arguments_.subsample || is_weighted) return;
    for (const Index divisor : {2, 5, 20, 100, 500}) {
      const Index points = points_ / divisor;
      if (points < kFewestPoints) return;
      const double evaluated = static_cast<double>(points) * static_cast<double>(points_);
      if (evaluated > kMostDistances ||
          kBytesPerEdge * pairs_of(points) > static_cast<double>(context_.memory.limit()))
        continue;
      Arguments changed = arguments_;
      changed.subsample = GreedyLimits{.points = points};
      if (try_out(fmt::format("--subsample {}", points), changed)) return;
    }
  }

  int default_max_dim() const {
    if (const auto* image = std::get_if<Image>(&data_.read.data)) {
      const auto& periodic = arguments_.cubical.periodic;
      const auto axes = static_cast<std::ptrdiff_t>(image->dim());
      // Bars of as many dimensions as there are axes are there only on a torus.
      const bool is_torus = std::count(periodic.begin(), periodic.end(), true) >= axes;
      return static_cast<int>(axes) - (is_torus ? 0 : 1);
    }
    if (const auto* points = std::get_if<Points>(&data_.read.data); points && arguments_.voxel)
      return static_cast<int>(points->cols());
    return 1;
  }

  const NamedData& data_;
  const Arguments& arguments_;
  const RunContext& context_;
  std::clock_t start_ = std::clock();
  Index points_ = 0;  // 0: not known
  double pairs_ = 0;  // that the sample stands for
  std::vector<double> sample_;
  std::vector<std::string> found_;
};

}  // namespace

std::string alternatives(const Job& job, const Arguments& arguments, app::Session& session) {
  if (job.input == "-") return "";  // was read and is gone
  try {
    const Input input =
        Input::open(files::path_of(job.input), &session.context(), Input::Excess::stays_in_file);
    const NamedData data = read_input(input, arguments, session.context());
    const auto found = Alternatives(data, arguments, session.context()).find();
    if (found.empty()) return "";
    // How many cells of an image are critical no estimate knows.
    return fmt::format("what {} fit: {}", is_image(data) ? "may" : "would", fmt::join(found, "; "));
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    return "";
  } catch (const std::bad_alloc&) {
    return "";
  }
}

}  // namespace ph::barcode

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <new>
#include <optional>
#include <stop_token>
#include <utility>

#include "ph/detail/core/floating.hpp"
#include "ph/estimate.hpp"

namespace ph {
namespace {

constexpr std::size_t kMostFits = 3;
// An estimate may exceed the memory limit by this number of bytes, because only the estimate counts
// pages of code and small containers.
constexpr double kBesideLimit = 4 << 20;
// The number of CPU seconds after which no trial begins. Trials are stopped after twice that time.
// The time is short because the user is waiting for an error message.
constexpr double kPatience = 3;  // in seconds
// The share of the remaining memory that a trial may use. It is less than 1, because the heap is
// fragmented.
constexpr double kTrialShare = 0.75;
constexpr double kBytesPerEdge = 16;
constexpr double kFewestPairs = 100;  // the least number of sampled pairs within the threshold
// A sample of fewer points than kFewestPoints says little about the memory. A sample with more
// distances than kMostDistances takes too long.
constexpr Index kFewestPoints = 20;
constexpr double kMostDistances = 2e8;

double pairs_of(Index points) {
  return static_cast<double>(points) * static_cast<double>(points - 1) / 2;
}

class Search {
 public:
  Search(const AnyComplex& complex, const Options& options, const RunContext& context)
      : complex_(complex),
        rips_(std::get_if<Rips>(&complex)),
        options_(options),
        context_(context) {}

  std::vector<Fit> run() {
    if (options_.engine != Engine::automatic) {
      Options changed = options_;
      changed.engine = Engine::automatic;
      try_task(changed, {{Setting::engine, "auto"}});
    }
    if (options_.representatives != Representatives::none) drop_representatives();
    // Changes that are quick to try come first, because time is limited.
    lower_dimension(options_, {});
    if (rips_ && rips_->has_form(RipsForm::edges)) {
      sample_ = rips_->sample(context_);
      subsample();
      lower_threshold();
      if (options_.collapse != Collapse::on) {
        Options changed = options_;
        changed.collapse = Collapse::on;
        try_task(changed, {{Setting::collapse, "on"}});
      }
    }
    return std::move(found_);
  }

 private:
  static double seconds_since(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  bool is_enough() const { return found_.size() == kMostFits || seconds_since(start_) > kPatience; }

  /// Tries a run with some changes, and keeps the changes if the run fits into memory. @param make
  /// returns the complex, built in the context of the trial. @return true if the run fits.
  template <class Make>
  bool try_out(const Options& options, std::vector<Remedy> changes, Make&& make) {
    if (is_enough()) return false;
    // A trial is stopped when time is up.
    std::stop_source stop;
    const std::stop_callback stop_with_all(context_.stop, [&] { stop.request_stop(); });
    RunContext trial;
    trial.stop = stop.get_token();
    trial.threads = context_.threads;
    const auto left = static_cast<double>(
        context_.memory.limit() - std::min(context_.memory.used(), context_.memory.limit()));
    trial.memory.set_limit(static_cast<std::size_t>(kTrialShare * left));
    trial.on_progress = [&](const Progress& progress) {
      if (seconds_since(start_) > 2 * kPatience) stop.request_stop();
      if (context_.on_progress) context_.on_progress(progress);
    };
    try {
      const AnyComplex complex = make(trial);
      const Estimate e = estimate(complex, options, trial);
      const auto limit = static_cast<double>(context_.memory.limit());
      // A run on an image works in slabs and adapts to the limit. With a small limit, the full
      // allowance would be so large that almost every run would seem to fit.
      const bool is_image = std::holds_alternative<Cubical>(complex);
      const double beside = is_image ? std::min(kBesideLimit, limit / 4) : kBesideLimit;
      if (e.bytes_high > limit + beside) return false;
      found_.push_back({std::move(changes), e.bytes_low, e.bytes_high});
      return true;
    } catch (const Error& error) {
      // The call throws if the caller has requested a stop.
      if (error.kind() == ErrorKind::cancelled) context_.poll();
      return false;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }
  bool try_task(const Options& options, std::vector<Remedy> changes) {
    return try_out(options, std::move(changes), [&](const RunContext& trial) {
      // The trial gets a copy of the filtration, so that nothing that the trial makes is kept.
      return rips_ && rips_->has_form(RipsForm::edges)
                 ? AnyComplex(rips_->with(rips_->options(), trial))
                 : complex_;
    });
  }
  bool try_question(RipsOptions question, std::vector<Remedy> changes) {
    return try_out(options_, std::move(changes), [&](const RunContext& trial) {
      return AnyComplex(rips_->with(std::move(question), trial));
    });
  }

  /// Drops representatives. If that is not enough, drops dimensions as well.
  void drop_representatives() {
    Options changed = options_;
    changed.representatives = Representatives::none;
    const std::vector<Remedy> changes{{Setting::representatives, "none"}};
    if (!try_task(changed, changes)) lower_dimension(changed, changes);
  }

  /// Tries lower dimensions and keeps the highest dimension that fits. @param others changes that
  /// were made before.
  void lower_dimension(Options changed, const std::vector<Remedy>& others) {
    if (is_enough()) return;
    const int highest =
        rips_ ? options_.max_dim.value_or(1) : *plan(complex_, options_, context_).options.max_dim;
    for (int dim = highest - 1; dim >= options_.min_dim; --dim) {
      changed.max_dim = dim;
      std::vector<Remedy> changes = others;
      changes.push_back({Setting::max_dim, fmt::format("{}", dim)});
      if (try_task(changed, std::move(changes))) return;
    }
  }

  /// Rounds a threshold to a few digits, and keeps it if the run fits into memory. @return true if
  /// it fits.
  bool try_threshold(double threshold) {
    RipsOptions changed = rips_->options();
    const std::string text = fmt::format("{:.3g}", threshold);
    double rounded = threshold;
    floating_from_chars(text.data(), text.data() + text.size(), rounded);
    if (!std::isfinite(rounded)) return false;
    changed.threshold = rounded;
    return try_question(std::move(changed), {{Setting::threshold, text}});
  }

  /// Tries a few thresholds, largest first. They leave half of the edges, a fifth of them, and so
  /// on. If so few pairs are edges that the sample cannot count them, tries three quarters of the
  /// given threshold, half of it, and so on.
  void lower_threshold() {
    const std::optional<double> given = rips_->options().threshold;
    const double highest = given.value_or(std::numeric_limits<double>::infinity());
    const std::vector<double>& distances = sample_.distances;
    const auto within =
        static_cast<double>(std::ranges::upper_bound(distances, highest) - distances.begin());
    if (given && within < kFewestPairs) {
      for (const double share : {0.75, 0.5, 0.25, 0.1})
        if (try_threshold(share * highest)) return;
      return;
    }
    for (const double share : {0.5, 0.2, 0.05, 0.01, 0.002, 0.0005}) {
      const auto place = static_cast<std::size_t>(share * within);
      if (place < 4) return;  // the sample is too small
      const double edges =
          sample_.pairs * static_cast<double>(place) / static_cast<double>(distances.size());
      if (kBytesPerEdge * edges > static_cast<double>(context_.memory.limit())) continue;
      if (try_threshold(distances[place])) return;
    }
  }

  /// Tries a few samples of the points, largest first.
  void subsample() {
    RipsOptions changed = rips_->options();
    const bool has_all_distances = sample_.pairs == pairs_of(sample_.vertices);
    if (changed.subsample || !changed.vertices.empty() || rips_->has_births() || !has_all_distances)
      return;
    for (const Index divisor : {2, 5, 20, 100, 500}) {
      const Index points = rips_->size() / divisor;
      if (points < kFewestPoints) return;
      const double evaluated = static_cast<double>(points) * static_cast<double>(rips_->size());
      if (evaluated > kMostDistances ||
          kBytesPerEdge * pairs_of(points) > static_cast<double>(context_.memory.limit()))
        continue;
      changed.subsample = GreedyLimits{.points = points};
      if (try_question(changed, {{Setting::subsample, fmt::format("{}", points)}})) return;
    }
  }

  const AnyComplex& complex_;
  const Rips* rips_;
  const Options& options_;
  const RunContext& context_;
  std::clock_t start_ = std::clock();
  RipsSample sample_;
  std::vector<Fit> found_;
};

}  // namespace

std::vector<Fit> what_fits(const AnyComplex& complex, const Options& options,
                           const RunContext& context) {
  return Search(complex, options, context).run();
}

}  // namespace ph

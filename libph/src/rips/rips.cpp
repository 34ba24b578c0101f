// SPDX-License-Identifier: MIT
#include "ph/rips.hpp"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "libph/src/rips/make_graph.hpp"
#include "ph/detail/rips/rips_graph.hpp"
#include "ph/distance_to_measure.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

/// The number of bytes of the coordinates, unless the caller owns them.
std::size_t bytes_of(const RipsData& data) {
  const auto* points = std::get_if<HeldPoints>(&data);
  return points && points->owner ? static_cast<std::size_t>(points->view.size()) * sizeof(double)
                                 : 0;
}

HeldPoints held(Points points) {
  auto owner = std::make_shared<const Points>(std::move(points));
  const PointsView view = *owner;
  return {view, std::move(owner)};
}

HeldPoints copied(PointsView points, const RunContext& context) {
  context.memory.require(static_cast<std::size_t>(points.size()) * sizeof(double));
  return held(Points(points));
}

}  // namespace

namespace detail {

/// The data of a filtration. The memory of points that the filtration owns is counted as long as a
/// copy or a form refers to the data.
struct HeldInput {
  HeldInput(RipsData data_held, const RunContext& context)
      : data(std::move(data_held)), claim(context.memory, bytes_of(data)) {}
  RipsData data;
  MemoryClaim claim;
};

/// A value that is made once, by the first thread that needs it, while other threads wait. If
/// making it is stopped or runs out of memory, nothing is kept. The class does not use
/// std::call_once. When memory has run out, an exception that passes through std::call_once ends
/// the process, because glibc then loads the library that it needs for unwinding.
template <class T>
class Once {
 public:
  const T* made() const { return made_.load(std::memory_order_acquire); }
  /// @param make returns a std::unique_ptr<const T>. @param context the context of the calling
  /// thread.
  template <class Make>
  const T& get(const RunContext& context, Make&& make) {
    if (const T* there = made()) return *there;
    std::unique_lock lock(mutex_, std::defer_lock);
    while (!lock.try_lock()) {
      context.poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (!value_) {
      value_ = make();
      made_.store(value_.get(), std::memory_order_release);
    }
    return *value_;
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<const T> value_;
  std::atomic<const T*> made_{nullptr};
};

/// The vertices and births that a subsample or a distance to a measure determines.
struct VertexChoice {
  std::vector<std::uint32_t> vertices;
  std::vector<double> births;
  std::optional<double> covering_radius;
};

/// A form together with its own context, because the context of the call may be destroyed before
/// the form.
struct MadeForm {
  /// @param counts the context that counts the memory of the form; it must outlive the form. @param
  /// call the context of the call that makes the form.
  MadeForm(const RunContext& counts, const RunContext& call) : context(counts.memory) {
    if (&counts != &call) context.memory.set_limit(call.memory.left());
    context.stop = call.stop;
    context.on_progress = call.on_progress;
    context.threads = call.threads;
  }
  /// Must be called when the form is complete. From then on, the memory of the form is limited only
  /// by the context that counts it, and no stop request reaches the form.
  void settle() {
    context.memory.set_limit(MemoryBudget::kUnlimited);
    context.stop = {};
    context.on_progress = nullptr;
  }
  RunContext context;
  std::shared_ptr<const HeldInput> input;  // kept because the graph may refer to its points
  std::optional<RipsGraph> graph;
};

}  // namespace detail

namespace {

using detail::VertexChoice;

std::unique_ptr<const VertexChoice> choose(const RipsData& data, const RipsOptions& options,
                                           const RunContext& context) {
  auto choice = std::make_unique<VertexChoice>();
  if (size_of(data) == 0) return choice;
  const auto choose_from = [&](const auto& set, const auto&... how) {
    if (options.dtm_neighbours) {
      choice->births = distance_to_measure(set, *options.dtm_neighbours, how..., context);
      for (double& birth : choice->births) birth *= 2;  // births are diameters
    }
    if (options.core_neighbours)
      choice->births = core_distances(set, *options.core_neighbours, how..., context);
    if (options.subsample) {
      const GreedyPermutation sample = greedy_permutation(set, *options.subsample, how..., context);
      choice->vertices = sample.ascending();
      choice->covering_radius = sample.covering_radius;
    }
  };
  if (const auto* points = std::get_if<HeldPoints>(&data))
    choose_from(points->view, options.distance, options.minkowski_p);
  else if (const auto* matrix = std::get_if<DistanceMatrix>(&data))
    choose_from(*matrix);
  else
    choose_from(std::get<HeldMetric>(data).metric);
  return choice;
}

std::string_view name_of(RipsForm form) {
  switch (form) {
    case RipsForm::edges:
      return "all edges";
    case RipsForm::distinct_edges:
      return "the edges of distinct points";
    case RipsForm::forest:
      return "a spanning forest";
    case RipsForm::points:
      break;
  }
  return "points alone";
}

RipsForm form_of(const RipsGraph& graph) {
  return graph.is_forest() ? RipsForm::forest : RipsForm::edges;
}

}  // namespace

struct Rips::State {
  State(RipsData data, RipsOptions wanted, const RunContext& counting)
      : State(std::make_shared<const detail::HeldInput>(std::move(data), counting),
              std::move(wanted), counting) {}
  State(std::shared_ptr<const detail::HeldInput> shared, RipsOptions wanted,
        const RunContext& counting)
      : input(std::move(shared)),
        size(size_of(input->data)),
        options(std::move(wanted)),
        context(&counting) {
    check_options(input->data, options, counting);
    if (const auto* points = std::get_if<HeldPoints>(&input->data)) {
      coordinates = points->view.cols();
      metric = metric_name(options.distance, options.minkowski_p);
    } else if (std::holds_alternative<HeldMetric>(input->data)) {
      metric = "function";
    }
  }
  explicit State(RipsGraph&& graph) : size(graph.size()), given(std::move(graph)) {}

  const RipsData& data() const {
    if (given)
      throw Error(ErrorKind::usage,
                  "Rips: found a filtration of a graph, expected one of points or distances");
    if (!input) throw Error(ErrorKind::usage, "Rips: the input was freed, and this call needs it");
    return input->data;
  }
  const VertexChoice& choice(const RunContext& call) const {
    return chosen.get(call, [&] { return choose(data(), options, call); });
  }
  std::unique_ptr<const detail::MadeForm> make(RipsForm form, const RunContext& call) const {
    auto made = std::make_unique<detail::MadeForm>(*context, call);
    if (form == RipsForm::forest) {
      if (std::optional<RipsGraph> forest = make_core_forest(data(), options, made->context)) {
        made->graph = std::move(forest);
        made->settle();
        return made;
      }
    }
    ChosenVertices vertices{options.vertices, options.births};
    if (options.subsample) vertices.vertices = choice(call).vertices;
    if (options.computes_births()) vertices.births = choice(call).births;
    if (const auto* matrix = std::get_if<DistanceMatrix>(&data());
        matrix && vertices.births.empty())
      vertices.births = matrix->births();
    if (form == RipsForm::points) made->input = input;
    made->graph.emplace(make_graph(data(), options, form, vertices, made->context));
    made->settle();
    return made;
  }

  // The pointer is null if a graph was given, or if the input was freed.
  std::shared_ptr<const detail::HeldInput> input;
  Index size;
  std::optional<Index> coordinates;  // of points
  std::string metric = "precomputed";
  RipsOptions options;
  const RunContext* context = &default_context();
  std::optional<RipsGraph> given;
  mutable detail::Once<VertexChoice> chosen;
  mutable std::array<detail::Once<detail::MadeForm>, 4> forms;
};

Rips::Rips(Points points, RipsOptions options, const RunContext& context)
    : state_(std::make_shared<State>(held(std::move(points)), std::move(options), context)) {}

Rips::Rips(PointsView points, RipsOptions options, const RunContext& context)
    : state_(std::make_shared<State>(copied(points, context), std::move(options), context)) {}

Rips::Rips(DistanceMatrix distances, RipsOptions options, const RunContext& context)
    : state_(std::make_shared<State>(std::move(distances), std::move(options), context)) {}

Rips::Rips(SparseDistances distances, RipsOptions options, const RunContext& context)
    : state_(std::make_shared<State>(std::move(distances), std::move(options), context)) {}

Rips::Rips(std::shared_ptr<const void> owner, const AnyMetric& metric, RipsOptions options,
           const RunContext& context)
    : state_(std::make_shared<State>(HeldMetric{metric, std::move(owner)}, std::move(options),
                                     context)) {}

Rips::Rips(RipsGraph&& graph) : state_(std::make_shared<State>(std::move(graph))) {}

Rips Rips::borrowed(PointsView points, RipsOptions options, const RunContext& context) {
  return Rips(std::make_shared<State>(HeldPoints{points, nullptr}, std::move(options), context));
}

Rips Rips::with(RipsOptions options, const RunContext& context) const {
  static_cast<void>(state_->data());
  return Rips(std::make_shared<State>(state_->input, std::move(options), context));
}

Index Rips::size() const { return state_->size; }
const RipsOptions& Rips::options() const { return state_->options; }

std::optional<PointsView> Rips::points() const {
  if (!state_->input) return std::nullopt;
  const auto* points = std::get_if<HeldPoints>(&state_->input->data);
  return points ? std::optional(points->view) : std::nullopt;
}

std::optional<Index> Rips::coordinates() const { return state_->coordinates; }
std::string Rips::metric() const { return state_->metric; }

bool Rips::has_input() const { return state_->input != nullptr; }

bool Rips::has_births() const {
  if (state_->given) return !state_->given->births().empty();
  const auto* matrix = state_->input ? std::get_if<DistanceMatrix>(&state_->input->data) : nullptr;
  return !state_->options.births.empty() || state_->options.computes_births() ||
         (matrix && !matrix->births().empty());
}

std::optional<double> Rips::covering_radius(const RunContext& context) const {
  if (!state_->options.subsample) return std::nullopt;
  return state_->choice(context).covering_radius;
}

bool Rips::has_form(RipsForm form) const {
  const State& state = *state_;
  if (state.given) return form == form_of(*state.given);
  if (state.forms[static_cast<std::size_t>(form)].made()) return true;
  if (!state.input) return false;
  const bool has_points = std::holds_alternative<HeldPoints>(state.input->data);
  switch (form) {
    case RipsForm::edges:
      return true;
    case RipsForm::distinct_edges:
      return has_points;
    case RipsForm::forest:
      return !state.options.approximation;
    case RipsForm::points:
      break;
  }
  return has_points && !state.options.approximation;
}

const RipsGraph& Rips::graph(RipsForm form, const RunContext& context) const {
  const State& state = *state_;
  if (state.given && form == form_of(*state.given)) return *state.given;
  detail::Once<detail::MadeForm>& once = state.forms[static_cast<std::size_t>(form)];
  if (const detail::MadeForm* made = once.made()) return *made->graph;
  if (!state.given) static_cast<void>(state.data());
  if (!has_form(form))
    throw Error(ErrorKind::usage,
                fmt::format("Rips: found a filtration {}, which cannot be built from {}",
                            state.given                   ? "of a graph"
                            : state.options.approximation ? "that is approximated"
                                                          : "of distances",
                            name_of(form)));
  return *once.get(context, [&] { return state.make(form, context); }).graph;
}

RipsSample Rips::sample(const RunContext& context) const {
  return sample_of(state_->data(), state_->options, context);
}

void Rips::forget_input() { state_->input.reset(); }

bool Rips::is_only_copy() const {
  return state_.use_count() == 1 && state_->input.use_count() <= 1;
}

}  // namespace ph

// SPDX-License-Identifier: MIT
#include "python/src/parts/image_loops.hpp"

#include <algorithm>
#include <string>

#include "ph/error.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/parts/part_bytes.hpp"

namespace ph::python {
namespace {

/// While this object lives, a stop request to another context also stops this context, and the
/// progress of this context is reported to the other context.
class Watched {
 public:
  Watched(RunContext& context, const RunContext& call) : context_(context) {
    context.stop = call.stop;
    if (call.on_progress)
      context.on_progress = [&call](const Progress& progress) { call.report(progress); };
  }
  ~Watched() {
    context_.stop = {};
    context_.on_progress = nullptr;
  }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

 private:
  RunContext& context_;
};

[[noreturn]] void refuse(const char* what) {
  throw Error(ErrorKind::usage, std::string("loops of an image: ") + what);
}

}  // namespace

int highest_dim(const ImagePart& part) {
  return std::min(part.options().max_dim.value_or(0), static_cast<int>(part.extents().size()) - 1);
}

RunningLoops::RunningLoops(HeldPart& held, std::int64_t field, const RunOptions& options)
    : recipe_(held.recipe),
      of_part_(held.context),
      max_dim_(highest_dim(held.part)),
      field_(field) {
  run(options, false, [&](const RunContext& call) {
    context_.threads = call.threads;
    context_.memory.set_limit(call.memory.limit());
    const Watched watched(context_, call);
    loops_.emplace(held.part, field, context_);
    return true;
  });
}

/// Runs a call that reads the loops. The call waits for the lock without the GIL, because the owner
/// of the lock may need the GIL.
template <class Use>
auto RunningLoops::locked(Use&& use) {
  const py::gil_scoped_release no_gil;
  const std::lock_guard lock(mutex_);
  return use();
}

/// Runs a call that changes the loops. Precondition: the lock is held.
template <class Use>
auto RunningLoops::changed(const RunContext& call, Use&& use) {
  const Watched watched(context_, call);
  is_broken_ = has_news_ = true;
  use();
  is_broken_ = false;
  return true;
}

void RunningLoops::require_sound() const {
  if (is_broken_) refuse("an earlier call failed; start again with a new part");
}

void RunningLoops::begin(std::span<const std::byte> told, const RunOptions& options) {
  run(options, false, [&](const RunContext& call) {
    const std::lock_guard lock(mutex_);
    require_sound();
    if (has_begun_) refuse("found a second call of begin, expected only one");
    return changed(call, [&] {
      loops_->begin(told);
      has_begun_ = true;
    });
  });
}

void RunningLoops::receive(std::span<const std::byte> message) {
  locked([&] {
    require_sound();
    return changed(default_context(), [&] { loops_->receive(message); });
  });
}

bool RunningLoops::is_idle() {
  return locked([&] { return loops_->is_idle(); });
}

void RunningLoops::work(std::size_t most, const RunOptions& options) {
  run(options, false, [&](const RunContext& call) {
    const std::lock_guard lock(mutex_);
    require_sound();
    if (loops_->is_idle()) return true;
    return changed(call, [&] { loops_->work(most); });
  });
}

std::vector<ImageLoops::Message> RunningLoops::take_messages() {
  return locked([&] {
    require_sound();
    has_news_ = false;
    return loops_->take_messages();
  });
}

Bars RunningLoops::bars(const RunOptions& options) {
  return run(options, false, [&](const RunContext&) {
    const std::lock_guard lock(mutex_);
    require_sound();
    if (!has_begun_)
      refuse("found loops that have not begun, expected a call when all work is done");
    if (!loops_->is_idle()) refuse("found work to do, expected a call when all work is done");
    if (has_news_)
      refuse("found messages that were not taken, expected a call when all work is done");
    Bars bars{loops_->barcode()};
    bars.set_max_dim(max_dim_);
    bars.field = field_;
    return bars;
  });
}

ImageLoops::Traffic RunningLoops::traffic() {
  return locked([&] { return loops_->traffic(); });
}

void bind_image_loops(py::module_& m) {
  py::class_<HeldPart, std::shared_ptr<HeldPart>>(m, "HeldPart");
  py::class_<RunningLoops>(m, "RunningLoops")
      .def(py::init<HeldPart&, std::int64_t, const RunOptions&>(), py::arg("held"),
           py::arg("field"), py::arg("run"))
      .def_property_readonly("part", &RunningLoops::part)
      .def_property_readonly("is_idle", &RunningLoops::is_idle)
      .def_property_readonly("traffic",
                             [](RunningLoops& loops) {
                               const ImageLoops::Traffic t = loops.traffic();
                               return py::make_tuple(t.messages_sent, t.messages_received,
                                                     t.columns_sent, t.columns_received,
                                                     t.bytes_sent);
                             })
      .def(
          "begin",
          [](RunningLoops& loops, const py::bytes& told, const RunOptions& options) {
            loops.begin(view_of(told), options);
          },
          py::arg("told"), py::arg("run"))
      .def(
          "receive",
          [](RunningLoops& loops, const py::bytes& message) { loops.receive(view_of(message)); },
          py::arg("message"))
      .def(
          "work",
          [](RunningLoops& loops, std::optional<std::size_t> most, const RunOptions& options) {
            loops.work(most.value_or(SIZE_MAX), options);
          },
          py::arg("most"), py::arg("run"))
      .def("take_messages",
           [](RunningLoops& loops) {
             py::list messages;
             for (const ImageLoops::Message& message : loops.take_messages())
               messages.append(py::make_tuple(message.to, to_python(message.bytes)));
             return messages;
           })
      .def("bars", &RunningLoops::bars, py::arg("run"));
}

}  // namespace ph::python

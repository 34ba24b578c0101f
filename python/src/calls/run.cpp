// SPDX-License-Identifier: MIT
#include "python/src/calls/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "ph/detail/core/machine_memory.hpp"
#include "ph/detail/core/on_first_use.hpp"
#include "python/src/calls/bindings.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace ph::python {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using Task = std::function<void(const SharedContext&)>;

constexpr std::chrono::milliseconds kLook(20);

/// Nine tenths of the memory of the machine or the container, minus the memory that this process
/// already uses, for example for the arrays of the caller.
std::size_t memory_left() {
  // This number is slow to determine.
  static constinit detail::OnFirstUse all([] { return machine_memory(); });
  return *all - std::min<std::size_t>(*all, status_bytes("RssAnon:").value_or(0));
}

struct ContextWithInput {
  RunContext context;
  std::optional<MemoryClaim> input;
};

std::shared_ptr<RunContext> new_context(const RunOptions& options, bool is_short) {
  auto both = std::make_shared<ContextWithInput>();
  const std::shared_ptr<RunContext> context(both, &both->context);
  // A second thread would take longer to start than a short computation takes.
  context->threads = is_short && options.threads == 0 ? 1 : options.threads;
  context->slab_layers = options.slab_layers;
  if (options.memory_limit) {
    context->memory.set_limit(*options.memory_limit);
    both->input.emplace(context->memory, options.copied);
  }
  return context;
}

/// The calls in progress, protected by the GIL.
///
/// When Python exits, a thread that returns from a call to Python would be terminated within C++,
/// which would end the process. Therefore Python's last action before it exits is to stop these
/// calls and wait until they return.
class Calls {
 public:
  /// Represents one call as long as the object lives. The GIL must be held when the object is made
  /// or destroyed.
  class Call {
   public:
    explicit Call(std::stop_source* stop = nullptr) : stop_(stop) {
      if (ender_ != std::thread::id() && ender_ != std::this_thread::get_id())
        throw Error(ErrorKind::cancelled, "Python is shutting down");
      calls_.push_back(this);
    }
    ~Call() { std::erase(calls_, this); }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    void stop() const {
      if (stop_ != nullptr) stop_->request_stop();
    }

   private:
    std::stop_source* stop_;
  };

  static void end_all() {
    ender_ = std::this_thread::get_id();
    while (!calls_.empty()) {
      for (const Call* call : calls_) call->stop();
      const py::gil_scoped_release no_gil;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  /// Forgets all calls in a forked process, in which their threads do not exist.
  static void forget_all() { calls_.clear(); }

 private:
  // The thread that ends Python; no thread as long as Python runs.
  static inline std::thread::id ender_;
  static inline std::vector<const Call*> calls_;
};

struct News {
  std::string stage;
  std::uint64_t done = 0, total = 0;
};

News news_of(const Progress& progress) {
  return {std::string(progress.stage), progress.done, progress.total};
}

/// A computation that is watched, and its messages to the caller's thread.
class Computation {
 public:
  Computation(const RunOptions& options, bool is_short, const Task& task)
      : options_(options),
        is_short_(is_short),
        task_(task),
        context_(new_context(options, is_short)) {
    context_->stop = stop_.get_token();
    if (!options.progress.is_none())
      context_->on_progress = [this](const Progress& progress) { tell(progress); };
  }

  std::stop_source& stop() { return stop_; }

  /// Runs the computation and waits until it is done.
  void run() {
    // The C library keeps memory that Python freed, for example after a conversion of the input.
    // The thread of the computation cannot use it, and the limit does not count it.
#ifdef __GLIBC__
    if (options_.memory_limit && !is_short_) malloc_trim(0);
#endif
    if (!options_.memory_limit && !is_short_) context_->memory.set_limit(memory_left());
    look(std::nullopt);  // a stop may have been requested before a short computation begins
    context_->poll();
    if (is_short_ || !run_on_own_thread()) run_on_this_thread();
    context_->on_progress = nullptr;  // the thread may outlive this call
    if (of_caller_) std::rethrow_exception(of_caller_);
    if (error_) rethrow_error();
  }

 private:
  /// Returns false if the system has no thread left.
  bool run_on_own_thread() {
    std::jthread worker;
    try {
      worker = std::jthread([this] { compute(); });
    } catch (const std::system_error&) {
      return false;
    }
    unless_it_throws([this] { watch(); });
    return true;
  }
  /// The computation itself checks for stops whenever it reports progress.
  void run_on_this_thread() {
    context_->on_progress = [this](const Progress& progress) {
      unless_it_throws([&] { look_in_between(progress); });
    };
    compute();
  }

  // This function is called on the computation's thread.
  void compute() {
    try {
      task_(context_);
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    is_done_ = true;
    changed_.notify_one();
  }
  void tell(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    news_ = news_of(progress);
    changed_.notify_one();
  }

  // This function is called on the caller's thread.
  /// Calls `look`. An exception from a signal handler or a callback stops the computation.
  void unless_it_throws(const std::function<void()>& look) {
    try {
      if (!of_caller_) look();
    } catch (...) {
      of_caller_ = std::current_exception();
      stop_.request_stop();
    }
  }
  void look_in_between(const Progress& progress) {
    const bool wants_news = !options_.progress.is_none();
    look(wants_news ? std::optional(news_of(progress)) : std::nullopt);
    if (time_left() <= Seconds(0)) end_late();
  }
  void end_late() {
    is_late_ = true;
    stop_.request_stop();
  }
  void watch() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait_for(lock, std::clamp(time_left(), Seconds(0), Seconds(kLook)),
                        [&] { return is_done_ || news_; });
      if (is_done_) return;
      const std::optional<News> news = std::exchange(news_, std::nullopt);
      lock.unlock();
      look(news);
      lock.lock();
      if (time_left() > Seconds(0)) continue;
      return end_late();
    }
  }
  Seconds time_left() const {
    if (!options_.timeout) return Seconds::max();
    return Seconds(*options_.timeout) - Seconds(Clock::now() - start_);
  }
  void look(const std::optional<News>& news) {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!options_.stop.is_none() && py::bool_(options_.stop.attr("is_set")())) stop_.request_stop();
    if (news) options_.progress(news->stage, news->done, news->total);
  }
  [[noreturn]] void rethrow_error() const {
    try {
      std::rethrow_exception(error_);
    } catch (const Error& error) {
      if (is_late_ && error.kind() == ErrorKind::cancelled) throw Timeout(*options_.timeout);
      throw;
    }
  }

  const RunOptions& options_;
  const bool is_short_;
  const Task& task_;
  const Clock::time_point start_ = Clock::now();
  std::stop_source stop_;
  const std::shared_ptr<RunContext> context_;
  bool is_late_ = false;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_done_ = false;
  std::optional<News> news_;
  std::exception_ptr error_, of_caller_;
};

/// @throws Error (usage) if the stack of this thread is too small.
void require_stack() {
  thread_local const std::size_t stack = stack_size();
  if (stack != 0 && stack < kLeastStack)
    throw Error(ErrorKind::usage,
                fmt::format("found a thread with a stack of {} KiB, expected at least {} KiB; "
                            "threading.stack_size sets the size for later threads",
                            stack >> 10, kLeastStack >> 10));
}

}  // namespace

Timeout::Timeout(double seconds)
    : Error(ErrorKind::cancelled, fmt::format("timeout: not finished after {} s; a larger timeout, "
                                              "a smaller max_dim or a subsample may help",
                                              seconds)) {}

void run_task(const RunOptions& options, bool is_short, const Task& task) {
  require_stack();
  if (!is_short || options.is_watched()) {
    Computation computation(options, is_short, task);
    const Calls::Call call(&computation.stop());
    const py::gil_scoped_release no_gil;
    computation.run();
    return;
  }
  const Calls::Call call;
  const py::gil_scoped_release no_gil;
  task(new_context(options, is_short));
}

void bind_run(py::module_& m) {
  py::class_<RunOptions>(m, "RunOptions")
      .def(py::init([](int threads, std::optional<std::size_t> memory_limit,
                       std::optional<double> timeout, py::object progress, py::object stop,
                       int slab_layers, std::size_t copied) {
             return RunOptions{threads,         memory_limit, timeout, std::move(progress),
                               std::move(stop), slab_layers,  copied};
           }),
           py::arg("threads"), py::arg("memory_limit"), py::arg("timeout"), py::arg("progress"),
           py::arg("stop"), py::arg("slab_layers"), py::arg("copied") = 0);
  m.def("memory_left", &memory_left);
  m.def("end_calls", &Calls::end_all);
  m.def("forget_calls", &Calls::forget_all);
}

}  // namespace ph::python

#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/base/progress_report.hpp"
#include "studies/base/progress.hpp"

namespace flankwright::studies::python {

/// Thrown inside a run that the caller has given up; no more than the reason why it ends.
struct Stopped : std::exception {
  const char* what() const noexcept override { return "stopped by the caller"; }
};

/// Long work on a thread of its own, while the calling thread, which is Python's, shows its progress and looks for Ctrl-C. The interpreter is
/// free meanwhile; a callback is only ever called by the calling thread. Work ends at its next report of progress once it is given up.
class Listening {
 public:
  /// @param progress  None or False: shows nothing; True: a bar on stderr; else called with (label, done, total, remark)
  explicit Listening(pybind11::object progress) : callback_(std::move(progress)) {
    if (callback_.is_none() || pybind11::isinstance<pybind11::bool_>(callback_)) {
      if (!callback_.is_none() && pybind11::cast<bool>(callback_)) bar_.emplace();
      callback_ = pybind11::none();
    }
  }

  /// The result of work(report). Throws what the work or the callback throws, KeyboardInterrupt after Ctrl-C.
  template <class Work>
  auto run(const Work& work) -> decltype(work(ProgressReport{})) {
    auto future = std::async(std::launch::async, [&] {
      const AtEnd tell{*this};
      return work([this](const std::string& label, int done, int total, const std::string& remark) { take({label, done, total, remark}); });
    });
    const GivenUp unless_done{*this, future};
    for (bool done = false; !done;) {
      {
        const pybind11::gil_scoped_release free;
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, look_for_signals, [this] { return latest_.has_value() || done_; });
        done = done_;
      }
      show();
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    }
    if (bar_) bar_->finish();
    const pybind11::gil_scoped_release free;
    return future.get();
  }

 private:
  static constexpr std::chrono::milliseconds look_for_signals{50};

  struct State {
    std::string label;
    int done{0}, total{0};
    std::string remark;
  };
  struct AtEnd {
    Listening& of;
    ~AtEnd() {
      const std::lock_guard lock(of.mutex_);
      of.done_ = true;
      of.wake_.notify_one();
    }
  };
  /// Lets work that nobody waits for any longer come to its end.
  template <class Future>
  struct GivenUp {
    Listening& of;
    Future& future;
    ~GivenUp() {
      if (!future.valid()) return;
      of.stopped_ = true;
      const pybind11::gil_scoped_release free;
      future.wait();
    }
  };

  void take(State state) {
    if (stopped_) throw Stopped();
    const std::lock_guard lock(mutex_);
    latest_ = std::move(state);
    wake_.notify_one();
  }

  void show() {
    std::optional<State> state;
    {
      const std::lock_guard lock(mutex_);
      state.swap(latest_);
    }
    if (!state) return;
    if (bar_) bar_->show(state->label, state->done, state->total, state->remark);
    if (!callback_.is_none()) callback_(state->label, state->done, state->total, state->remark);
  }

  pybind11::object callback_;
  std::optional<Progress> bar_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<State> latest_;
  bool done_{false};
};

}  // namespace flankwright::studies::python

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

#include "app.h"

namespace sconce::app {

namespace {

using Clock = std::chrono::steady_clock;

/// The only thing a signal handler may touch: set by Ctrl-C or SIGTERM, turned into a stop request by the
/// ticker.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
  interrupted.store(true);
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

/// Draws the progress line and watches for interruption, on its own thread; workers only leave numbers here.
class Ticker {
 public:
  explicit Ticker(bool draw) : draw_(draw) {
    interrupted.store(false);
    struct sigaction action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESETHAND | SA_RESTART;  // the second Ctrl-C finds the default action and kills
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &old_interrupt_);
    sigaction(SIGTERM, &action, &old_terminate_);
    thread_ = std::thread([this] { run(); });
  }
  ~Ticker() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    wake_.notify_all();
    thread_.join();
    erase_line();
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
  }
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

  std::stop_token stop() const { return stop_.get_token(); }

  void report(std::string_view stage, uint64_t done, uint64_t total) {
    const std::lock_guard lock(mutex_);
    if (stage != stage_) {
      stage_ = stage;
      started_ = Clock::now();
      first_ = done;
    }
    current_ = done;
    total_ = total;
  }

  void warn(const std::string& line) {
    const std::lock_guard lock(mutex_);
    erase_line();
    print_warning(line);
  }

 private:
  void run() {
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return done_; })) {
      if (interrupted.load() && !stop_.stop_requested()) {
        stop_.request_stop();
        if (draw_) {
          erase_line();
          fmt::print(stderr, "stopping; press Ctrl-C again to end at once\n");
        }
      }
      if (draw_ && !stage_.empty()) draw_line();
    }
  }

  void draw_line() {
    std::string line = stage_;
    const double elapsed = std::chrono::duration<double>(Clock::now() - started_).count();
    if (total_ > 0)
      line += fmt::format("  {:3.0f} %", 100.0 * static_cast<double>(current_) / static_cast<double>(total_));
    line += "  " + clock_text(elapsed);
    // What a resumed bake had done before says nothing about the speed of this run.
    if (total_ > current_ && current_ > first_ && elapsed > 1) {
      const double left =
          elapsed * static_cast<double>(total_ - current_) / static_cast<double>(current_ - first_);
      line += "  " + clock_text(left) + " left";
    }
    fmt::print(stderr, "\r\033[K{}", line);
    std::fflush(stderr);
    drawn_ = true;
  }

  void erase_line() {
    if (!drawn_) return;
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
    drawn_ = false;
  }

  const bool draw_;
  struct sigaction old_interrupt_ = {}, old_terminate_ = {};
  std::stop_source stop_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::string stage_;
  Clock::time_point started_;
  uint64_t first_ = 0, current_ = 0, total_ = 0;
  bool done_ = false, drawn_ = false;
  std::thread thread_;
};

}  // namespace

Progress make_progress(const Options& options) {
  const auto ticker = std::make_shared<Ticker>(!options.quiet && isatty(STDERR_FILENO) != 0);
  Progress progress;
  progress.report = [ticker](std::string_view stage, uint64_t done, uint64_t total) {
    ticker->report(stage, done, total);
  };
  progress.warning = [ticker](const std::string& line) { ticker->warn(line); };
  progress.stop = ticker->stop();
  return progress;
}

}  // namespace sconce::app

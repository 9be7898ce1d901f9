// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "core/progress.h"

namespace sconce {

/// Work beside the window: it hands over results as they become better, and may be stopped any time.
template <class T>
class Background {
 public:
  using Publish = std::function<void(T)>;

  /// Stops what runs and starts anew. What `work` throws becomes problem(); Cancelled does not.
  void start(std::function<void(const Progress&, const Publish&)> work) {
    stop();
    {
      const std::lock_guard lock(mutex_);
      fresh_.reset(), problem_.clear(), stage_.clear(), done_ = 0, running_ = true;
    }
    thread_ = std::jthread([this, work = std::move(work)](std::stop_token token) { run(work, token); });
  }
  void stop() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
  }

  /// What was handed over since the last call.
  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(fresh_, std::nullopt);
  }
  bool running() const { return locked(running_); }
  /// What it failed at, once.
  std::string take_problem() {
    const std::lock_guard lock(mutex_);
    return std::exchange(problem_, {});
  }
  std::string stage() const { return locked(stage_); }
  double done() const { return locked(done_); }  ///< share of the stage

 private:
  template <class V>
  V locked(const V& value) const {
    const std::lock_guard lock(mutex_);
    return value;
  }
  void run(const std::function<void(const Progress&, const Publish&)>& work, std::stop_token token) {
    Progress progress;
    progress.stop = token;
    progress.report = [this](std::string_view stage, uint64_t done, uint64_t total) {
      const std::lock_guard lock(mutex_);
      stage_ = stage;
      done_ = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 0;
    };
    std::string problem;
    try {
      work(progress, [this](T value) {
        const std::lock_guard lock(mutex_);
        fresh_ = std::move(value);
      });
    } catch (const Cancelled&) {
    } catch (const std::exception& error) {
      problem = error.what();
    }
    const std::lock_guard lock(mutex_);
    problem_ = problem, running_ = false;
  }

  mutable std::mutex mutex_;
  std::optional<T> fresh_;
  std::string problem_, stage_;
  double done_ = 0;
  bool running_ = false;
  std::jthread thread_;  ///< last: it is stopped before the rest goes
};

}  // namespace sconce

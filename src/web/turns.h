// SPDX-License-Identifier: Apache-2.0
// Two threads that speak in turn: the page's, which waits for the solver's next word, and the solver's.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>

namespace sconce::web {

class Turns {
 public:
  struct Ended {};  ///< thrown to whoever waits

  /// The page's. @return the solver's next message
  std::string ask_solver(std::string message) {
    std::unique_lock lock(mutex_);
    to_solver_ = std::move(message);
    return next(lock, to_page_);
  }
  /// The solver's. @return what the page answers
  std::string ask_page(std::string message) {
    std::unique_lock lock(mutex_);
    to_page_ = std::move(message);
    return next(lock, to_solver_);
  }
  /// The solver's, before it has anything to say.
  std::string wait_for_page() {
    std::unique_lock lock(mutex_);
    return next(lock, to_solver_);
  }
  void end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

 private:
  std::string next(std::unique_lock<std::mutex>& lock, std::optional<std::string>& from) {
    changed_.notify_all();
    changed_.wait(lock, [&] { return from || ended_; });
    if (!from) throw Ended();
    std::string message = std::move(*from);
    from.reset();
    return message;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::string> to_solver_, to_page_;
  bool ended_ = false;
};

}  // namespace sconce::web

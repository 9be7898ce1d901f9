// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace sconce {

/// Undo and redo of a value. One gesture is one step, however many values it runs through.
template <class T>
class History {
 public:
  explicit History(T first) : states_{std::move(first)} {}

  /// The value after a change. @param gesture  changes in a row of the same name are one step; "" = never
  void set(T value, const std::string& gesture = {}) {
    if (value == now()) return;
    states_.resize(at_ + 1);
    if (gesture.empty() || gesture != gesture_ || at_ == 0) {
      states_.push_back(std::move(value));
      if (states_.size() > kMost) states_.erase(states_.begin());
      at_ = states_.size() - 1;
    } else {
      states_[at_] = std::move(value);
    }
    gesture_ = gesture;
  }
  /// The next change of the same name is a step of its own: the mouse was let go.
  void end_gesture() { gesture_.clear(); }

  const T& now() const { return states_[at_]; }
  bool can_undo() const { return at_ > 0; }
  bool can_redo() const { return at_ + 1 < states_.size(); }
  bool undo() { return can_undo() && (end_gesture(), --at_, true); }
  bool redo() { return can_redo() && (end_gesture(), ++at_, true); }

 private:
  static constexpr std::size_t kMost = 500;
  std::vector<T> states_;
  std::size_t at_ = 0;
  std::string gesture_;
};

}  // namespace sconce

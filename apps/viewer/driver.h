// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/script.h"

namespace sconce::viewer {

class Viewer;

/// Works through a script, one action per frame at most; what goes wrong ends it.
class Driver {
 public:
  Driver(Viewer& viewer, std::vector<Action> actions) : viewer_(&viewer), actions_(std::move(actions)) {}
  /// Before a frame. @return false when all is done. @throws Error
  bool step();

 private:
  bool perform(const Action& action);
  bool lamp(const Action& action);
  bool object(const Action& action);
  bool tug(const Action& action);
  /// The mouse from a to b in a few frames, with the left button down.
  void drag(float x0, float y0, float x1, float y1);

  Viewer* viewer_;
  std::vector<Action> actions_;
  std::size_t at_ = 0;
  int frames_ = 0;    ///< to wait
  double until_ = 0;  ///< time to wait for
  bool settling_ = false, shooting_ = false;
  std::vector<std::pair<float, float>> path_;  ///< that the mouse still has to go
  std::size_t path_at_ = 0;
};

}  // namespace sconce::viewer

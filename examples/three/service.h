// SPDX-License-Identifier: Apache-2.0
// sconce beside a page: what glue.js asks of it, by HTTP. Messages are a length, JSON and floats
// (service.cpp).
#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "detect/realtime.h"

namespace httplib {
class Server;
}

/// Who wants to know what the solver found and did; called on its thread.
struct Listener {
  std::function<void(const sconce::Detection&)> found;
  std::function<void(const sconce::FrameReport&)> frame;
};

/// POST /sconce/override  a vertex shader; returns it with the position override, or 422 and one line
/// POST /sconce/start     the geometry; returns its texture coordinates. Ends what was before
/// POST /sconce/turn      an answer; returns the next question, or what the last one came to
class GiService {
 public:
  explicit GiService(Listener listener = {});
  ~GiService();
  void add_to(httplib::Server& server);

 private:
  class Session;
  Listener listener_;
  std::mutex mutex_;
  std::shared_ptr<Session> session_;
};

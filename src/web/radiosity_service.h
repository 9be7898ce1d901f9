// SPDX-License-Identifier: Apache-2.0
// Indirect light for a renderer in another process, such as a page in a browser on the same machine
// (examples/three): it is asked to draw by HTTP, one round trip per drawing.
#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "detect/realtime.h"

namespace httplib {
class Server;
}

namespace sconce::web {

/// Who wants to know what the solver found and did; called on its thread.
struct RadiosityListener {
  std::function<void(const Detection&)> found;
  std::function<void(const FrameReport&)> frame;
};

/// Messages are RadiosityMessages, but for shaders and errors, which are text.
///
/// POST /sconce/override  a vertex shader; returns it with the position override, or 422 and one line
/// POST /sconce/start     the geometry; returns its texture coordinates. Ends what was before
/// POST /sconce/turn      an answer; returns the next question, or what the last one came to
///
/// start: {materials: [name], meshes: [{vertices, material}], density}, positions of all vertices in the
/// world,
///   three per face, as many normals; back {width, height}, the vertices' texture coordinates in the map.
/// turn: {kind: begin | detect | update}, then a {kind: drawn, width, height, read | fault} with RGBA for
/// each
///   {kind: draw, lights, to_light, intensity, eye, white_card, background, width, height} with the vertices'
///   places, 0 to 1, or none where they are as before; at last {kind: found, materials, findings}, {kind:
///   frame, fault, drawn, read, solved} with the map's RGBA, or {kind: failed, message}.
class RadiosityService {
 public:
  explicit RadiosityService(RadiosityListener listener = {});
  ~RadiosityService();
  void add_to(httplib::Server& server);

 private:
  class Session;
  RadiosityListener listener_;
  std::mutex mutex_;
  std::shared_ptr<Session> session_;
};

}  // namespace sconce::web

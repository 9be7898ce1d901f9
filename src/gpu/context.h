// SPDX-License-Identifier: Apache-2.0
// OpenGL 4.5 core, without a window or in somebody's. This module is the only place that names OpenGL.
#pragma once

#include <memory>
#include <string>

namespace sconce::gpu {

/// What this OpenGL can do, as asked of it.
struct Capabilities {
  std::string renderer, version;
  bool software = false;  ///< the processor draws
  int max_texture_size = 0, max_array_layers = 0;
  int max_units = 0;                               ///< textures that one fragment shader may read
  std::size_t max_buffer = 0;                      ///< bytes of a buffer that shaders read
  bool float_linear = false;                       ///< 32-bit float textures are filtered
  bool float_target = false, half_target = false;  ///< float textures can be drawn to
  bool bc6h = false;
};

struct ContextParams {
  bool hardware_only = false;  ///< no context rather than a software one
  bool debug = true;           ///< let OpenGL explain its errors; slower
};

/// Current on the thread that made it; for that thread alone. At most one at a time.
class Context {
 public:
  /// A hardware device where there is one, else software. @throws Error when there is no OpenGL 4.5
  explicit Context(const ContextParams& params = {});
  /// The context that is current on this thread already, made and kept by someone else: a window.
  /// @throws Error where it is older than OpenGL 4.5
  static std::unique_ptr<Context> adopt(bool debug);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const Capabilities& capabilities() const;
  /// Lets the device seem to be another one, for tests of smaller ones.
  void pretend(const Capabilities& capabilities);
  /// @throws Error with the first thing that OpenGL complained of since the last call, or that the context is
  /// lost
  /// @param doing  what was being done
  void check(const std::string& doing) const;

 private:
  struct State;
  explicit Context(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sconce::gpu

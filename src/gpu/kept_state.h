// SPDX-License-Identifier: Apache-2.0
// Somebody else's OpenGL state around a drawing that changes it. OpenGL 3.3 or later.
#pragma once

#include <epoxy/gl.h>

#include <functional>
#include <utility>
#include <vector>

namespace sconce::gpu {

/// Reads the state of the current context, and puts it back: what is bound (framebuffers, program, vertex
/// array, buffers, textures and samplers of all units), what is switched on, and every value that drawing,
/// clearing and reading pixels use. Not what objects hold: a vertex array's attributes, a texture's
/// parameters; nor what compatibility contexts have beside that (matrices, fixed lights).
class KeptState {
 public:
  KeptState();
  /// Puts it back where that is possible.
  ~KeptState();
  KeptState(const KeptState&) = delete;
  KeptState& operator=(const KeptState&) = delete;

  /// @throws Error where the context was lost, or is not the current one any more: there is nothing to put
  /// back
  void restore();

 private:
  bool is_current() const;
  void keep_bindings();
  void keep_textures();
  void keep_switches();
  void keep_values();
  void keep_stencil();

  std::vector<std::function<void()>> undo_;
  GLuint marker_ = 0;  ///< a framebuffer: contexts do not share them
};

/// f(), with the state put back. @throws Error as KeptState::restore()
template <class F>
auto keep_state(F&& f) {
  KeptState kept;
  auto result = std::forward<F>(f)();
  kept.restore();
  return result;
}

}  // namespace sconce::gpu

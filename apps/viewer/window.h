// SPDX-License-Identifier: Apache-2.0
// A window with OpenGL and Dear ImGui in it. The only file besides the backends' glue that names GLFW.
#pragma once

#include <imgui.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "image/image.h"

namespace sconce::viewer {

/// Mouse and keys that a script holds, in place of a person's.
struct Hands {
  std::optional<ImVec2> mouse;
  bool left = false;
  std::set<int> keys;  ///< GLFW's
  bool control = false, shift = false;
  std::string text;  ///< typed in this frame, UTF-8
};

class Window {
 public:
  /// @throws Error where there is no display, or no OpenGL 4.5 on it
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  const gpu::Context& context() const;
  bool closing() const;
  void close();
  void set_title(const std::string& title);
  ImVec2 size() const;

  /// Events, then a new frame of ImGui. @param wait  seconds to sleep at most while nothing happens
  /// @param hands  take the place of what the window system says, where given
  void begin_frame(double wait, const std::optional<Hands>& hands);
  /// Draws it. @return what the window shows, where asked for
  std::optional<Image8> end_frame(bool screenshot);
  /// Files dropped since the last call.
  std::vector<std::string> take_dropped();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// GLFW's key of a name: "a", "1", "f1", "space", "escape", "left"; 0 where there is none.
int key_of(const std::string& name);

}  // namespace sconce::viewer

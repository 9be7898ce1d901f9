// SPDX-License-Identifier: Apache-2.0
#include "gpu/window_target.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace sconce::gpu {

void clear_window(int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

void finish_window() {
  glFinish();
}

Image8 read_window(int width, int height) {
  Image8 out{width, height, 3, {}};
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  out.data.resize(row * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, out.data.data());
  for (std::size_t top = 0, bottom = static_cast<std::size_t>(height) - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(&out.data[top * row], &out.data[top * row] + row, &out.data[bottom * row]);
  return out;
}

}  // namespace sconce::gpu

// SPDX-License-Identifier: Apache-2.0
// The framebuffer of a window whose context is current.
#pragma once

#include "image/image.h"

namespace sconce::gpu {

/// Draws go to all of it; it becomes black.
void clear_window(int width, int height);
/// Waits until all is drawn that was asked for.
void finish_window();
/// What was drawn and is not shown yet.
Image8 read_window(int width, int height);

}  // namespace sconce::gpu

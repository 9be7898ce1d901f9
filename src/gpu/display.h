// SPDX-License-Identifier: Apache-2.0
// EGL displays that need no window system.
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <utility>
#include <vector>

namespace sconce::gpu {

struct Display {
  EGLDisplay handle = EGL_NO_DISPLAY;
  bool software = true;

  Display() = default;
  Display(EGLDisplay handle_, bool software_) : handle(handle_), software(software_) {}
  Display(Display&& other) noexcept
      : handle(std::exchange(other.handle, EGL_NO_DISPLAY)), software(other.software) {}
  Display& operator=(Display&& other) noexcept {
    std::swap(handle, other.handle);
    software = other.software;
    return *this;
  }
  ~Display() {
    if (handle != EGL_NO_DISPLAY) eglTerminate(handle);
  }
};

/// Initialised displays, best first: hardware devices, then Mesa's surfaceless platform, then software
/// devices.
/// @throws Error when there is no EGL at all
std::vector<Display> open_displays(bool hardware_only);

}  // namespace sconce::gpu

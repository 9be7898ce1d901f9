// SPDX-License-Identifier: Apache-2.0
#include "gpu/display.h"

#include <dlfcn.h>

#include <string>

#include "core/error.h"
#include "core/text.h"

namespace sconce::gpu {

namespace {

bool has(const char* extensions, const std::string& name) {
  if (extensions == nullptr) return false;
  for (const std::string& word : split(extensions, ' '))
    if (word == name) return true;
  return false;
}

/// Extensions of the client, not of a display, which libepoxy does not resolve.
template <class F>
F function(const char* name) {
  return reinterpret_cast<F>(eglGetProcAddress(name));
}

void open(EGLDisplay display, bool software, std::vector<Display>& out) {
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE)
    out.emplace_back(display, software);
}

}  // namespace

std::vector<Display> open_displays(bool hardware_only) {
  // libepoxy ends the process where it finds no EGL.
  if (dlopen("libEGL.so.1", RTLD_LAZY) == nullptr)
    throw Error("OpenGL", "there is no EGL on this machine (libEGL.so.1)");
  std::vector<Display> displays;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto platform_display = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (!has(client, "EGL_EXT_platform_base") || platform_display == nullptr) return displays;

  std::vector<EGLDeviceEXT> soft_devices;
  const auto query_devices = function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_device = function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (has(client, "EGL_EXT_platform_device") && query_devices != nullptr && query_device != nullptr) {
    EGLint count = 0;
    query_devices(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    query_devices(count, devices.data(), &count);
    for (const EGLDeviceEXT device : devices) {
      if (has(query_device(device, EGL_EXTENSIONS), "EGL_MESA_device_software"))
        soft_devices.push_back(device);
      else
        open(platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr), false, displays);
    }
  }
  if (hardware_only) return displays;
  if (has(client, "EGL_MESA_platform_surfaceless"))
    open(platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), true, displays);
  for (const EGLDeviceEXT device : soft_devices)
    open(platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr), true, displays);
  return displays;
}

}  // namespace sconce::gpu

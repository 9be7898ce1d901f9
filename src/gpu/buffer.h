// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "gpu/context.h"

namespace sconce::gpu {

/// Memory on the device that shaders read and write (std430).
class Buffer {
 public:
  /// @param data  may be null: zeros
  /// @param what  for messages
  /// @throws Error when it is larger than the device allows
  Buffer(const Context& context, std::size_t bytes, const void* data, const std::string& what);
  template <class T>
  Buffer(const Context& context, std::span<const T> all, const std::string& what)
      : Buffer(context, all.size_bytes(), all.data(), what) {
    static_assert(std::is_trivially_copyable_v<T>);
  }
  ~Buffer() { glDeleteBuffers(1, &handle_); }
  Buffer(Buffer&& other) noexcept : handle_(std::exchange(other.handle_, 0)), bytes_(other.bytes_) {}
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  /// To a shader's `binding`.
  void bind(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, handle_); }
  /// The first `bytes` of it.
  void write(std::size_t bytes, const void* from) const;
  /// Waits for what shaders write. @param bytes  from the start
  void read(std::size_t bytes, void* to) const;
  /// All becomes 0.
  void clear() const;
  std::size_t bytes() const { return bytes_; }

 private:
  GLuint handle_ = 0;
  std::size_t bytes_;
};

/// Lets what comes next see what compute shaders wrote to buffers.
inline void buffers_written() {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace sconce::gpu

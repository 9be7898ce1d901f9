// SPDX-License-Identifier: Apache-2.0
#include "gpu/buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "core/error.h"

namespace sconce::gpu {

Buffer::Buffer(const Context& context, std::size_t bytes, const void* data, const std::string& what)
    : bytes_(bytes) {
  const Capabilities& can = context.capabilities();
  if (bytes > can.max_buffer)
    throw Error(what, std::to_string(bytes) + " bytes are too many for " + can.renderer,
                "up to " + std::to_string(can.max_buffer));
  // Shaders read whole words; no buffer may be empty.
  constexpr std::size_t kAlign = 16;
  const std::size_t room = std::max(kAlign, (bytes + kAlign - 1) / kAlign * kAlign);
  // Filled as it is made: NVIDIA's driver may run a clear after the write that follows it.
  std::vector<std::byte> padded;
  if (data == nullptr || bytes < room) {
    padded.resize(room);
    if (data != nullptr) std::memcpy(padded.data(), data, bytes);
    data = padded.data();
  }
  glCreateBuffers(1, &handle_);
  glNamedBufferStorage(handle_, static_cast<GLsizeiptr>(room), data, GL_DYNAMIC_STORAGE_BIT);
}

void Buffer::write(std::size_t bytes, const void* from) const {
  if (bytes > 0) glNamedBufferSubData(handle_, 0, static_cast<GLsizeiptr>(bytes), from);
}

void Buffer::read(std::size_t bytes, void* to) const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(handle_, 0, static_cast<GLsizeiptr>(bytes), to);
}

void Buffer::clear() const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glClearNamedBufferData(handle_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

}  // namespace sconce::gpu

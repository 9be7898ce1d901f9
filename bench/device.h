// SPDX-License-Identifier: Apache-2.0
// Time and bandwidth of the device that OpenGL computes on.
#pragma once

#include <algorithm>
#include <chrono>

#include "gpu/buffer.h"
#include "gpu/program.h"

/// Seconds of one of many in a row, best of some rows. Timer queries mean nothing where the processor draws.
template <class F>
double device_seconds(const sconce::gpu::Context& context, F work) {
  using Clock = std::chrono::steady_clock;
  constexpr double kSeconds = 0.5;  // spent on each
  const int row = context.capabilities().software ? 1 : 50;
  double best = 1e9, spent = 0;
  for (int round = 0; round < 100 && (round < 3 || spent < kSeconds); ++round) {
    glFinish();
    const auto start = Clock::now();
    for (int i = 0; i < row; ++i) work();
    glFinish();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    best = std::min(best, seconds / row);
    spent += seconds;
  }
  return best;
}

/// Bytes read and written per second by a copy of buffers larger than any cache: by the shader units, whose
/// copy engines may be slower.
inline double copy_bandwidth(const sconce::gpu::Context& context) {
  const GLsizeiptr bytes = context.capabilities().software ? 1 << 26 : 1 << 30;
  constexpr GLsizeiptr kPerGroup = 256 * 16;
  GLuint buffers[2];
  glCreateBuffers(2, buffers);
  for (GLuint i = 0; i < 2; ++i) {
    glNamedBufferStorage(buffers[i], bytes, nullptr, 0);
    glClearNamedBufferData(buffers[i], GL_R32F, GL_RED, GL_FLOAT, nullptr);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
  }
  const sconce::gpu::Program copy("copy", R"(#version 450 core
layout(local_size_x = 256) in;
layout(binding = 0) readonly buffer From { uvec4 from[]; };
layout(binding = 1) writeonly buffer To { uvec4 to[]; };
void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 256u + gl_LocalInvocationID.x;
  to[i] = from[i];
}
)");
  copy.use();
  const double seconds =
      device_seconds(context, [&] { sconce::gpu::dispatch(static_cast<std::size_t>(bytes / kPerGroup)); });
  glDeleteBuffers(2, buffers);
  context.check("copying");
  return 2 * static_cast<double>(bytes) / seconds;
}

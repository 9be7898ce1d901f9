// SPDX-License-Identifier: Apache-2.0
// What the fuzz targets share. A target gives a reader of ours any bytes: it may return or throw Error,
// nothing else.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/scratch_folder.h"

namespace sconce::fuzz {

/// A file whose content is the input of the moment.
class File {
 public:
  explicit File(const std::string& name)
      : path_(folder_.path() / name), fd_(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { ::close(fd_); }

  const std::filesystem::path& hold(std::string_view bytes) {
    const bool ok = ::ftruncate(fd_, 0) == 0 &&
                    ::pwrite(fd_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
    if (!ok) throw std::runtime_error("the scratch file cannot be written");
    return path_;
  }

 private:
  ScratchFolder folder_;
  std::filesystem::path path_;
  int fd_;
};

inline std::string_view text(const uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Runs it; an Error is an answer.
template <class F>
int answers(F&& f) {
  try {
    f();
  } catch (const Error&) {
  }
  return 0;
}

}  // namespace sconce::fuzz

// SPDX-License-Identifier: Apache-2.0
#include "core/files.h"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/error.h"

namespace fs = std::filesystem;

namespace sconce {

std::string read_file(const fs::path& path) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) throw Error(path.string(), "is a folder, expected a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path.string(), fs::exists(path, ec) ? "cannot be read" : "no such file");
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (in.bad()) throw Error(path.string(), "cannot be read");
  return std::move(bytes).str();
}

void write_file(const fs::path& path, std::string_view bytes) {
  Beside beside(path);
  const int fd = ::open(beside.path().c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (fd < 0) throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno));
  const char* p = bytes.data();
  std::size_t left = bytes.size();
  int failed = 0;
  while (left > 0 && failed == 0) {
    const ssize_t n = ::write(fd, p, left);
    if (n > 0) {
      p += n;
      left -= static_cast<std::size_t>(n);
    } else if (errno != EINTR) {
      failed = errno;
    }
  }
  if (failed == 0 && ::fsync(fd) != 0 && errno != EINVAL && errno != EROFS) failed = errno;
  if (::close(fd) != 0 && failed == 0) failed = errno;
  if (failed != 0) throw Error(path.string(), std::string("cannot be written: ") + std::strerror(failed));
  beside.commit();
}

Beside::Beside(fs::path target) : target_(std::move(target)) {
  while (!target_.has_filename() && target_.has_parent_path()) target_ = target_.parent_path();
  temporary_ = target_;
  temporary_ += ".writing-" + std::to_string(::getpid());
  std::error_code ec;
  fs::remove_all(temporary_, ec);
}

Beside::~Beside() {
  if (committed_) return;
  std::error_code ec;
  fs::remove_all(temporary_, ec);
}

void Beside::commit() {
  std::error_code ec;
  if (fs::is_directory(temporary_, ec) && fs::exists(target_, ec)) {
    // rename(2) does not replace a full folder: exchange the two in one step, then drop the old one.
    if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
      committed_ = true;
      fs::remove_all(temporary_, ec);
      return;
    }
    fs::path old = temporary_;
    old += ".old";
    fs::rename(target_, old, ec);
    if (!ec) fs::rename(temporary_, target_, ec);
    if (ec) {
      std::error_code back;
      if (!fs::exists(target_, back)) fs::rename(old, target_, back);
      throw Error(target_.string(), "cannot be replaced: " + ec.message());
    }
    committed_ = true;
    fs::remove_all(old, ec);
    return;
  }
  fs::rename(temporary_, target_, ec);
  if (ec) throw Error(target_.string(), "cannot be written: " + ec.message());
  committed_ = true;
}

}  // namespace sconce

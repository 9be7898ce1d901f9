// SPDX-License-Identifier: Apache-2.0
#include "core/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.h"
#include "core/files.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

/// The name may have been taken away by who held the lock before.
bool stands_under(const fs::path& path, int file) {
  struct stat ours {
  }, named{};
  return ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
         ours.st_dev == named.st_dev;
}

}  // namespace

FileLock::FileLock(fs::path target) : path_(without_slash(std::move(target))) {
  const std::string shown = path_.string();
  path_ += ".lock";
  do {
    if (file_ >= 0) ::close(file_);
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) return;
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) continue;
    const bool held = errno == EWOULDBLOCK;
    char process[16] = "";
    const ssize_t size = ::read(file_, process, sizeof process - 1);
    ::close(file_);
    file_ = -1;
    if (!held) return;
    throw Error(shown, "is being written by another process" + (size > 0 ? ", " + std::string(process) : ""));
  } while (!stands_under(path_, file_));
  const std::string process = std::to_string(::getpid());
  if (::ftruncate(file_, 0) != 0 || ::write(file_, process.data(), process.size()) < 0)
    return;  // for the line alone
}

FileLock::~FileLock() {
  if (file_ < 0) return;
  ::unlink(path_.c_str());
  ::close(file_);
}

}  // namespace sconce

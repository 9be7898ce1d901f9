// SPDX-License-Identifier: Apache-2.0
#include "core/files.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
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
  bytes << in.rdbuf();  // ends early, and says nothing, where memory does
  if (in.bad() || in.peek() != std::ifstream::traits_type::eof())
    throw Error(path.string(), "cannot be read, or is larger than there is memory");
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

fs::path without_slash(fs::path path) {
  while (!path.has_filename() && path.has_parent_path()) path = path.parent_path();
  return path;
}

namespace {

std::string host() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

/// What processes of this machine left that died while they wrote beside the same target.
void remove_left(const fs::path& target, const std::string& mark) {
  if (target.parent_path().string().find(mark) != std::string::npos) return;  // a new folder as a whole
  std::error_code ec;
  const std::string begin = target.filename().string() + mark;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::vector<fs::path> left;
  for (fs::directory_iterator at(folder, ec), end; !ec && at != end; at.increment(ec)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(begin)) continue;
    const pid_t process = std::atoi(name.c_str() + begin.size());
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) left.push_back(at->path());
  }
  for (const fs::path& file : left) fs::remove_all(file, ec);
}

}  // namespace

Beside::Beside(fs::path target) : target_(without_slash(std::move(target))) {
  const std::string mark = ".writing-" + host() + "-";
  remove_left(target_, mark);
  temporary_ = target_;
  temporary_ += mark + std::to_string(::getpid());
  std::error_code ec;
  fs::remove_all(temporary_, ec);
}

Beside::~Beside() {
  if (committed_) return;
  std::error_code ec;
  fs::remove_all(temporary_, ec);
}

void Beside::fill(const std::function<void(const fs::path&)>& write) const {
  try {
    write(temporary_);
  } catch (const fs::filesystem_error& e) {
    throw Error(target_.string(), "cannot be written: " + e.code().message());
  } catch (const Error& e) {
    std::string what = e.what();
    const std::string temporary = temporary_.string();
    if (const std::size_t at = what.find(temporary); at != std::string::npos)
      what.replace(at, temporary.size(), target_.string());
    throw Error({}, what);
  }
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

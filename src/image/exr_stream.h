// SPDX-License-Identifier: Apache-2.0
// OpenEXR streams over memory. Files are read and written whole by core/files.h, so that a short read or a
// full disk is found by one piece of code, and OpenEXR's destructors (which swallow errors) never touch the
// disk.
#pragma once

#include <ImfIO.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sconce {

class ExrInput final : public Imf::IStream {
 public:
  explicit ExrInput(std::string_view bytes) : Imf::IStream("memory"), bytes_(bytes) {}

  bool read(char* to, int n) override {
    if (n < 0 || position_ > bytes_.size() || static_cast<std::size_t>(n) > bytes_.size() - position_)
      throw std::runtime_error("unexpected end of file");
    std::memcpy(to, bytes_.data() + position_, static_cast<std::size_t>(n));
    position_ += static_cast<std::size_t>(n);
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  uint64_t position_ = 0;
};

class ExrOutput final : public Imf::OStream {
 public:
  ExrOutput() : Imf::OStream("memory") {}

  void write(const char* from, int n) override {
    const std::size_t end = position_ + static_cast<std::size_t>(n);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + position_, from, static_cast<std::size_t>(n));
    position_ = end;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

}  // namespace sconce

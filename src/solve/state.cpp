// SPDX-License-Identifier: Apache-2.0
#include "solve/state.h"

#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "core/files.h"

namespace sconce {

namespace {

constexpr char kMagic[8] = {'s', 'c', 'o', 'n', 'c', 'e', 'b', '1'};
constexpr uint32_t kRecord = 0x454c4954;  // "TILE"
constexpr uint64_t kMostTiles = 1 << 24;  // of 256: texels are numbered by 32 bits

struct RecordHead {
  uint32_t magic, tile, made_with_size, values;
  uint64_t checksum;  ///< XXH3 of made_with and values
};

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  throw Error(path.string(), std::string(what) + ": " + std::strerror(errno));
}

void put(std::string& out, const std::string& s) {
  const auto size = static_cast<uint64_t>(s.size());
  out.append(reinterpret_cast<const char*>(&size), sizeof size);
  out += s;
}

template <class T>
bool get(std::FILE* file, T& value) {
  return std::fread(&value, sizeof value, 1, file) == 1;
}

/// @param most  bytes that the whole file has
bool get(std::FILE* file, std::string& s, uint64_t most) {
  uint64_t size = 0;
  if (!get(file, size) || size > most) return false;
  s.resize(size);
  return size == 0 || std::fread(s.data(), size, 1, file) == 1;
}

uint64_t checksum(const std::string& made_with, std::span<const GroupValue> values) {
  return XXH3_64bits_withSeed(values.data(), values.size_bytes(),
                              XXH3_64bits(made_with.data(), made_with.size()));
}

}  // namespace

BakeState BakeState::create(const std::filesystem::path& path, const BakeHeader& header) {
  BakeState state;
  state.path_ = path;
  state.header_ = header;
  Beside beside(path);
  state.file_ = std::fopen(beside.path().c_str(), "w+b");
  if (state.file_ == nullptr) fail(path, "cannot be written");
  std::string head(kMagic, sizeof kMagic);
  put(head, header.hash);
  put(head, header.isa);
  put(head, header.job);
  head.append(reinterpret_cast<const char*>(&header.layers), sizeof header.layers);
  head.append(reinterpret_cast<const char*>(&header.receivers), sizeof header.receivers);
  head.append(reinterpret_cast<const char*>(&header.tile_size), sizeof header.tile_size);
  if (std::fwrite(head.data(), head.size(), 1, state.file_) != 1 || std::fflush(state.file_) != 0)
    fail(path, "cannot be written");
  beside.commit();
  return state;
}

BakeState BakeState::open(const std::filesystem::path& path, bool append) {
  BakeState state;
  state.path_ = path;
  state.file_ = std::fopen(path.c_str(), append ? "r+b" : "rb");
  if (state.file_ == nullptr) fail(path, "cannot be opened");
  char magic[sizeof kMagic];
  BakeHeader& h = state.header_;
  if (!get(state.file_, magic) || std::memcmp(magic, kMagic, sizeof kMagic) != 0)
    throw Error(path.string(), "is not the state of a bake by this version");
  const uint64_t size = std::filesystem::file_size(path);
  if (!get(state.file_, h.hash, size) || !get(state.file_, h.isa, size) || !get(state.file_, h.job, size) ||
      !get(state.file_, h.layers) || !get(state.file_, h.receivers) || !get(state.file_, h.tile_size) ||
      h.tile_size == 0 || h.receivers > kMostTiles * h.tile_size)
    throw Error(path.string(), "the header is damaged");
  state.scan(size, append);
  return state;
}

void BakeState::scan(uint64_t size, bool repair) {
  std::vector<GroupValue> values;
  for (;;) {
    const long start = std::ftell(file_);
    RecordHead head;
    std::string made_with;
    const bool whole = [&] {
      if (!get(file_, head) || head.magic != kRecord || head.tile >= tiles() || head.made_with_size > 4096 ||
          head.values != receivers_of(head.tile) * header_.layers || head.values > size / sizeof(GroupValue))
        return false;
      made_with.resize(head.made_with_size);
      values.resize(head.values);
      return (made_with.empty() || std::fread(made_with.data(), made_with.size(), 1, file_) == 1) &&
             std::fread(values.data(), sizeof(GroupValue), values.size(), file_) == values.size() &&
             checksum(made_with, values) == head.checksum;
    }();
    if (!whole) {
      // Whatever was being written when the process died: cut it off, so that appends follow a whole record.
      if (repair && ::ftruncate(fileno(file_), start) != 0) fail(path_, "cannot be repaired");
      std::fseek(file_, start, SEEK_SET);
      return;
    }
    records_[head.tile] = {static_cast<uint64_t>(start) + sizeof head + made_with.size(), made_with};
  }
}

BakeState::BakeState(BakeState&& other) noexcept
    : path_(std::move(other.path_)),
      header_(std::move(other.header_)),
      file_(std::exchange(other.file_, nullptr)),
      records_(std::move(other.records_)) {}

BakeState::~BakeState() {
  if (file_ != nullptr) std::fclose(file_);
}

std::size_t BakeState::tiles() const {
  return (header_.receivers + header_.tile_size - 1) / header_.tile_size;
}

bool BakeState::has(std::size_t tile) const {
  const std::lock_guard lock(mutex_);
  return records_.contains(tile);
}

std::string BakeState::made_with(std::size_t tile) const {
  const std::lock_guard lock(mutex_);
  return records_.at(tile).made_with;
}

std::size_t BakeState::receivers_of(std::size_t tile) const {
  const uint64_t first = static_cast<uint64_t>(tile) * header_.tile_size;
  return std::min<uint64_t>(header_.tile_size, header_.receivers - first);
}

void BakeState::append(std::size_t tile, const std::string& made_with, std::span<const GroupValue> values) {
  const RecordHead head{kRecord, static_cast<uint32_t>(tile), static_cast<uint32_t>(made_with.size()),
                        static_cast<uint32_t>(values.size()), checksum(made_with, values)};
  const std::lock_guard lock(mutex_);
  std::fseek(file_, 0, SEEK_END);
  const long start = std::ftell(file_);
  const bool ok = std::fwrite(&head, sizeof head, 1, file_) == 1 &&
                  (made_with.empty() || std::fwrite(made_with.data(), made_with.size(), 1, file_) == 1) &&
                  std::fwrite(values.data(), sizeof(GroupValue), values.size(), file_) == values.size() &&
                  std::fflush(file_) == 0;
  if (!ok) fail(path_, "cannot be written");
  records_[tile] = {static_cast<uint64_t>(start) + sizeof head + made_with.size(), made_with};
}

std::vector<GroupValue> BakeState::read(std::size_t tile, uint32_t layer) const {
  const std::lock_guard lock(mutex_);
  const auto record = records_.find(tile);
  if (record == records_.end()) throw Error(path_.string(), "cannot be read");
  std::vector<GroupValue> values(receivers_of(tile));
  const uint64_t values_at = record->second.values_at + layer * values.size() * sizeof(GroupValue);
  std::fseek(file_, static_cast<long>(values_at), SEEK_SET);
  if (std::fread(values.data(), sizeof(GroupValue), values.size(), file_) != values.size())
    throw Error(path_.string(), "cannot be read");
  return values;
}

}  // namespace sconce

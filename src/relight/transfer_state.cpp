// SPDX-License-Identifier: Apache-2.0
#include "relight/transfer_state.h"

#include <xxhash.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "core/files.h"
#include "core/ranks.h"

namespace sconce {

namespace {

constexpr std::string_view kMagic = "sconcet1";

struct RecordHead {
  uint64_t cluster, bytes, checksum;
};

std::string head(const std::string& key) {
  std::string bytes(kMagic);
  put_vector(bytes, std::vector<char>(key.begin(), key.end()));
  return bytes;
}

/// @return bytes of the file that are whole
std::size_t take_up(const std::filesystem::path& path, const std::string& begin, TransferRecords& records) {
  const std::string file = read_file(path);
  if (!file.starts_with(begin))
    throw Error(path.string(), "belongs to an operator made otherwise", "the same options, or no --resume");
  std::string_view left = std::string_view(file).substr(begin.size());
  std::size_t whole = begin.size();
  while (left.size() >= sizeof(RecordHead)) {
    RecordHead record{};
    take_span(left, std::span(&record, 1));
    if (record.bytes > left.size() || XXH3_64bits(left.data(), record.bytes) != record.checksum) break;
    records[record.cluster] = left.substr(0, record.bytes);
    left.remove_prefix(record.bytes);
    whole += sizeof record + record.bytes;
  }
  return whole;
}

}  // namespace

TransferRecords read_transfer_records(std::span<const std::filesystem::path> files, const std::string& key) {
  TransferRecords records;
  for (const std::filesystem::path& file : files) take_up(file, head(key), records);
  return records;
}

TransferState::TransferState(const std::filesystem::path& path, const std::string& key, bool resume,
                             TransferRecords more)
    : path_(path), records_(std::move(more)) {
  const std::string begin = head(key);
  std::error_code ec;
  if (resume && std::filesystem::exists(path, ec)) {
    // What an interruption cut off is made again; what stands stays on disk meanwhile.
    std::filesystem::resize_file(path, take_up(path, begin, records_), ec);
    file_.reset(std::fopen(path.c_str(), "ab"));
    if (ec || !file_) throw Error(path.string(), "cannot be written");
    return;
  }
  Beside beside(path);
  file_.reset(std::fopen(beside.path().c_str(), "wb"));
  if (!file_ || std::fwrite(begin.data(), begin.size(), 1, file_.get()) != 1 || std::fflush(file_.get()) != 0)
    throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno));
  beside.commit();
}

std::string_view TransferState::find(std::size_t cluster) const {
  const auto it = records_.find(cluster);
  return it == records_.end() ? std::string_view() : std::string_view(it->second);
}

void TransferState::put(std::size_t cluster, std::string_view bytes) {
  const std::scoped_lock lock(mutex_);
  const RecordHead record{cluster, bytes.size(), XXH3_64bits(bytes.data(), bytes.size())};
  if (std::fwrite(&record, sizeof record, 1, file_.get()) != 1 ||
      std::fwrite(bytes.data(), bytes.size(), 1, file_.get()) != 1 || std::fflush(file_.get()) != 0)
    throw Error(path_.string(), std::string("cannot be written: ") + std::strerror(errno));
}

void TransferState::remove() {
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace sconce

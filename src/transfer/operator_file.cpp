// SPDX-License-Identifier: Apache-2.0
// docs/operator-format.md
#include <algorithm>
#include <cstring>
#include <fstream>
#include <new>

#include "core/error.h"
#include "core/files.h"
#include "core/finite.h"
#include "core/hash.h"
#include "transfer/operator.h"

namespace sconce {

namespace {

constexpr std::string_view kMagic = "sconceop";
constexpr uint32_t kVersion = 1, kByteOrder = 0x01020304;
constexpr std::size_t kAlign = 64;

/// All fields little-endian, without gaps.
struct Head {
  char magic[8];
  uint32_t byte_order, version;
  char checksum[32];  ///< of all that follows this field
  uint64_t bytes;     ///< of the whole file
  char scene[64];
  char camera[64];
  char options[256];
  uint32_t kind;
  int32_t width, height, pages;
  float camera_frame[16], camera_yfov;
  uint32_t points_per_slot, sweeps;
  uint32_t slots, nodes, rows, cluster[3];  ///< of gather, first, bounce
  uint32_t sections, reserved;
};
constexpr std::size_t kChecked = offsetof(Head, bytes);

struct Section {
  uint64_t offset, bytes;
};

/// The arrays in the file's order.
template <class Op, class F>
void for_each_section(Op& op, F&& f) {
  f(op.lit);
  f(op.receivers);
  f(op.places);
  for (auto* rows : {&op.gather.basis, &op.first.basis, &op.bounce.basis}) {
    f(rows->first);
    f(rows->indices);
    f(rows->codes);
    f(rows->scales);
    f(rows->means);
  }
  for (auto* rows : {&op.gather, &op.first, &op.bounce}) {
    f(rows->weights);
    f(rows->scales);
  }
  f(op.albedo);
  for (auto* rows : {&op.gather.basis, &op.first.basis, &op.bounce.basis}) f(rows->values);
}
constexpr uint32_t kLeastSections = 25, kMostSections = 28;  ///< empty ones at the end are left out

uint32_t count_sections(const Operator& op) {
  uint32_t count = 0, filled = kLeastSections;
  for_each_section(op, [&](const auto& array) {
    ++count;
    if (!array.empty()) filled = std::max(filled, count);
  });
  return filled;
}

void put_text(std::string_view text, std::span<char> field) {
  std::memcpy(field.data(), text.data(), std::min(text.size(), field.size()));
}
std::string take_text(std::span<const char> field) {
  return {field.data(), strnlen(field.data(), field.size())};
}

/// What the arrays promise each other, so that no product reads outside them.
bool fits(const WaveletRows& rows) {
  const std::size_t blocks = (std::size_t{rows.rows} + WaveletRows::kBlock - 1) / WaveletRows::kBlock;
  if (!is_power_of_four(rows.columns) || rows.columns > 65536 || rows.first.size() != blocks + 1 ||
      rows.first[0] != 0 || rows.first.back() != rows.indices.size() ||
      (rows.values.empty() ? rows.codes.size() : rows.values.size()) !=
          WaveletRows::kBlock * rows.indices.size() ||
      rows.scales.size() != WaveletRows::kBlock * blocks || rows.means.size() != rows.scales.size())
    return false;
  for (std::size_t b = 0; b < blocks; ++b)
    if (rows.first[b] > rows.first[b + 1]) return false;
  for (const uint16_t index : rows.indices)
    if (index >= rows.columns) return false;
  return true;
}

bool fits(const ClusterRows& rows) {
  const std::size_t filled = rows.plain() ? 0 : (std::size_t{rows.rows} + 15) / 16 * 16;
  if (rows.plain() && rows.cluster != ClusterRows::kLanes) return false;
  return rows.cluster > 0 && rows.cluster % ClusterRows::kLanes == 0 && fits(rows.basis) &&
         rows.basis.rows == ClusterRows::kRank * rows.clusters() && rows.scales.size() == filled &&
         rows.weights.size() == ClusterRows::kRank * filled;
}

bool fits(const Operator& op) {
  if (op.width < 1 || op.height < 1 || op.pages < 1 || op.points_per_slot < 1) return false;
  const uint64_t room =
      static_cast<uint64_t>(op.width) * static_cast<uint64_t>(op.height) * static_cast<uint64_t>(op.pages);
  for (const uint32_t place : op.places)
    if (place >= room) return false;
  const std::size_t slots = op.slots(), nodes = op.bounce.rows;
  return fits(op.gather) && fits(op.first) && fits(op.bounce) && is_power_of_four(nodes) && nodes <= slots &&
         op.first.rows == nodes && op.first.basis.columns == slots && op.bounce.basis.columns == nodes &&
         op.albedo.size() == nodes && op.receivers.size() == op.gather.rows &&
         op.places.size() == op.gather.rows && op.lit.size() == op.points_per_slot * slots;
}

/// Codes always are.
template <class T>
bool finite(std::span<const T> values) {
  if constexpr (std::is_same_v<T, float>) return !first_not_finite(values);
  if constexpr (std::is_same_v<T, Rgbx>)
    return !first_not_finite({reinterpret_cast<const float*>(values.data()), 4 * values.size()});
  if constexpr (std::is_same_v<T, OperatorPoint>)
    return std::none_of(values.begin(), values.end(),
                        [](const OperatorPoint& p) { return first_not_finite(p.position).has_value(); });
  return true;
}

/// A file as it was when it was read: a copy that stays whatever becomes of it (ADR 44).
class AlignedBytes {
 public:
  /// @throws Error
  explicit AlignedBytes(const std::filesystem::path& path) {
    std::error_code ec;
    size_ = std::filesystem::file_size(path, ec);
    std::ifstream in(path, std::ios::binary);
    if (ec || !in) {
      read_file(path);  // says why not
      throw Error(path.string(), "cannot be read");
    }
    data_.reset(static_cast<char*>(::operator new(size_ + 1, std::align_val_t(kAlign), std::nothrow)));
    if (data_ == nullptr) throw Error(path.string(), "is larger than there is memory");
    if (!in.read(data_.get(), static_cast<std::streamsize>(size_)))
      throw Error(path.string(), "changed while it was read");
  }
  std::string_view bytes() const { return {data_.get(), size_}; }

 private:
  struct Free {
    void operator()(char* data) const { ::operator delete(data, std::align_val_t(kAlign)); }
  };
  std::size_t size_ = 0;
  std::unique_ptr<char, Free> data_;
};

}  // namespace

void write_operator(const std::filesystem::path& path, const Operator& op) {
  for_each_section(op, [&](const auto& array) {
    if (!finite(array)) throw Error(path.string(), "would hold a number that is infinite or none");
  });
  Head head{};
  std::memcpy(head.magic, kMagic.data(), sizeof head.magic);
  head.byte_order = kByteOrder, head.version = kVersion;
  put_text(op.scene, head.scene);
  put_text(op.camera, head.camera);
  put_text(op.options, head.options);
  head.kind = static_cast<uint32_t>(op.kind);
  head.width = op.width, head.height = op.height, head.pages = op.pages;
  std::memcpy(head.camera_frame, &op.camera_frame[0][0], sizeof head.camera_frame);
  head.camera_yfov = op.camera_yfov;
  head.points_per_slot = op.points_per_slot, head.sweeps = op.sweeps;
  head.slots = op.slots(), head.nodes = op.bounce.rows, head.rows = op.gather.rows;
  head.cluster[0] = op.gather.cluster, head.cluster[1] = op.first.cluster,
  head.cluster[2] = op.bounce.cluster;
  head.sections = count_sections(op);
  std::string bytes(sizeof head + head.sections * sizeof(Section), '\0');
  std::size_t section = 0;
  for_each_section(op, [&](const auto& array) {
    if (section == head.sections) return;
    bytes.resize((bytes.size() + kAlign - 1) / kAlign * kAlign);
    const Section entry{bytes.size(), array.size_bytes()};
    bytes.append(reinterpret_cast<const char*>(array.data()), array.size_bytes());
    std::memcpy(bytes.data() + sizeof head + sizeof entry * section++, &entry, sizeof entry);
  });
  head.bytes = bytes.size();
  std::memcpy(bytes.data(), &head, sizeof head);
  put_text(hash_hex(std::string_view(bytes).substr(kChecked)), head.checksum);
  std::memcpy(bytes.data(), &head, sizeof head);
  write_file(path, bytes);
}

Operator open_operator(const std::filesystem::path& path, bool check) {
  const std::string where = path.string();
  const auto file = std::make_shared<const AlignedBytes>(path);
  const std::string_view bytes = file->bytes();
  Head head{};
  if (bytes.size() < sizeof head || bytes.substr(0, kMagic.size()) != kMagic)
    throw NotMyFormat(where, "is no operator", "a file that 'sconce transfer' wrote");
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.byte_order != kByteOrder) throw Error(where, "has another byte order");
  if (head.version != kVersion)
    throw Error(where, "has version " + std::to_string(head.version) + "; this program reads version " +
                           std::to_string(kVersion));
  if (head.bytes != bytes.size())
    throw Error(where, "is damaged: it has " + std::to_string(bytes.size()) + " bytes of " +
                           std::to_string(head.bytes));
  if (check && hash_hex(bytes.substr(kChecked)) != take_text(head.checksum))
    throw Error(where, "is damaged: its content is not what its checksum says");
  const Error broken(where, "is damaged: its tables do not fit each other");
  if (head.sections < kLeastSections || head.sections > kMostSections ||
      head.kind > static_cast<uint32_t>(OperatorReceivers::lobes) ||
      head.kind == static_cast<uint32_t>(OperatorReceivers::vertices) ||
      bytes.size() < sizeof head + head.sections * sizeof(Section))
    throw broken;
  Operator op;
  op.kind = static_cast<OperatorReceivers>(head.kind);
  op.width = head.width, op.height = head.height, op.pages = head.pages;
  op.scene = take_text(head.scene), op.camera = take_text(head.camera), op.options = take_text(head.options);
  std::memcpy(&op.camera_frame[0][0], head.camera_frame, sizeof head.camera_frame);
  op.camera_yfov = head.camera_yfov;
  op.points_per_slot = head.points_per_slot, op.sweeps = head.sweeps;
  std::size_t matrix = 0;
  for (ClusterRows* rows : {&op.gather, &op.first, &op.bounce}) {
    rows->rows = matrix == 0 ? head.rows : head.nodes;
    rows->cluster = head.cluster[matrix];
    if (rows->cluster == 0) throw broken;
    rows->basis.columns = matrix == 2 ? head.nodes : head.slots;
    rows->basis.rows = static_cast<uint32_t>(ClusterRows::kRank * rows->clusters());
    ++matrix;
  }
  std::size_t section = 0;
  for_each_section(op, [&](auto& array) {
    if (section == head.sections) return;
    using T = typename std::remove_reference_t<decltype(array)>::element_type;
    Section entry{};
    std::memcpy(&entry, bytes.data() + sizeof head + sizeof entry * section++, sizeof entry);
    if (entry.offset % kAlign != 0 || entry.offset > bytes.size() ||
        entry.bytes > bytes.size() - entry.offset || entry.bytes % sizeof(T) != 0)
      throw broken;
    array = {reinterpret_cast<T*>(bytes.data() + entry.offset), entry.bytes / sizeof(T)};
  });
  if (!fits(op)) throw broken;
  op.owners.push_back(file);
  return op;
}

}  // namespace sconce

// SPDX-License-Identifier: Apache-2.0
#include "solve/state.h"

#include <sys/resource.h>

#include <cstring>

#include "core/error.h"
#include "core/test_folder.h"

namespace sconce {
namespace {

/// Two layers of five receivers in tiles of four; the second tile is finished.
std::filesystem::path write_state(const TemporaryFolder& folder) {
  const auto path = folder / "a.state";
  BakeState state = BakeState::create(path, {"hash", "isa", 2, 5, 4, "job"});
  state.append(1, "samples=8", std::vector<GroupValue>{{Rgb(1), 0.5f}, {Rgb(2), 0.25f}});
  return path;
}

TEST(BakeState, ComesBack) {
  const TemporaryFolder folder;
  const BakeState state = BakeState::open(write_state(folder), false);
  EXPECT_EQ(state.header().job, "job");
  ASSERT_EQ(state.tiles(), 2u);
  EXPECT_FALSE(state.has(0));
  ASSERT_TRUE(state.has(1));
  EXPECT_EQ(state.made_with(1), "samples=8");
  EXPECT_EQ(state.read(1, 1).at(0).illuminance, Rgb(2));
}

// Every prefix is a state with fewer tiles, or an Error; every damaged byte, too. What a damaged header asks
// for is not reserved.
TEST(BakeState, DamageIsAnErrorOrFewerTiles) {
  const TemporaryFolder folder;
  const std::string whole = read_file(write_state(folder));
  const auto opens = [&](const std::string& bytes) {
    try {
      return BakeState::open(folder.write("b.state", bytes), true).tiles() == 2;
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      return false;
    }
  };
  for (std::size_t n = 0; n < whole.size(); ++n) opens(whole.substr(0, n));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    opens(damaged);
  }
  const std::size_t receivers = whole.find("job") + 3 + 4;
  std::string many = whole;
  const uint64_t count = uint64_t{1} << 33;
  std::memcpy(&many[receivers], &count, sizeof count);
  EXPECT_FALSE(opens(many));
  std::string large = whole;  // one tile of 2^31 receivers, and a record that says so
  const uint64_t half = uint64_t{1} << 31;
  const auto tile = static_cast<uint32_t>(half), values = tile;
  const uint32_t layers = 1, first = 0;
  std::memcpy(&large[receivers - 4], &layers, sizeof layers);
  std::memcpy(&large[receivers], &half, sizeof half);
  std::memcpy(&large[receivers + 8], &tile, sizeof tile);
  std::memcpy(&large[receivers + 16], &first, sizeof first);
  std::memcpy(&large[receivers + 24], &values, sizeof values);
  EXPECT_EQ(BakeState::open(folder.write("b.state", large), true).has(0), false);
}

// 2^24 tiles, none finished; a slot for each would be 600 MB.
TEST(BakeState, TilesToComeReserveNothing) {
  const TemporaryFolder folder;
  const auto kilobytes = [] {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return use.ru_maxrss;
  };
  const long before = kilobytes();
  const auto path = folder / "a.state";
  BakeState::create(path, {"hash", "isa", 2, uint64_t{1} << 26, 4, "job"});
  const BakeState state = BakeState::open(path, true);
  EXPECT_EQ(state.tiles(), std::size_t{1} << 24);
  EXPECT_FALSE(state.has(state.tiles() - 1));
  EXPECT_LT(kilobytes() - before, 100'000);
}

}  // namespace
}  // namespace sconce

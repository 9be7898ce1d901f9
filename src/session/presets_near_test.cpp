// SPDX-License-Identifier: Apache-2.0
#include "session/presets_near.h"

#include <gtest/gtest.h>

#include "core/files.h"
#include "core/test_folder.h"

namespace sconce {
namespace {

TEST(PresetsNear, ThoseOfTheSameGroupsByName) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "moods");
  write_file(folder / "room-warm.toml", "[mix]\nceiling = \"2700K\"\n");
  write_file(folder / "moods/night.toml", "others = \"off\"\n");
  write_file(folder / "other.toml", "[mix]\nkitchen = \"off\"\n");  // another scene's
  write_file(folder / "room.toml", "[sky]\nluminance = 2000\n");    // a side file
  write_file(folder / "notes.txt", "[mix]\nceiling = \"off\"\n");
  GroupInfo ceiling;
  ceiling.name = "ceiling";
  const auto found = presets_near(folder / "room.sconce", {&ceiling, 1});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "night");
  EXPECT_EQ(found[1].name, "warm");
  EXPECT_EQ(found[1].file.filename(), "room-warm.toml");
  EXPECT_TRUE(presets_near("/nowhere/x.sconce", {&ceiling, 1}).empty());
}

}  // namespace
}  // namespace sconce

// SPDX-License-Identifier: Apache-2.0
#include "import/side_parts.h"

namespace sconce {

void apply_camera(const SideContext& context, const SideNode& node) {
  const SideTable table(context.path.string(), "[[camera]]", node,
                        {"name", "eye", "target", "up", "fov", "hfov", "aspect"});
  const auto name = table.text("name");
  if (!name) table.fail({}, "has no name", "name = \"...\"");
  Camera added;
  added.name = *name;
  Camera* camera = &added;
  for (Camera& known : context.scene.cameras)
    if (known.name == *name) camera = &known;
  const bool fresh = camera == &added;

  const auto eye = table.vector("eye"), target = table.vector("target"), up = table.vector("up");
  if (fresh && (!eye || !target))
    table.fail({}, "is new and needs a place", "eye = [x, y, z] and target = [x, y, z]");
  if (eye || target || up) {
    const Vec3 at = eye.value_or(Vec3(camera->frame[3]));
    const Vec3 direction = target ? *target - at : -Vec3(camera->frame[2]);
    if (!(glm::length(direction) > 0)) table.fail("target", "is where the eye is");
    camera->frame = looking(at, direction, up.value_or(Vec3(0, 1, 0)));
  }
  if (const auto aspect = table.positive("aspect")) camera->aspect = static_cast<float>(*aspect);
  if (table.has("fov") && table.has("hfov")) table.fail("hfov", "stands beside fov", "one of the two");
  for (const char* key : {"fov", "hfov"}) {
    const auto degrees = table.positive(key);
    if (!degrees) continue;
    if (*degrees >= 180) table.fail(key, "is out of range", "degrees, 0 to 180 exclusive");
    const float angle = static_cast<float>(*degrees) * kPi / 180.0f;
    camera->yfov = key[0] == 'f' ? angle : 2 * std::atan(std::tan(angle / 2) / camera->aspect);
  }
  if (fresh) context.scene.cameras.push_back(std::move(added));
}

}  // namespace sconce

// SPDX-License-Identifier: Apache-2.0
#include "picture_output.h"

#include <filesystem>

#include "core/error.h"
#include "image/io.h"
#include "image/primaries.h"
#include "mix_options.h"

namespace fs = std::filesystem;

namespace sconce::app {

std::string default_output(const std::string& package, const std::string& ending) {
  fs::path path(package);
  if (!path.has_filename()) path = path.parent_path();
  return path.replace_extension(ending).string();
}

bool is_acescg(const std::string& colorspace, bool linear) {
  if (colorspace != "rec709" && colorspace != "acescg")
    throw UsageError("option '--colorspace'", "unknown colour space '" + colorspace + "'", "rec709, acescg");
  if (colorspace == "acescg" && !linear)
    throw UsageError("option '--colorspace'", "acescg is for linear pictures", "-o FILE.exr");
  return colorspace == "acescg";
}

void write_linear(const std::string& output, Image picture, const Exposure& exposure, bool acescg,
                  std::size_t light) {
  for (std::size_t i = 0; i < picture.data.size(); ++i)
    if (i % picture.stride() < light) picture.data[i] *= exposure.scale;
  if (acescg) to_acescg(picture);
  picture.number["whiteLuminance"] = exposure.white_luminance();
  picture.text["sconce:convention"] = "luminance in cd/m2: value * whiteLuminance, linear; row 0 is the top";
  write_exr(output, picture, PixelType::full);
}

void write_toned(const std::string& output, const Image8& toned) {
  if (output != "-") return write_png(output, toned);
  const std::vector<unsigned char> bytes = encode_png(toned);
  write_stdout({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace sconce::app

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <string>

namespace sconce {

/// Gives assimp only the MTL statements that we use: others (`aniso`, say) and damaged numbers would make it
/// give up the whole file.
class MtlFilter : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override;
};

/// The lines of an MTL text that are kept.
std::string filtered_mtl(std::string text);

}  // namespace sconce

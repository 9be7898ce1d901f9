// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Ogre.h>
#include <OgreShaderGenerator.h>

/// While it lives, the shader generator makes the techniques of a scheme that materials lack when first
/// drawn.
class GeneratedTechniques : public Ogre::MaterialManager::Listener {
 public:
  explicit GeneratedTechniques(Ogre::String scheme) : scheme_(std::move(scheme)) {
    Ogre::MaterialManager::getSingleton().addListener(this, scheme_);
  }
  ~GeneratedTechniques() override { Ogre::MaterialManager::getSingleton().removeListener(this, scheme_); }
  GeneratedTechniques(const GeneratedTechniques&) = delete;
  GeneratedTechniques& operator=(const GeneratedTechniques&) = delete;

  Ogre::Technique* handleSchemeNotFound(unsigned short, const Ogre::String& scheme, Ogre::Material* material,
                                        unsigned short, const Ogre::Renderable*) override {
    auto& generator = Ogre::RTShader::ShaderGenerator::getSingleton();
    if (!generator.createShaderBasedTechnique(*material, Ogre::MaterialManager::DEFAULT_SCHEME_NAME, scheme))
      return nullptr;
    generator.validateMaterial(scheme, material->getName(), material->getGroup());
    for (Ogre::Technique* technique : material->getTechniques())
      if (technique->getSchemeName() == scheme) return technique;
    return nullptr;
  }

 private:
  Ogre::String scheme_;
};

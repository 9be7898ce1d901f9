// SPDX-License-Identifier: Apache-2.0
#define TINYGLTF_IMPLEMENTATION
#include "import/gltf_model.h"

#include "core/error.h"
#include "core/text.h"

namespace sconce {

namespace {

constexpr std::string_view kBufferPrefix = "buffer:";

const Bytes* buffer_named(const std::string& name, void* user) {
  const auto& buffers = *static_cast<const std::vector<Bytes>*>(user);
  const std::size_t at = name.rfind(kBufferPrefix);
  if (at == std::string::npos) return nullptr;
  const auto index = parse_number(std::string_view(name).substr(at + kBufferPrefix.size()));
  return index && *index >= 0 && *index < static_cast<double>(buffers.size())
             ? &buffers[static_cast<std::size_t>(*index)]
             : nullptr;
}

std::string first_line(const std::string& text) {
  const std::string trimmed = trim(text);
  return trimmed.substr(0, trimmed.find('\n'));
}

}  // namespace

tinygltf::Model parse_gltf_model(const std::string& json, const std::vector<Bytes>& buffers,
                                 const std::string& where) {
  tinygltf::TinyGLTF loader;
  tinygltf::FsCallbacks files{};
  files.FileExists = [](const std::string& name, void* user) { return buffer_named(name, user) != nullptr; };
  files.ExpandFilePath = [](const std::string& name, void*) { return name; };
  files.ReadWholeFile = [](Bytes* out, std::string*, const std::string& name, void* user) {
    const Bytes* bytes = buffer_named(name, user);
    if (bytes != nullptr) *out = *bytes;
    return bytes != nullptr;
  };
  files.WriteWholeFile = nullptr;
  files.user_data = const_cast<std::vector<Bytes>*>(&buffers);
  loader.SetFsCallbacks(files);

  tinygltf::Model model;
  std::string error, warning;
  try {
    if (!loader.LoadASCIIFromString(&model, &error, &warning, json.c_str(),
                                    static_cast<unsigned>(json.size()), ""))
      throw Error(where,
                  "is no valid glTF: " + (error.empty() ? "a part has the wrong type" : first_line(error)));
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(where, std::string("is no valid glTF: ") + e.what());
  }
  return model;
}

}  // namespace sconce

// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace sconce {

namespace {

using nlohmann::json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";
// A stream of attributes spends a byte on at least 64 of what it decodes to; indices more.
constexpr std::size_t kMostRatio = 64, kSlack = 4096;

const json* extension_of(const json& node) {
  const json::json_pointer pointer = json::json_pointer("/extensions") / kMeshopt;
  return node.is_object() && node.contains(pointer) ? &node.at(pointer) : nullptr;
}

Bytes decode_stream(const std::string& mode, std::size_t count, std::size_t stride, const Bytes& stream,
                    const std::string& place) {
  Bytes out(count * stride);
  int problem = 0;
  if (mode == "ATTRIBUTES") {
    if (stride % 4 != 0 || stride == 0 || stride > 256)
      throw Error(place, "byteStride " + std::to_string(stride), "a multiple of 4, at most 256");
    problem = meshopt_decodeVertexBuffer(out.data(), count, stride, stream.data(), stream.size());
  } else if (mode == "TRIANGLES" || mode == "INDICES") {
    if (stride != 2 && stride != 4) throw Error(place, "byteStride " + std::to_string(stride), "2, 4");
    if (mode == "INDICES")
      problem = meshopt_decodeIndexSequence(out.data(), count, stride, stream.data(), stream.size());
    else if (count % 3 != 0)
      throw Error(place, "count " + std::to_string(count), "a multiple of 3 for TRIANGLES");
    else
      problem = meshopt_decodeIndexBuffer(out.data(), count, stride, stream.data(), stream.size());
  } else {
    throw Error(place, "mode '" + mode + "' is unknown", "ATTRIBUTES, TRIANGLES, INDICES");
  }
  if (problem != 0) throw Error(place, "meshopt stream is damaged");
  return out;
}

void apply_filter(const std::string& filter, std::size_t count, std::size_t stride, Bytes& bytes,
                  const std::string& place) {
  if (filter == "NONE") return;
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  else if (filter == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  else if (filter == "EXPONENTIAL" && stride % 4 == 0)
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  else
    throw Error(place, "filter '" + filter + "' with byteStride " + std::to_string(stride),
                "NONE, OCTAHEDRAL (4, 8), QUATERNION (8), EXPONENTIAL (multiples of 4)");
}

}  // namespace

bool is_meshopt_fallback(const json& buffer) {
  const json* extension = extension_of(buffer);
  return extension != nullptr && extension->value("fallback", false);
}

void decode_meshopt(json& root, std::vector<Bytes>& buffers, std::vector<bool>& missing,
                    const std::string& where) {
  if (!root.contains("bufferViews")) return;
  json& views = root.at("bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    json& view = views.at(i);
    const json* extension = extension_of(view);
    if (extension == nullptr) continue;
    const std::string place = where + ": bufferViews[" + std::to_string(i) + "]." + kMeshopt;
    const auto buffer = extension->at("buffer").get<std::size_t>();
    if (buffer >= buffers.size())
      throw Error(place, "buffer " + std::to_string(buffer) + " is out of range",
                  "0 to " + std::to_string(buffers.size()) + " exclusive");
    if (missing[buffer]) continue;
    const auto offset = extension->value("byteOffset", std::size_t{0});
    const auto length = extension->at("byteLength").get<std::size_t>();
    const auto stride = extension->at("byteStride").get<std::size_t>();
    const auto count = extension->at("count").get<std::size_t>();
    const Bytes& from = buffers[buffer];
    if (offset > from.size() || length > from.size() - offset)
      throw Error(place, "reaches beyond its buffer of " + std::to_string(from.size()) + " bytes");
    if (stride == 0 || count > (kMostRatio * length + kSlack) / stride)
      throw Error(place, "count " + std::to_string(count) + " is more than " + std::to_string(length) +
                             " bytes can hold");
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(offset);
    Bytes decoded = decode_stream(extension->at("mode").get<std::string>(), count, stride,
                                  Bytes(first, first + static_cast<std::ptrdiff_t>(length)), place);
    apply_filter(extension->value("filter", std::string("NONE")), count, stride, decoded, place);
    view["buffer"] = buffers.size();
    view["byteOffset"] = 0;
    view["byteLength"] = decoded.size();
    root.at("buffers").push_back(json::object());
    missing.push_back(decoded.empty());
    buffers.push_back(decoded.empty() ? Bytes(1, 0) : std::move(decoded));
  }
}

}  // namespace sconce

// SPDX-License-Identifier: Apache-2.0
// For tests only: a sink for warnings, small glTF files.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/test_folder.h"
#include "import/import.h"
#include "import/uri.h"

namespace sconce {

/// Collects warnings.
struct Warnings {
  std::vector<std::string> lines;
  Progress progress;

  Warnings() {
    progress.warning = [this](const std::string& line) { lines.push_back(line); };
  }
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;
  bool any(std::string_view part) const {
    for (const std::string& line : lines)
      if (line.find(part) != std::string::npos) return true;
    return false;
  }
};

/// The message of the Error that `f` throws; "" where it throws none.
template <class F>
std::string error_of(F&& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

/// Area of a mesh that lies in the plane z = 0, negative where it faces down.
inline float flat_area(const Mesh& mesh) {
  float area = 0;
  for (const Triangle& t : mesh.triangles)
    area += 0.5f * glm::cross(mesh.positions[t.v[1]] - mesh.positions[t.v[0]],
                              mesh.positions[t.v[2]] - mesh.positions[t.v[0]])
                       .z;
  return area;
}

/// Buffers, views and accessors put together; the rest of the JSON is the test's.
class GltfBuilder {
 public:
  /// Appends values as one view; returns its index.
  template <class T>
  int view(const std::vector<T>& values, int stride = 0) {
    while (bytes_.size() % 4 != 0) bytes_.push_back(0);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(&bytes_[at], values.data(), values.size() * sizeof(T));
    add(views_, "{\"buffer\":0,\"byteOffset\":" + std::to_string(at) +
                    ",\"byteLength\":" + std::to_string(values.size() * sizeof(T)) +
                    (stride > 0 ? ",\"byteStride\":" + std::to_string(stride) : "") + "}");
    return view_count_++;
  }
  /// @param more  further members, with a leading comma
  int accessor(int view, int component, const char* type, std::size_t count, const std::string& more = {}) {
    add(accessors_, "{" + (view >= 0 ? "\"bufferView\":" + std::to_string(view) + "," : std::string()) +
                        "\"componentType\":" + std::to_string(component) + ",\"type\":\"" + type +
                        "\",\"count\":" + std::to_string(count) + more + "}");
    return accessor_count_++;
  }
  int positions(const std::vector<float>& v) { return accessor(view(v), 5126, "VEC3", v.size() / 3); }
  int scalars(const std::vector<unsigned short>& v) { return accessor(view(v), 5123, "SCALAR", v.size()); }

  /// The file; `rest` holds further members of the root, without the outer braces.
  std::string json(const std::string& rest, const std::string& uri = {}) const {
    const std::string where =
        uri.empty() ? "data:application/octet-stream;base64," + encode_base64(bytes_) : uri;
    return "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":" + std::to_string(bytes_.size()) +
           ",\"uri\":\"" + where + "\"}],\"bufferViews\":[" + views_ + "],\"accessors\":[" + accessors_ +
           "]" + (rest.empty() ? "" : ",") + rest + "}";
  }
  const std::vector<unsigned char>& bytes() const { return bytes_; }

 private:
  static void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",") + item; }

  std::vector<unsigned char> bytes_;
  std::string views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

/// One triangle in the plane z = 0 at accessor 0, worn by mesh 0 of node 0.
inline GltfBuilder triangle() {
  GltfBuilder b;
  b.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return b;
}
inline constexpr const char* kTriangleMesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";

}  // namespace sconce

// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_accessor.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"

namespace sconce {

namespace {

// Zeros need no bytes in the file, so a damaged count could ask for any amount of memory.
constexpr std::size_t kMaxCountWithoutView = std::size_t{1} << 26;

const tinygltf::Accessor& accessor_at(const GltfSource& source, int index, const std::string& place) {
  if (index < 0 || static_cast<std::size_t>(index) >= source.model.accessors.size())
    throw Error(source.at(place), "accessor " + std::to_string(index) + " is out of range",
                "0 to " + std::to_string(source.model.accessors.size()) + " exclusive");
  return source.model.accessors[static_cast<std::size_t>(index)];
}

std::size_t component_size(int type, const std::string& where) {
  const int bytes = component_bytes(type);
  if (bytes == 0)
    throw Error(where, "componentType " + std::to_string(type) + " is not supported",
                "5120, 5121, 5122, 5123, 5125, 5126");
  return static_cast<std::size_t>(bytes);
}

template <class T>
T load(const unsigned char* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

/// One component as a number; normalised as the glTF specification says (section 3.11).
template <class Out>
Out component(const unsigned char* p, int type, bool normalized) {
  const auto scaled = [&](auto value, float full) {
    return normalized ? static_cast<Out>(std::max(static_cast<float>(value) / full, -1.0f))
                      : static_cast<Out>(value);
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(load<int8_t>(p), 127.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(load<uint8_t>(p), 255.0f);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(load<int16_t>(p), 32767.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(load<uint16_t>(p), 65535.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return static_cast<Out>(load<uint32_t>(p));
    default:
      return static_cast<Out>(load<float>(p));
  }
}

/// Elements in a view, checked to lie in it.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
};

Elements elements(const GltfSource& source, int view, std::size_t offset, std::size_t count, std::size_t size,
                  const std::string& place) {
  const std::span<const unsigned char> bytes = source.view(view, place);
  const std::size_t given = source.model.bufferViews[static_cast<std::size_t>(view)].byteStride;
  const std::size_t stride = given == 0 ? size : given;
  if (stride < size)
    throw Error(source.at(place), "byteStride " + std::to_string(stride) + " is smaller than an element");
  if (count > 0 && (offset > bytes.size() || size > bytes.size() - offset ||
                    (count - 1) > (bytes.size() - offset - size) / stride))
    throw Error(source.at(place), "accessor of " + std::to_string(count) +
                                      " elements reaches beyond its bufferView of " +
                                      std::to_string(bytes.size()) + " bytes");
  return {bytes.data() + offset, stride};
}

template <class Out>
void overlay_sparse(const GltfSource& source, const tinygltf::Accessor& a, std::size_t components,
                    const std::string& place, std::vector<Out>& out) {
  const auto& sparse = a.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > a.count || sparse.indices.byteOffset < 0 ||
      sparse.values.byteOffset < 0)
    throw Error(source.at(place), "sparse count " + std::to_string(sparse.count) + " is out of range",
                "0 to " + std::to_string(a.count));
  const auto count = static_cast<std::size_t>(sparse.count);
  const std::size_t index_size = component_size(sparse.indices.componentType, source.at(place + ".sparse"));
  const std::size_t value_size = component_size(a.componentType, source.at(place));
  const Elements index =
      elements(source, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
               index_size, place + ".sparse");
  const Elements value =
      elements(source, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
               value_size * components, place + ".sparse");
  for (std::size_t i = 0; i < count; ++i) {
    const auto target =
        component<uint32_t>(index.first + i * index.stride, sparse.indices.componentType, false);
    if (target >= a.count)
      throw Error(source.at(place), "sparse index " + std::to_string(target) + " is out of range",
                  "0 to " + std::to_string(a.count) + " exclusive");
    for (std::size_t c = 0; c < components; ++c)
      out[target * components + c] =
          component<Out>(value.first + i * value.stride + c * value_size, a.componentType, a.normalized);
  }
}

template <class Out>
std::vector<Out> read(const GltfSource& source, int index, int wanted, const std::string& place) {
  const tinygltf::Accessor& a = accessor_at(source, index, place);
  if (a.type != (wanted == 1 ? TINYGLTF_TYPE_SCALAR : wanted))
    throw Error(source.at(place), "accessor " + std::to_string(index) + " has the wrong type",
                wanted == 1 ? "SCALAR" : "VEC" + std::to_string(wanted));
  const auto components = static_cast<std::size_t>(wanted);
  const std::size_t size = component_size(a.componentType, source.at(place));
  std::vector<Out> out;
  if (a.bufferView < 0) {
    if (a.count > kMaxCountWithoutView)
      throw Error(source.at(place),
                  "accessor of " + std::to_string(a.count) + " elements without a bufferView");
    out.assign(a.count * components, Out{0});
  } else {
    const Elements from = elements(source, a.bufferView, a.byteOffset, a.count, size * components, place);
    out.resize(a.count * components);
    for (std::size_t i = 0; i < a.count; ++i)
      for (std::size_t c = 0; c < components; ++c)
        out[i * components + c] =
            component<Out>(from.first + i * from.stride + c * size, a.componentType, a.normalized);
  }
  if (a.sparse.isSparse) overlay_sparse(source, a, components, place, out);
  return out;
}

}  // namespace

int component_bytes(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

std::vector<float> read_floats(const GltfSource& source, int accessor, int components,
                               const std::string& place) {
  return read<float>(source, accessor, components, place);
}

std::vector<uint32_t> read_indices(const GltfSource& source, int accessor, const std::string& place) {
  switch (accessor_at(source, accessor, place).componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      break;
    default:
      throw Error(source.at(place), "indices have a componentType that is not unsigned", "5121, 5123, 5125");
  }
  return read<uint32_t>(source, accessor, 1, place);
}

bool has_accessor(const GltfSource& source, int accessor, const std::string& place) {
  const tinygltf::Accessor& a = accessor_at(source, accessor, place);
  if (a.bufferView >= 0 && !source.has_view(a.bufferView, place)) return false;
  return !a.sparse.isSparse || (source.has_view(a.sparse.indices.bufferView, place) &&
                                source.has_view(a.sparse.values.bufferView, place));
}

}  // namespace sconce

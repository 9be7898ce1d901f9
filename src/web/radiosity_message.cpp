// SPDX-License-Identifier: Apache-2.0
#include "web/radiosity_message.h"

#include <bit>
#include <cstring>

#include "core/error.h"

namespace sconce::web {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little);  // as in every browser

std::string RadiosityMessage::text() const {
  std::string json = head.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto length = static_cast<uint32_t>(json.size());
  std::string out(reinterpret_cast<const char*>(&length), sizeof length);
  return out.append(json).append(reinterpret_cast<const char*>(floats.data()), floats.size() * sizeof(float));
}

RadiosityMessage RadiosityMessage::read(const std::string& text) {
  uint32_t length = 0;
  if (text.size() >= sizeof length) std::memcpy(&length, text.data(), sizeof length);
  if (text.size() < sizeof length + std::size_t{length}) throw Error("message", "is cut off");
  const std::size_t at = sizeof length + std::size_t{length};
  RadiosityMessage message{Json::parse(text.substr(sizeof length, length), nullptr, false), {}};
  if (!message.head.is_object()) throw Error("message", "is no JSON object");
  message.floats.resize((text.size() - at) / sizeof(float));
  std::memcpy(message.floats.data(), text.data() + at, message.floats.size() * sizeof(float));
  return message;
}

}  // namespace sconce::web

// SPDX-License-Identifier: Apache-2.0
// A site by HTTP, with faders that its windows share.
#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>

#include "web/shared_mix.h"

namespace sconce::web {

struct ServerParams {
  std::filesystem::path folder;  ///< index.html, scene/
  std::string host = "127.0.0.1";
  int port = 8080;  ///< 0: any free one
  bool allow_write = false;
};

/// GET /             the folder's files, and nothing outside it
/// GET /mix          SharedMix::json()
/// PUT /mix          SharedMix::change(); 403 unless writing is allowed, 400 and one line where it is wrong
/// GET /events       the mix, now and after each change, as server-sent events
class Server {
 public:
  static constexpr std::size_t kLargestRequest = 64 << 10;  ///< bytes
  static constexpr int kStreams = 32;                       ///< windows that listen at the same time

  /// Takes the port. @throws Error where it is not to be had
  Server(SharedMix mix, const ServerParams& params);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  /// Until a stop is requested.
  void run(std::stop_token stop);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sconce::web

// SPDX-License-Identifier: Apache-2.0
#include "web/server.h"

#include <httplib.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.h"

namespace sconce::web {

namespace {

constexpr std::size_t kThreads = 64;  // more than streams, so that pages are always served
constexpr auto kHeartbeat = std::chrono::seconds(10);

bool is_loopback(const std::string& host) {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

/// The name in a Host header, without its port.
std::string name_of(const std::string& host) {
  if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
  return host.substr(0, host.find(':'));
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(
      nlohmann::json{{"error", why}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
      "application/json");
}

}  // namespace

struct Server::State {
  State(SharedMix first, const ServerParams& asked) : mix(std::move(first)), params(asked) {}

  httplib::Server http;
  std::mutex mutex;
  std::condition_variable changed;
  SharedMix mix;
  uint64_t version = 0;
  bool stopping = false;
  std::atomic<int> streams = 0;
  ServerParams params;
  int port = 0;

  void put(const httplib::Request& request, httplib::Response& response) {
    if (!params.allow_write)
      return refuse(response, 403, "read-only: 'sconce serve --allow-write' takes changes");
    const std::lock_guard lock(mutex);
    try {
      mix.change(request.body);
    } catch (const UsageError& error) {
      return refuse(response, 400, error.what());
    }
    ++version;
    changed.notify_all();
    response.set_content(mix.json(), "application/json");
  }

  /// One event, or a sign of life. @return false when the stream ends
  bool send_next(uint64_t& seen, httplib::DataSink& sink) {
    std::string text;
    {
      std::unique_lock lock(mutex);
      const bool fresh = changed.wait_for(lock, kHeartbeat, [&] { return stopping || version + 1 > seen; });
      if (stopping) return false;
      text = fresh ? "data: " + mix.json() + "\n\n" : ":\n\n";
      seen = version + 1;
    }
    return sink.write(text.data(), text.size());
  }

  void listen(httplib::Response& response) {
    if (streams.fetch_add(1) >= kStreams) {
      --streams;
      return refuse(response, 503, "too many windows");
    }
    response.set_header("Cache-Control", "no-cache");
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, seen = uint64_t{0}](std::size_t, httplib::DataSink& sink) mutable {
          return send_next(seen, sink);
        },
        [this](bool) { --streams; });
  }
};

Server::Server(SharedMix mix, const ServerParams& params)
    : state_(std::make_unique<State>(std::move(mix), params)) {
  httplib::Server& http = state_->http;
  http.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  // Not the library's SO_REUSEPORT, by which two servers would take turns at one port.
  http.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  http.set_payload_max_length(kLargestRequest);
  http.set_read_timeout(std::chrono::seconds(5));
  http.set_write_timeout(std::chrono::seconds(15));
  http.set_keep_alive_timeout(2);
  http.set_file_extension_and_mimetype_mapping("bin", "application/octet-stream");
  http.set_file_extension_and_mimetype_mapping("glsl", "text/plain");
  http.set_default_headers({{"X-Content-Type-Options", "nosniff"}});
  // A page elsewhere that has its name point here must not move our faders.
  http.set_pre_routing_handler(
      [local = is_loopback(params.host)](const httplib::Request& request, httplib::Response& response) {
        if (!local || is_loopback(name_of(request.get_header_value("Host"))))
          return httplib::Server::HandlerResponse::Unhandled;
        refuse(response, 403, "served to this machine alone");
        return httplib::Server::HandlerResponse::Handled;
      });
  State* const state = state_.get();
  http.Get("/mix", [state](const httplib::Request&, httplib::Response& response) {
    const std::lock_guard lock(state->mutex);
    response.set_header("Cache-Control", "no-store");
    response.set_content(state->mix.json(), "application/json");
  });
  http.Put("/mix", [state](const httplib::Request& request, httplib::Response& response) {
    state->put(request, response);
  });
  http.Get("/events",
           [state](const httplib::Request&, httplib::Response& response) { state->listen(response); });
  if (!http.set_mount_point("/", params.folder.string())) throw Error(params.folder.string(), "is no folder");

  const std::string where = params.host + ":" + std::to_string(params.port);
  state_->port = params.port == 0                              ? http.bind_to_any_port(params.host)
                 : http.bind_to_port(params.host, params.port) ? params.port
                                                               : -1;
  if (state_->port <= 0)
    throw Error(where, "cannot be listened on: taken, or not of this machine", "--port 0 for any free one");
}

Server::~Server() = default;

int Server::port() const {
  return state_->port;
}

void Server::run(std::stop_token stop) {
  const std::jthread watch([&](std::stop_token ended) {
    while (!stop.stop_requested() && !ended.stop_requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    {
      const std::lock_guard lock(state_->mutex);
      state_->stopping = true;
    }
    state_->changed.notify_all();
    while (!state_->http.is_running() && !ended.stop_requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    state_->http.stop();
  });
  state_->http.listen_after_bind();
}

}  // namespace sconce::web
